// Part of `Contacts` that bounds the time step: by present contacts, coming impacts, predicted events, and bodies that must not pass
// others.
#include <algorithm>
#include <cmath>

#include "engine/contact/law/frame.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/solve/contacts/contacts.h"

namespace erbs {
namespace {

// Largest omega dt of a slipping patch, omega along its normal. Friction makes the stiffness unsymmetric, so a patch pressed near its edge
// may flutter (`dry_friction.h`). The dashpot of the contact ends the flutter, but an explicit step allows it only c dt / m = 1/4
// (`pair.cpp`): a viscous ratio of 1 / (8 omega dt), .12 here. The block of V10 with mu = .9 flutters more and more at 1.1, not at .8.
constexpr double max_slip_omega_dt = 1.0;
// Times the event budget: least energy m v^2 of two blocks relative to each other for which events are predicted.
constexpr double foresee_threshold = 2;
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

// Predicts events of touching pairs with enough kinetic energy. With less, an event stays within the budget at any step.
void Contacts::foresee_touching(int thread) {
  if (!(settings_.event_budget > 0)) return;
  const double soon = 1.5 * std::max(state_.dt, state_.last_dt);
  for (ContactForce& one : thread_pairs_[z(thread)].forces) {
    const PairBound& pair = pair_bounds_[z(one.pair)];
    const ContactBlock &a = blocks_[z(pair.a)], &b = blocks_[z(pair.b)];
    const double square = (b.v - a.v).squaredNorm() + spin_[z(pair.a)] * spin_[z(pair.a)] + spin_[z(pair.b)] * spin_[z(pair.b)];
    if (!(square > foresee_threshold * settings_.event_budget * std::max(a.inverse_mass, b.inverse_mass))) continue;
    const PairBodies& bodies = cache_[z(one.pair)].bodies;
    const PairFrame frame{bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
    foresee(state_.contacts.pair[z(one.pair)], frame, settings_, soon, one.result);
  }
}

// Updates the bound: it then contains the present rates of all contacts. Former joints count with the rates of their joints.
void Contacts::update_bound() {
  update_all_poses(false);
  std::vector<ContactPair>& pair = state_.contacts.pair;
  std::vector<double> sum(z(model_.nblock), 0.0);
  const auto note = [&](int i, double a, double b) {
    if (pair[z(i)].former_joint) return;
    pair[z(i)].bound_share_a = former_joints_[z(i)].omega2_a = a;
    pair[z(i)].bound_share_b = former_joints_[z(i)].omega2_b = b;
    sum[z(pair[z(i)].a)] += a;
    sum[z(pair[z(i)].b)] += b;
  };
  for (int i = 0; i < int(pair.size()); ++i) note(i, 0, 0);
  sleep_.each_resting([&](int i, const PairResult& r) { note(i, r.omega2_a, r.omega2_b); });
  for (const ThreadPairs& found : thread_pairs_)
    for (const ContactForce& one : found.forces) note(one.pair, one.result.omega2_a, one.result.omega2_b);
  limit_.update_bound(shapes_, blocks_, sum, room_.front());
  sleep_.add_omega2();
  bound_elsewhere();
  for (const int b : sleep_.in_live_pairs()) omega2_[z(b)] = sleep_.has_resting() ? sleep_.omega2(b) : 0;
}

double Contacts::limit() const {
  const double most = std::max(elsewhere_, limit_.on_most(sleep_.in_live_pairs(), omega2_, impact_omega2_));
  return limit_.allowed(most);
}

double Contacts::stable_dt() const {
  if (allowed_ >= state_.last_dt) return allowed_;
  double most = elsewhere_;
  for (const int b : sleep_.in_live_pairs())
    if (model_.kind[z(b)] == Kind::moving) most = std::max(most, limit_.on_block(b, omega2_[z(b)], 0));
  const double bears = std::min(model_.dt_max, limit_.allowed(most));
  return limited_by_slip(bears);
}

double Contacts::limited_by_slip(double dt) const {
  return slip_omega2_ > 0 ? std::min(dt, max_slip_omega_dt / std::sqrt(slip_omega2_)) : dt;
}

// Greatest demand of blocks without a live pair: joined blocks, and sleepers as if awake, so that the bound is valid when one wakes.
void Contacts::bound_elsewhere() {
  std::vector<std::uint8_t> here(z(model_.nblock), 0);
  for (const int b : sleep_.in_live_pairs()) here[z(b)] = 1;
  elsewhere_ = 0;
  for (int b = 0; b < model_.nblock; ++b)
    if (!here[z(b)] && model_.kind[z(b)] == Kind::moving) elsewhere_ = std::max(elsewhere_, limit_.on_block(b, sleep_.omega2(b), 0));
}

// Records a coming impact. A former joint that closes again is no stiffer than its joint was, so it counts only while it touches: its
// blocks may then fall flat on other faces.
void Contacts::add_impact_bound(int i, double impact_omega2_a, double impact_omega2_b, bool touching) {
  if (!(impact_omega2_a > 0 || impact_omega2_b > 0) || (former_joints_[z(i)].joint >= 0 && !touching)) return;
  const PairBound& pair = pair_bounds_[z(i)];
  impact_omega2_[z(pair.a)] = std::max(impact_omega2_[z(pair.a)], impact_omega2_a);
  impact_omega2_[z(pair.b)] = std::max(impact_omega2_[z(pair.b)], impact_omega2_b);
}

// No body may pass through another unseen: at most a quarter of the thinner body per step.
void Contacts::limit_passing() {
  if (fastest_pair_ * allowed_ <= 0.25 * (1 - round_off) * thinnest_) return;
  const double soon = look_ahead * std::max(state_.dt, state_.last_dt);
  const auto pass = [&](int i, double apart) {
    const PairBound& pair = pair_bounds_[z(i)];
    const double thin = std::min(model_.smallest_edge[z(pair.a)], model_.smallest_edge[z(pair.b)]);
    const double speed = (blocks_[z(pair.a)].v - blocks_[z(pair.b)].v).norm();
    if (apart <= soon * speed && speed * allowed_ > 0.25 * thin) allowed_ = 0.25 * thin / speed;
  };
  for (const ThreadPairs& found : thread_pairs_) {
    for (const ContactForce& one : found.forces) pass(one.pair, one.result.apart);
    for (const SeparatedPair& one : found.separated) pass(one.pair, one.apart);
  }
}

}  // namespace erbs
