#include "engine/analysis/start/ramp.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/analysis/start/elastic_push.h"
#include "engine/analysis/start/held_back.h"
#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/units.h"
#include "engine/model/lost_blocks.h"
#include "engine/solve/blocks/integrate.h"
#include "engine/solve/blocks/islands.h"
#include "engine/solve/step.h"

namespace erbs::analysis {
namespace {

// s, least duration of the ramp; in units of 1 / circular frequency, of slow structures; ramps until a moving block counts as falling.
constexpr double ramp_seconds = 0.2, slow_ramp = 10, ramp_limit = 25;
// Of lowering: least duration, in ramps; unbalanced force over weight at rest, and of what moves.
constexpr double shortest = 2, balanced = 1e-5, unbalanced = 1e-3;
// A heap of its own may rock more slowly than the structure. So there are stages: the first lasts some ramps, in the next the damping is
// smaller by a factor, and it lasts as much longer.
constexpr double first_stage = 4, softer = 3;
constexpr int stages = 3;
// Limit of rest: kinetic energy of a block over the work of its weight along the structure's height. A block under 1.001 times its friction
// slides at 5e-4 m/s against the ramp's damping of 100 1/s. A structure of 1 m is at rest below 4e-4 m/s. A slower block falls by less than
// a tenth of a millimetre during a shock.
constexpr double rest_energy = 1e-8;
constexpr double far_over = 0.05;  // rad
// What falls, while it is held back: of its thickness, how far it may come in the time of the ramp; a twentieth of it as long after it.
constexpr double held_way = 0.01;
constexpr double looks = 25000;  // at a ramp, in its longest time
constexpr int quiet_looks = 10;  // looks at rest one after the other: what bounces is at rest for an instant
constexpr int most_rounds = 4;   // of holding back, each with the blocks that would not stand in the one before

// Blocks that still move, and blocks that fall: lower than at the start by half their thinnest extent, the criterion of `Collapse`.
class Unrest {
 public:
  Unrest(const Model& m, const State& s) : model_(m), state_(s), start_(s.pose), down_(m.gravity.normalized()) {
    double low = 1e300, high = -1e300;
    for (int b = 0; b < m.nblock; ++b) {
      if (m.kind[z(b)] != Kind::moving) continue;
      const double at = down_.dot(m.rest[z(b)]), edge = m.smallest_edge[z(b)];
      low = std::min(low, at - edge / 2), high = std::max(high, at + edge / 2);
    }
    const double g = m.gravity.norm() > 0 ? m.gravity.norm() : standard_g;  // for loads without gravity, its usual value
    square_ = 2 * rest_energy * g * std::max(0.0, high - low);
  }
  bool falls(int b) const { return sunk(b) > 0.5 * model_.thickness[z(b)]; }
  // Has toppled, to where it may lie at rest. Elastic structures lean by less.
  bool toppled(int b) const { return tilt(b) > far_over; }
  bool moves(int b) const { return square(b) > square_; }
  // Blocks that are not where they were built: no chain of joints that have kept leads from them to the ground. What settles or leans with
  // its support has its place. Without joints, what has fallen or toppled.
  std::vector<int> astray() const {
    const std::vector<std::uint8_t> had = borne([](const Joint&) { return true; });
    const std::vector<std::uint8_t> has = borne([&](const Joint& j) { return !parted(j); });
    return count([&](int b) { return had[z(b)] != 0 ? has[z(b)] == 0 : falls(b) || toppled(b); });
  }
  // Blocks that are not where they were built, and blocks that still move.
  std::vector<int> restless() const {
    const std::vector<int> gone = astray();
    return count([&](int b) { return moves(b) || std::ranges::binary_search(gone, b); });
  }
  // The force that moves it against the damping, over its weight, exceeds `share`.
  bool unbalanced(int b, double share) const {
    const double speed = share * model_.gravity.norm() / model_.damping.mass;
    return square(b) > speed * speed;
  }
  // True if every block that does not fall is at rest.
  bool ended() const {
    return count([&](int b) { return moves(b) && !falls(b); }).empty();
  }
  // True if every block is at rest, or has fallen past the ground.
  bool all_rest() const {
    return std::ranges::includes(blocks_past_ground(model_, state_), count([&](int b) { return moves(b); }));
  }
  // Of these, what does not come to rest, or only after a fall; the others have slid or leaned to where they rest.
  std::vector<int> falling(const std::vector<int>& of) const {
    return count([&](int b) { return (moves(b) || falls(b)) && std::ranges::binary_search(of, b); });
  }
  double share_of_mass(const std::vector<int>& blocks) const {
    double all = 0, share = 0;
    for (int b = 0; b < model_.nblock; ++b)
      if (model_.kind[z(b)] == Kind::moving) all += model_.mass[z(b)];
    for (const int b : blocks) share += model_.mass[z(b)] / all;
    return share;
  }
  std::vector<int> count(const std::function<bool(int b)>& is) const {
    std::vector<int> out;
    for (int b = 0; b < model_.nblock; ++b)
      if (model_.kind[z(b)] == Kind::moving && is(b)) out.push_back(b);
    return out;
  }

  double square(int b) const {  // m2/s2, of the speed of translation and rotation
    return state_.motion.v[z(b)].squaredNorm() + state_.motion.w[z(b)].dot(state_.motion.spin_momentum[z(b)]) / model_.mass[z(b)];
  }
  std::vector<double> squares() const {
    std::vector<double> out(z(model_.nblock), 0);
    for (int b = 0; b < model_.nblock; ++b)
      if (model_.kind[z(b)] == Kind::moving) out[z(b)] = square(b);
    return out;
  }

 private:
  // The two sides of a joint have moved apart by half of the thinner block, or rotated against each other.
  bool parted(const Joint& joint) const {
    const auto way = [&](int b, const Vec3& arm) {
      return Vec3(state_.pose.u[z(b)] - start_.u[z(b)] + state_.pose.q[z(b)] * arm - start_.q[z(b)] * arm);
    };
    const auto rotated = [&](int b) { return Quat(Quat(state_.pose.q[z(b)]) * Quat(start_.q[z(b)]).conjugate()); };
    const double thinner = std::min(thickness(joint.a), thickness(joint.b));
    return (way(joint.b, joint.arm_b) - way(joint.a, joint.arm_a)).norm() > 0.5 * thinner ||
           rotated(joint.a).angularDistance(rotated(joint.b)) > far_over;
  }
  double thickness(int b) const { return model_.kind[z(b)] == Kind::moving ? model_.thickness[z(b)] : 1e300; }
  // Blocks that such joints lead to what stays in place.
  std::vector<std::uint8_t> borne(const std::function<bool(const Joint&)>& such) const {
    std::vector<std::vector<int>> next(z(model_.nblock));
    for (int j = 0; j < model_.njoint; ++j)
      if (const Joint& joint = model_.joint[z(j)]; such(joint)) next[z(joint.a)].push_back(joint.b), next[z(joint.b)].push_back(joint.a);
    std::vector<std::uint8_t> out(z(model_.nblock));
    std::vector<int> open;
    for (int b = 0; b < model_.nblock; ++b)
      if (model_.kind[z(b)] != Kind::moving) out[z(b)] = 1, open.push_back(b);
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      for (const int b : next[z(at)])
        if (out[z(b)] == 0) out[z(b)] = 1, open.push_back(b);
    }
    return out;
  }
  double sunk(int b) const { return down_.dot(state_.pose.u[z(b)] - start_.u[z(b)]); }                  // m
  double tilt(int b) const { return Quat(state_.pose.q[z(b)]).angularDistance(Quat(start_.q[z(b)])); }  // rad

  const Model& model_;
  const State& state_;
  const BlockPoses start_;
  const Vec3 down_;
  double square_ = 0;  // m2/s2, square of the speed below which a block is at rest
};

Wave rising(double time, double value) { return make_table({0, time}, {0, value}, true); }
Wave fading(double time) { return make_table({0, time}, {1, 0}, true); }

// The model of the ramp: without what moves the ground, damped. Blocks that are `still` are fixed.
Model slow_model(const Model& m, double time, const std::vector<std::uint8_t>& still) {
  Model slow = m;
  slow.grounds.clear(), slow.tilts.clear(), slow.prescribed_motions.clear();
  slow.damping.mass = 20 / time;
  slow.damping_all = slow.damping_explicit = false;
  slow.analysis.levels = 1;
  slow.analysis.sleep = false;  // time begins anew after it
  for (std::size_t b = 0; b < still.size(); ++b)
    if (still[b]) slow.kind[b] = Kind::fixed;
  return slow;
}

// s, of the ramp: that of the scene, or the usual one, longer where what moves is slow. Critical damping is 20 over it. `borne`: kg, of
// what moves with a block besides its own mass [nblock]; empty: none.
double duration_of(const Scene& scene, const Prepared& p, const std::vector<std::uint8_t>& still, const std::vector<double>& borne) {
  if (scene.analysis.ramp_time > 0) return scene.analysis.ramp_time;
  const double frequency = lowest_frequency(p.model, p.state, still, borne);
  return frequency > 0 ? std::max(ramp_seconds, slow_ramp / frequency) : ramp_seconds;
}

// What a ramp leaves of the state: poses and what joints and contacts remember. Velocities and time are those of before it. Joints between
// blocks that the ramp holds have no forces in it, so that its sum of forces says nothing.
void begin_anew(const Model& m, const State& before, State& s) {
  s.motion.v = before.motion.v, s.motion.spin_momentum = before.motion.spin_momentum;
  s.motion.w.assign(s.motion.w.size(), Vec3::Zero());
  s.time = TimeStep{};
  s.time.dt = before.time.dt, s.time.dt_target = before.time.dt_target;
  s.energy = Energy{};
  s.cache.lazy_rotation = before.cache.lazy_rotation;
  s.observed.momentum_residual = before.observed.momentum_residual;
  s.contacts.list.bound_updated_at = std::numeric_limits<int>::min();  // at once: the steps begin anew, and nothing is held any more
  find_islands(m, s);
}

// Steps of a model of the ramp from rest; velocities and time are given back, and the state that is still. `what` happens, until `most` s
// at the latest. Returns the state before.
State ramp(const Model& slow, Prepared& p, const std::vector<std::uint8_t>& still, int threads, const StartTold& told,
           const std::string& what, double most, const std::function<bool()>& ended, bool every_step = false) {
  State& s = p.state;
  State before = s;
  s.motion.v.assign(s.motion.v.size(), Vec3::Zero());
  s.motion.spin_momentum.assign(s.motion.v.size(), Vec3::Zero());
  find_islands(slow, s);
  Solver solver(slow, s, p.range, threads);
  using Clock = std::chrono::steady_clock;
  Clock::time_point due = Clock::now();
  do {
    const double next = s.time.t + (every_step ? 0 : most / looks);
    while (solver.advance({.next = next}) == Solver::Stop::ledger) continue;
    if (is_interrupted()) throw Interrupted("interrupted while the structure came to rest, before the first step; nothing is written");
    if (told && Clock::now() >= due) {
      told(fmt::format("before the run, {}: {:.2f} of at most {:.3g} s", what, s.time.t, most));
      due = Clock::now() + std::chrono::milliseconds(100);
    }
  } while (!solver.broken() && !ended());
  if (!still.empty()) Held{still, before}.give_back(p.model, s);
  begin_anew(p.model, before, s);
  return before;
}

// The weights come as if the ground accelerated downwards by g at first, and by nothing at last.
Model gravity_model(const Prepared& p, double time, const std::vector<std::uint8_t>& still, bool damp_loose) {
  Model slow = slow_model(p.model, time, still);
  slow.damping_all = damp_loose;
  slow.grounds = {{fading(time), p.model.gravity}};
  for (auto& load : slow.force_loads) load.wave = rising(time, value(load.wave, 0));
  return slow;
}

// True after the ramp, once all is at rest at some looks one after the other, or after the longest time.
class Over {
 public:
  Over(const State& s, double time) : state_(s), time_(time) {}
  template <class F>
  bool operator()(F&& at_rest) {
    for_ = state_.time.t >= time_ && at_rest() ? for_ + 1 : 0;
    return for_ >= quiet_looks || state_.time.t >= ramp_limit * time_;
  }

 private:
  const State& state_;
  const double time_;
  int for_ = 0;
};

}  // namespace

Unsteady& Unsteady::operator+=(const Unsteady& more) {
  const auto add = [](std::vector<int>& to, const std::vector<int>& from) {
    to.insert(to.end(), from.begin(), from.end());
    std::ranges::sort(to);
  };
  add(moved, more.moved), add(falls, more.falls);
  return *this;
}

void Held::give_back(const Model& m, State& s) const {
  const auto holds = [&](int b) { return block[z(b)] || m.kind[z(b)] != Kind::moving; };
  for (int b = 0; b < m.nblock; ++b)
    if (block[z(b)]) s.pose.u[z(b)] = state.pose.u[z(b)], s.pose.q[z(b)] = state.pose.q[z(b)];
  for (int j = 0; j < m.njoint; ++j) {
    const Joint& joint = m.joint[z(j)];
    if (!holds(joint.a) || !holds(joint.b)) continue;
    s.joints.memory[z(j)] = state.joints.memory[z(j)];
    for (int i = joint.first_point; i < joint.first_point + joint.type->points; ++i) s.joints.history[z(i)] = state.joints.history[z(i)];
    if (!s.joints.crushed.empty()) s.joints.crushed[z(j)] = state.joints.crushed[z(j)];
  }
}

// What falls is known after a first ramp, and has fallen. Then all begins anew, at the pace of what stands, and what falls is held back
// while the others take their whole weight.
Unsteady ramp_gravity(const Scene& scene, Prepared& p, const std::vector<std::uint8_t>& still, int threads, bool damp_loose,
                      const StartTold& told) {
  const double time = duration_of(scene, p, still, {});
  const bool push = scene.push.quasi_static();  // asks for what comes to rest in the end, if only a small part falls
  const Model first = gravity_model(p, time, still, damp_loose);
  const Unrest unrest(first, p.state);
  Over over(p.state, time);
  Unsteady out;
  const auto at_rest = [&] {
    return unrest.ended() &&
           (!push || unrest.all_rest() || unrest.share_of_mass(unrest.falling(unrest.restless())) >= scene.analysis.collapse_fraction);
  };
  const State before = ramp(first, p, still, threads, told, "gravity comes slowly", ramp_limit * time, [&] {
    const bool ended = over(at_rest);
    if (ended) out.moved = unrest.restless(), out.falls = unrest.falling(out.moved);
    return ended;
  });
  if (out.moved.empty() || push) return out;
  State fallen = std::exchange(p.state, before);
  Unsteady held = out;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<std::uint8_t> others = still;
    others.resize(z(p.model.nblock));
    for (const int b : held.moved) others[z(b)] = 1;
    const double pace = duration_of(scene, p, others, {});
    Over all_over(p.state, pace);
    HeldBack back(p.model, p.state, held.moved);
    Unsteady more;  // does not stand under what falls while it is still there
    const auto ended = [&] {
      back.bound((p.state.time.t < pace ? held_way : held_way / 20) / pace);
      const bool is = all_over(
          [&] { return unrest.count([&](int b) { return unrest.moves(b) && !std::ranges::binary_search(held.moved, b); }).empty(); });
      if (is) std::ranges::set_difference(unrest.restless(), held.moved, std::back_inserter(more.moved));
      if (is) more.falls = unrest.falling(more.moved);
      return is;
    };
    ramp(gravity_model(p, pace, still, damp_loose), p, still, threads, told, "the weight of what stands comes, beside what falls",
         ramp_limit * pace, ended, true);
    if (more.moved.empty()) {
      p.fallen = fallen.pose;
      return held;
    }
    held += more;
    p.state = before;
  }
  p.state = std::move(fallen);
  return out;
}

std::vector<int> lower_blocks(const Scene& scene, Prepared& p, const Resting& resting, int threads, const StartTold& told) {
  const Model& m = p.model;
  const std::vector<std::uint8_t>& lowered = resting.lies();
  std::vector<std::uint8_t> still(z(m.nblock));
  for (int b = 0; b < m.nblock; ++b) still[z(b)] = lowered[z(b)] == 0 && resting.bears()[z(b)] == 0;
  const double time = duration_of(scene, p, still, resting.borne(m));
  Model slow = slow_model(m, time, still);
  slow.damping_all = true;
  for (auto& load : slow.force_loads) {
    const double full = value(load.wave, 0);
    load.wave = lowered[z(load.block)] != 0 ? rising(time, full) : make_table({0, time}, {full, full}, true);
  }
  for (int b = 0; b < m.nblock; ++b)
    if (lowered[z(b)] != 0)
      slow.force_loads.push_back({fading(time), -m.mass[z(b)] * weight_share(m, b) * m.gravity, b, Vec3::Zero(), false});
  const Unrest unrest(slow, p.state);
  std::vector<int> left;
  std::vector<double> halfway;  // m2/s2, of each block in the middle of a stage
  double began = 0, lasts = first_stage * time;
  int stage = 1;
  const std::string what = fmt::format("blocks without a joint are lowered onto the structure ({})", resting.blocks().size());
  const double most = lasts * (1 + softer + softer * softer);
  ramp(slow, p, still, threads, told, what, most, [&] {
    const double t = p.state.time.t;
    if (t < shortest * time) return false;
    left = resting.displaced(m, p.state);
    const auto keeps_place = [&](int b) { return !std::ranges::binary_search(left, b); };
    if (unrest.count([&](int b) { return keeps_place(b) && unrest.unbalanced(b, balanced); }).empty()) return true;
    if (halfway.empty() && t >= began + 0.5 * lasts) halfway = unrest.squares();
    if (t < began + lasts) return false;
    // What comes to rest has become slower, what slides or topples has not.
    const std::vector<int> moving = unrest.count([&](int b) { return keeps_place(b) && unrest.unbalanced(b, unbalanced); });
    std::ranges::copy_if(moving, std::back_inserter(left),
                         [&](int b) { return stage == stages || unrest.square(b) > 0.9 * halfway[z(b)]; });
    if (!left.empty() || moving.empty()) return true;
    began += lasts, lasts *= softer, ++stage;
    slow.damping.mass /= softer;
    halfway.clear();
    return false;
  });
  return left;
}

}  // namespace erbs::analysis
