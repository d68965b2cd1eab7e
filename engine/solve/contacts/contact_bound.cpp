#include "engine/solve/contacts/contact_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/count.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/model/levels.h"

namespace erbs {
namespace {

// Largest omega dt of a slipping patch, omega along its normal. Friction makes the stiffness unsymmetric, so a patch pressed near its edge
// may flutter (`dry_friction.h`). The dashpot of the contact ends the flutter, but an explicit step allows it only c dt / m = 1/4
// (`pair.cpp`): a viscous ratio of 1 / (8 omega dt), .12 here. The block of V10 with mu = .9 flutters more and more at 1.1, not at .8.
constexpr double max_slip_omega_dt = 1.0;
// Share of the energy that the forces on a loose block may err by if they end within an interval H, F^2 H^2 / (8 m), and how many such
// errors all blocks may have together: as many as a sixth of them. A heap in which a block becomes fast lets its neighbours, each between
// fast and slow forces, err at once.
constexpr double block_share = 1e-9;
double interval_share(int blocks) { return block_share * std::max(16.0, blocks / 6.0); }

}  // namespace

void ContactBound::initialise() {
  omega2_.assign(z(model_.nblock), 0.0);
  impact_omega2_.assign(z(model_.nblock), 0.0);
  slow_wrench_.assign(z(model_.nblock), Vec6::Zero());
  slow_force2_.assign(z(model_.nblock), 0.0);
  thinnest_ = *std::ranges::min_element(model_.smallest_edge);
}

void ContactBound::begin(std::span<const int> blocks) {
  for (const int b : blocks) {
    omega2_[z(b)] = sleep_.has_resting() ? sleep_.omega2(b) : 0;
    impact_omega2_[z(b)] = 0;
  }
}

void ContactBound::end(const ContactForces& forces, FormerJoints& former, Sleep& sleep, MotionBounds& motion, const StepLoads& loads,
                       bool divides) {
  double bears = limit();
  if (limit_.due(bears)) {
    motion.update_all(&sleep);
    update(forces, former, sleep);
    bears = limit();
  }
  allowed_ = limited_by_passing(limited_by_slip(std::min(limit_.range().longest, bears)), forces, motion);
  if (divides) divide(forces, former, loads);
  else if (is_split()) hasten(forces);
  slow_forces_ = 0;
  for (int b = 0; is_split() && b < model_.nblock; ++b)
    if (loose(b, b)) slow_forces_ += slow_force2_[z(b)];
  for (const bool loose : {false, true})
    if (is_split()) part_[loose].dt = limited_by_passing(part_dt(loose, true), forces, motion);
}

// Updates the bound of `limit_`: it then contains the present rates of all contacts. Former joints count with the rates of their joints.
void ContactBound::update(const ContactForces& forces, FormerJoints& former, Sleep& sleep) {
  std::vector<ContactPair>& pair = state_.contacts.list.pair;
  std::vector<double> sum(z(model_.nblock), 0.0);
  const auto note = [&](int i, double a, double b) {
    if (pair[z(i)].former_joint) return;
    pair[z(i)].bound_share_a = former.of_pair(i).omega2_a = a;
    pair[z(i)].bound_share_b = former.of_pair(i).omega2_b = b;
    sum[z(pair[z(i)].a)] += a;
    sum[z(pair[z(i)].b)] += b;
  };
  for (int i = 0; i < int(pair.size()); ++i) note(i, 0, 0);
  sleep.each_resting([&](int i, const PairResult& r) { note(i, r.omega2_a, r.omega2_b); });
  for (const ContactForces::ThreadPairs& found : forces.results())
    for (const ContactForces::Force& one : found.forces) note(one.pair, one.result.omega2_a, one.result.omega2_b);
  limit_.update_bound(bodies_.shapes, bodies_.block, sum, room_);
  sleep.add_omega2();
  bound_elsewhere();
  for (const int b : sleep.in_live_pairs()) omega2_[z(b)] = sleep.has_resting() ? sleep.omega2(b) : 0;
}

double ContactBound::limit() const {
  const double most = std::max(elsewhere_, limit_.on_most(sleep_.in_live_pairs(), omega2_, impact_omega2_));
  return limit_.allowed(most);
}

double ContactBound::stable_dt() const {
  if (allowed_ >= state_.time.last_dt) return allowed_;
  double most = elsewhere_;
  for (const int b : sleep_.in_live_pairs())
    if (model_.kind[z(b)] == Kind::moving) most = std::max(most, limit_.on_block(b, omega2_[z(b)], 0));
  const double bears = std::min(limit_.range().longest, limit_.allowed(most));
  return limited_by_slip(bears);
}

StepLimit ContactBound::step_limit(bool of_fast) const {
  using enum StepLimit::By;
  if ((of_fast ? allowed_dt(false) : allowed_) >= limit_.range().longest) return {};
  double most = 0;
  StepLimit out;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] != Kind::moving || (of_fast && loose(b, b))) continue;
    const double pressed = limit_.on_block(b, omega2_[z(b)], 0), all = limit_.on_block(b, omega2_[z(b)], impact_omega2_[z(b)]);
    if (all > most) most = all, out = {all > 1.2 * pressed ? impact : state_.topology.joined[z(b)] ? joints : contacts, b};
  }
  if (of_fast) return out;
  const double bears = std::min(limit_.range().longest, limit_.allowed(most));
  if (limited_by_slip(bears) < bears) out = {slip, -1};
  return allowed_ < 0.99 * limited_by_slip(bears) ? StepLimit{passing, -1} : out;
}

double ContactBound::limited_by_slip(double dt, double slip_omega2) {
  return slip_omega2 > 0 ? std::min(dt, max_slip_omega_dt / std::sqrt(slip_omega2)) : dt;
}

void ContactBound::bound_elsewhere() {
  std::vector<std::uint8_t> here(z(model_.nblock), 0);
  for (const int b : sleep_.in_live_pairs()) here[z(b)] = 1;
  elsewhere_ = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    if (here[z(b)]) continue;
    omega2_[z(b)] = sleep_.omega2(b), impact_omega2_[z(b)] = 0;
    slow_force2_[z(b)] = 0;  // its last pairs are gone; a resumed run does not know what they bore
    if (model_.kind[z(b)] == Kind::moving) elsewhere_ = std::max(elsewhere_, limit_.on_block(b, sleep_.omega2(b), 0));
  }
}

// Blocks with joints, or with a pair that is a former joint, are fast. A macro step leaves the others loose but for a few whose contacts do
// not bear it; the length with the least evaluations of contacts counts. Where many contacts would be fast, a structure still breaks:
// forces are large, and longer intervals would leave more in the ledger than they gain (tests/bench/README.md).
void ContactBound::divide(const ContactForces& forces, const FormerJoints& former, const StepLoads& loads) {
  constexpr double few_pairs = 0.15, many_pairs = 0.25;  // of all contacts
  constexpr double worth = 0.8;                          // of the time without levels
  constexpr int least_pairs = 100;                       // without stiff blocks: with fewer, levels would save next to nothing
  constexpr int octaves = 4, parts = 16;                 // lengths that are tried: up to 16 steps, by sixteenths of an octave
  PairList& list = state_.contacts.list;
  const double dt = state_.time.fast_dt > 0 ? state_.time.fast_dt : state_.time.dt;
  std::vector<std::uint8_t> stiff(z(model_.nblock), 0);
  const auto stiffen = [&](int b) { stiff[z(b)] = model_.kind[z(b)] == Kind::moving; };  // supports limit no step
  for (int b = 0; b < model_.nblock; ++b)
    if (state_.topology.joined[z(b)]) stiffen(b);
  for (int i = 0; i < int(list.pair.size()); ++i)
    if (former.of_pair(i).joint >= 0) stiffen(list.pair[z(i)].a), stiffen(list.pair[z(i)].b);
  find_slow_forces(forces, loads, [&](int a, int b) { return !stiff[z(a)] && !stiff[z(b)]; });
  std::vector<int> steps_of(z(model_.nblock), octaves * parts);  // sixteenths of an octave above dt; -1: stiff
  const auto note = [&](int b, double step) {
    steps_of[z(b)] = std::min(steps_of[z(b)], std::max(0, int(parts * std::log2(0.95 * step / dt))));
  };
  for (int b = 0; b < model_.nblock; ++b)
    if (stiff[z(b)]) steps_of[z(b)] = -1;
    else if (model_.kind[z(b)] == Kind::moving) note(b, bears(b));
  for (const ContactForces::ThreadPairs& found : forces.results())
    for (const ContactForces::Force& one : found.forces)
      if (one.result.slip_omega2 > 0) note(list.pair[z(one.pair)].b, limited_by_slip(dt * (1 << octaves), one.result.slip_omega2));
  std::array<int, 2 + octaves * parts> pairs{};  // by what they bear, stiff ones first
  for (const ContactForces::ThreadPairs& found : forces.results())
    for (const ContactForces::Force& one : found.forces) {
      const ContactPair& pair = list.pair[z(one.pair)];
      ++pairs[z(1 + std::min(steps_of[z(pair.a)], steps_of[z(pair.b)]))];
    }
  const int all = std::accumulate(pairs.begin(), pairs.end(), 0);
  list.fast.clear();
  const bool any_stiff = std::ranges::count(stiff, 1) > 0;
  if (pairs[0] > many_pairs * all || (!any_stiff && all < least_pairs)) return;
  double least = worth;
  int best = 0, short_of = 0;
  for (int i = 1; i <= octaves * parts; ++i) {
    const double length = std::exp2(double(i) / parts), steps = std::ceil(length - 1e-9);
    short_of += pairs[z(i)];
    if (steps > most_steps(model_) || short_of > few_pairs * all) break;
    const double share = (1 + (steps - 1) * (short_step + double(pairs[0] + short_of) / all)) / length;
    if (share < least) least = share, best = i;
  }
  if (best == 0) return;
  for (const int b : steps_of) list.fast.push_back(b < best);
}

// Between two divisions: loose blocks that no longer bear the macro step become fast, and those that a fast block is about to strike, as
// long as they are few. In a blow the forces on the other side of a struck block rise as well.
void ContactBound::hasten(const ContactForces& forces) {
  constexpr double few_blocks = 0.1;
  constexpr int at_least = 8;  // a fragment may strike several bricks at once
  PairList& list = state_.contacts.list;
  int room = std::max(at_least, int(few_blocks * double(list.fast.size()))) - int(std::ranges::count(list.fast, hastened));
  const auto hasten = [&](int b) {
    if (room > 0 && model_.kind[z(b)] == Kind::moving && !list.fast[z(b)]) list.fast[z(b)] = hastened, --room;
  };
  const double interval = std::min(state_.time.slow_dt, most_steps(model_) * state_.time.fast_dt);
  for (const int b : sleep_.in_live_pairs())
    if (model_.kind[z(b)] == Kind::moving && bears(b) < interval) hasten(b);
  const auto strikes = [&](int i, double event_rate) {
    const ContactPair& pair = list.pair[z(i)];
    if (event_rate * interval > 1 && !loose(pair.a, pair.b)) hasten(pair.a), hasten(pair.b);
  };
  for (const ContactForces::ThreadPairs& found : forces.results())  // in the order of pairs, whatever threads there are
    for (const ContactForces::Force& one : found.forces) strikes(one.pair, one.result.event_rate);
  for (const ContactForces::ThreadPairs& found : forces.results())
    for (const ContactForces::SeparatedPair& one : found.separated) strikes(one.pair, one.event_rate);
}

// s, interval of a loose block: what its contacts and the faces that may strike it allow, and its slow forces.
double ContactBound::bears(int b) const {
  const double forces = slow_force2_[z(b)];
  const double allowed = limit_.allowed(limit_.on_block(b, omega2_[z(b)], impact_omega2_[z(b)]), false);
  return forces > 0 ? std::min(allowed, std::sqrt(8 * block_share * state_.energy.reference / forces)) : allowed;
}

double ContactBound::longest_interval() const {
  return slow_forces_ > 0 ? std::sqrt(8 * interval_share(model_.nblock) * state_.energy.reference / slow_forces_)
                          : std::numeric_limits<double>::infinity();
}

// For a division of the blocks, with the pairs that would be slow.
template <class Slow>
void ContactBound::find_slow_forces(const ContactForces& forces, const StepLoads& loads, Slow slow) {
  slow_wrench_.assign(z(model_.nblock), Vec6::Zero());
  slow_force2_.assign(z(model_.nblock), 0.0);
  for (const ContactForces::ThreadPairs& found : forces.results())
    for (const auto& [i, r] : found.forces) {
      const ContactPair& pair = state_.contacts.list.pair[z(i)];
      if (slow(pair.a, pair.b)) add_slow_to_a(pair.a, r.wrench), add_slow_to_b(pair.b, r.wrench);
    }
  square_slow_forces(sleep_.in_live_pairs(), loads);
}

// Of slow pairs and of the loads, which act with them. A block between a fast pair and a slow one bears large forces of both, though their
// sum may be small: what errs is that the slow one acts once and the fast one often.
void ContactBound::square_slow_forces(std::span<const int> blocks, const StepLoads& loads) {
  for (const int b : blocks) {
    if (model_.kind[z(b)] != Kind::moving || sleep_.asleep(b)) continue;
    Vec6& slow = slow_wrench_[z(b)];
    if (sleep_.has_resting()) slow += Eigen::Map<const Vec6>(sleep_.resting_wrench(b));
    if (loads.rows() != nullptr) slow += loads.wrench(b);
    slow.head<3>() += model_.mass[z(b)] * weight_share(model_, b) * (loads.now().gravity - loads.now().ground);
    const Vec3 moment = bodies_.block[z(b)].rotation.transpose() * slow.tail<3>();
    slow_force2_[z(b)] = model_.inverse_mass[z(b)] * slow.head<3>().squaredNorm() + moment.dot(model_.inverse_inertia[z(b)] * moment);
  }
}

double ContactBound::part_dt(bool loose, bool impacts) const {
  double most = 0;
  for (int b = 0; b < model_.nblock; ++b)
    if (model_.kind[z(b)] == Kind::moving && this->loose(b, b) == loose)
      most = std::max(most, limit_.on_block(b, omega2_[z(b)], impacts ? impact_omega2_[z(b)] : 0));
  return limited_by_slip(std::min(limit_.range().longest, limit_.allowed(most, !loose)), part_[loose].slip_omega2);
}

// No body may pass through another unseen: at most a quarter of the thinner body per step.
double ContactBound::limited_by_passing(double dt, const ContactForces& forces, const MotionBounds& motion) const {
  if (motion.fastest_pair() * dt <= 0.25 * (1 - MotionBounds::round_off) * thinnest_) return dt;
  const double soon = look_ahead * std::max(macro_dt(state_.time), state_.time.last_dt);
  const auto pass = [&](int i, double apart) {
    const MotionBounds::PairBound& pair = motion.pair(i);
    const double thin = std::min(model_.smallest_edge[z(pair.a)], model_.smallest_edge[z(pair.b)]);
    const double speed = (bodies_.block[z(pair.a)].v - bodies_.block[z(pair.b)].v).norm();
    if (apart <= soon * speed && speed * dt > 0.25 * thin) dt = 0.25 * thin / speed;
  };
  for (const ContactForces::ThreadPairs& found : forces.results()) {
    for (const ContactForces::Force& one : found.forces) pass(one.pair, one.result.apart);
    for (const ContactForces::SeparatedPair& one : found.separated) pass(one.pair, one.apart);
  }
  return dt;
}

}  // namespace erbs
