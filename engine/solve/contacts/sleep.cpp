#include "engine/solve/contacts/sleep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/base/count.h"

namespace erbs {
namespace {

constexpr double sleep_speed = 1e-6;         // of sqrt(g L); a poured heap (hard case 26) falls below it, down to 1e-12
constexpr double sleep_acceleration = 1e-4;  // of g
constexpr double wake_acceleration = 1e-3;   // of g; more than the dashpot forces that end when a contact at `sleep_speed` stops
constexpr double sleep_time = 0.5;           // of sqrt(L / g)
constexpr int search_every = 16;             // steps between two searches for still blocks

auto key_of(const ContactPair& p) { return std::tie(p.a, p.b, p.part_a, p.part_b); }

// The quaternion that a step without rotation leaves as it is: the drift scales it in each step by its deviation from unit length.
Quat fixed_point(Quat q) {
  for (int round = 0; round < 32; ++round) {
    const double e = q.x() * q.x() + q.y() * q.y() + q.z() * q.z() + q.w() * q.w() - 1, scale = 1 - e * (0.5 - 0.375 * e);
    const Quat next(q.w() * scale, q.x() * scale, q.y() * scale, q.z() * scale);
    if (next.coeffs() == q.coeffs()) break;
    q = next;
  }
  return q;
}

// Peak closing speed that a contact remembers after `time` at rest. `pair.cpp` lets it decay from step to step:
//   approach' = -approach / memory, memory = max(settings.memory, 30 depth / approach), down to the reference speed.
double forgotten(double peak_closing_speed, double depth, double time) {
  const ContactSettings settings;
  const double slow = 30 * depth, least = std::max(slow / settings.memory, settings.reference_speed);
  if (peak_closing_speed > least) {
    const double until = settings.memory * std::log(peak_closing_speed / least);
    if (time < until) return peak_closing_speed * std::exp(-time / settings.memory);
    time -= until;
    peak_closing_speed = least;
  }
  if (slow > 0) peak_closing_speed /= 1 + peak_closing_speed * time / slow;
  return std::max(peak_closing_speed, settings.reference_speed);
}

}  // namespace

Sleep::Sleep(const Model& model, State& state) : model_(model), state_(state), g_(model.gravity.norm()) {
  on_ = model.analysis.sleep && model.analysis.debris && model.analysis.solver != "sequential" && g_ > 0;
  if (!on_) return;
  if (state.sleep.asleep.empty()) {
    state.sleep.asleep.assign(z(model.nblock), 0);
    state.sleep.slept_at.assign(z(model.nblock), 0.0);
    state.sleep.last_motion.assign(z(model.nblock), std::numeric_limits<double>::infinity());
  }
  loaded_.assign(z(model.nblock), 0);
  for (const auto& push : model.force_loads) loaded_[z(push.block)] = 1;
}

bool Sleep::may_sleep(int b) const {
  return model_.kind[z(b)] == Kind::moving && state_.topology.loose[z(b)] && !state_.topology.joined[z(b)] && !loaded_[z(b)];
}

bool Sleep::rests(const ContactPair& p) const {
  const bool a = asleep(p.a), b = asleep(p.b);
  return (a || b) && (a || model_.kind[z(p.a)] == Kind::fixed) && (b || model_.kind[z(p.b)] == Kind::fixed);
}

void Sleep::add_resting(const Resting& one) {
  const PairResult& r = one.result;
  double *a = &resting_wrench_[8 * z(one.a)], *b = &resting_wrench_[8 * z(one.b)];
  for (int k = 0; k < 3; ++k) {
    a[k] -= r.wrench.force[k];
    b[k] += r.wrench.force[k];
    a[3 + k] += r.wrench.moment_a[k];
    b[3 + k] += r.wrench.moment_b[k];
  }
  elastic_ += r.elastic + r.tangential;
  ++touching_;
  ++contacts_[z(one.a)], ++contacts_[z(one.b)];
}

void Sleep::sort(const std::vector<int>& involved, const std::function<PairResult(int i)>& evaluate) {
  const std::vector<ContactPair>& pair = state_.contacts.list.pair;
  live_.clear();
  in_live_pairs_.clear();
  awake_.clear();
  mark_.assign(z(model_.nblock), 0);
  std::vector<Resting> before = std::exchange(resting_, {});
  auto old = before.begin();
  for (int i = 0; i < int(pair.size()); ++i) {
    const ContactPair& p = pair[z(i)];
    if (!rests(p)) {
      live_.push_back(i);
      for (const int b : {p.a, p.b})
        if (!std::exchange(mark_[z(b)], std::uint8_t(1))) in_live_pairs_.push_back(b);
      continue;
    }
    if (!p.touching) continue;
    const auto key = [](const Resting& r) { return std::tie(r.a, r.b, r.part_a, r.part_b); };
    while (old != before.end() && key(*old) < key_of(p)) ++old;
    if (old != before.end() && key(*old) == key_of(p)) resting_.push_back(*old);
    else resting_.push_back({p.a, p.b, p.part_a, p.part_b, i, evaluate(i)});
    resting_.back().pair = i;
  }
  std::ranges::sort(in_live_pairs_);
  for (const int b : involved)
    if (model_.kind[z(b)] != Kind::fixed && !asleep(b)) awake_.push_back(b);
  if (!on_) return;
  std::fill(mark_.begin(), mark_.end(), std::uint8_t(0));
  for (const int b : involved) mark_[z(b)] = 1;
  for (int b = 0; b < model_.nblock; ++b)
    if (!mark_[z(b)]) state_.sleep.last_motion[z(b)] = std::numeric_limits<double>::infinity();
  resting_wrench_.assign(z(model_.nblock), 0.0);
  contacts_.assign(z(model_.nblock), 0);
  elastic_ = touching_ = 0;
  for (const Resting& one : resting_) add_resting(one);
  add_omega2();
}

// Adds the rates of pairs at rest beyond the last update of the bound.
void Sleep::add_omega2() {
  if (!on_) return;
  omega2_.assign(z(model_.nblock), 0.0);
  for (const Resting& one : resting_) {
    const ContactPair& pair = state_.contacts.list.pair[z(one.pair)];
    omega2_[z(one.a)] += std::max(0.0, one.result.omega2_a - pair.bound_share_a);
    omega2_[z(one.b)] += std::max(0.0, one.result.omega2_b - pair.bound_share_b);
  }
}

bool Sleep::update(const Excitation& e, const double* contact_wrench, const ContactShapes& shapes, std::span<const ContactBlock> blocks) {
  if (!on_) return false;
  if (reach_.empty())
    for (std::size_t b = 0; b + 1 < shapes.first.size(); ++b) {
      reach_.push_back(0);
      for (int s = shapes.first[b]; s < shapes.first[b + 1]; ++s) reach_.back() = std::max(reach_.back(), shapes.part(z(s)).reach);
    }
  effective_gravity_ = e.gravity - e.ground;
  bool changed = wake_all();
  changed = wake_pressed(contact_wrench, blocks) || changed;
  if (state_.time.macro % std::max(1, search_every / state_.time.substeps) == 0)
    changed = try_sleep(e.kick, contact_wrench, blocks) || changed;
  slept_ += state_.sleep.count;
  return changed;
}

// Wakes all sleepers if gravity or the ground acceleration has changed; true if a block woke.
bool Sleep::wake_all() {
  SleepState& sleep = state_.sleep;
  if ((effective_gravity_ - sleep.effective_gravity).norm() <= sleep_acceleration * g_) return false;
  sleep.effective_gravity = effective_gravity_;
  for (double& at : sleep.last_motion)
    if (at < state_.time.t) at = state_.time.t;
  std::vector<int> woken;
  for (int b = 0; b < model_.nblock && sleep.count > 0; ++b)
    if (asleep(b)) woken.push_back(b);
  wake(woken);
  return !woken.empty();
}

bool Sleep::wake_pressed(const double* contact_wrench, std::span<const ContactBlock> blocks) {
  if (state_.sleep.count == 0) return false;
  std::vector<int> woken;
  for (const int b : in_live_pairs_)
    if (asleep(b) && motion_of(b, contact_wrench, blocks[z(b)]).acceleration > wake_acceleration * g_) woken.push_back(b);
  wake(woken);
  return !woken.empty();
}

void Sleep::wake(const std::vector<int>& blocks) {
  if (blocks.empty()) return;
  SleepState& sleep = state_.sleep;
  mark_.assign(z(model_.nblock), 0);
  for (const int b : blocks) mark_[z(b)] = 1;
  const auto since = [&](int b) { return asleep(b) ? sleep.slept_at[z(b)] : 0.0; };
  for (const Resting& r : resting_)
    if (mark_[z(r.a)] || mark_[z(r.b)]) {
      double& peak_closing_speed = state_.contacts.list.pair[z(r.pair)].peak_closing_speed;
      peak_closing_speed = forgotten(peak_closing_speed, r.result.depth, state_.time.t - std::max(since(r.a), since(r.b)));
    }
  for (const int b : blocks) {
    sleep.asleep[z(b)] = 0;
    sleep.last_motion[z(b)] = state_.time.t;
    --sleep.count;
  }
}

Sleep::Motion Sleep::motion_of(int b, const double* contact_wrench, const ContactBlock& block) const {
  const double* row = contact_wrench + 8 * z(b);
  const Vec3 force(row[0], row[1], row[2]), moment(row[3], row[4], row[5]);
  const Vec3 spin_up = block.rotation * (block.inverse_tensor * (block.rotation.transpose() * moment));
  return {block.v.norm() + block.w.norm() * reach_[z(b)],
          (force * block.inverse_mass + effective_gravity_).norm() + spin_up.norm() * reach_[z(b)]};
}

bool Sleep::try_sleep(double kick, const double* contact_wrench, std::span<const ContactBlock> blocks) {
  const double t = state_.time.t;
  std::vector<double>& last_motion = state_.sleep.last_motion;
  for (const int b : awake_) {
    const Motion motion = motion_of(b, contact_wrench, blocks[z(b)]);
    bool still = motion.speed <= sleep_speed * std::sqrt(g_ * model_.smallest_edge[z(b)]);
    if (may_sleep(b)) still = still && motion.acceleration <= sleep_acceleration * g_;
    if (!still || last_motion[z(b)] > t) last_motion[z(b)] = t;
  }
  const auto is_still = [&](int b) {
    return model_.kind[z(b)] == Kind::fixed || asleep(b) ||
           t - last_motion[z(b)] >= sleep_time * std::sqrt(model_.smallest_edge[z(b)] / g_);
  };
  for (const int b : awake_) mark_[z(b)] = may_sleep(b) && is_still(b);
  for (const int i : live_) {
    const ContactPair& p = state_.contacts.list.pair[z(i)];
    if (!p.touching) continue;
    if (!is_still(p.a)) mark_[z(p.b)] = 0;
    if (!is_still(p.b)) mark_[z(p.a)] = 0;
  }
  bool any = false;
  for (const int b : awake_) {
    if (!mark_[z(b)] || asleep(b)) continue;
    put_to_sleep(b, kick, contact_wrench);
    any = true;
  }
  return any;
}

// The kick of this step would change v0 to v1. The energy of this instant is v0 m v1 / 2 (`energy.h`), and all of it goes.
void Sleep::put_to_sleep(int b, double kick, const double* contact_wrench) {
  State& s = state_;
  const double* row = contact_wrench + 8 * z(b);
  const Vec3 force(row[0], row[1], row[2]), moment(row[3], row[4], row[5]);
  const Vec3 v0 = s.motion.v[z(b)], v1 = v0 + kick * (force * model_.inverse_mass[z(b)] + effective_gravity_);
  const Mat3 back = s.pose.q[z(b)].toRotationMatrix().transpose();
  const Vec3 spin = s.motion.spin_momentum[z(b)], p0 = back * spin, p1 = back * (spin + kick * moment);
  s.energy.sleep += 0.5 * (model_.mass[z(b)] * v0.dot(v1) + p1.dot(model_.inverse_inertia[z(b)] * p0));
  s.motion.v[z(b)].setZero();
  s.motion.w[z(b)].setZero();
  s.motion.spin_momentum[z(b)].setZero();
  s.pose.q[z(b)] = fixed_point(s.pose.q[z(b)]);
  s.sleep.asleep[z(b)] = 1;
  s.sleep.slept_at[z(b)] = s.time.t;
  ++s.sleep.count;
}

}  // namespace erbs
