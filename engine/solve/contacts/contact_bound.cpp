#include "engine/solve/contacts/contact_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/law/impact_bound.h"
#include "engine/model/levels.h"

namespace erbs {
namespace {

// Largest omega dt of a slipping patch, omega along its normal. Friction makes the stiffness unsymmetric, so a patch pressed near its edge
// may flutter (`dry_friction.h`). The dashpot of the contact ends the flutter, but an explicit step allows it only c dt / m = 1/4
// (`pair.cpp`): a viscous ratio of 1 / (8 omega dt), .12 here. The block of V10 with mu = .9 flutters more and more at 1.1, not at .8.
constexpr double max_slip_omega_dt = 1.0;
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

void ContactBound::initialise() {
  omega2_.assign(z(model_.nblock), 0.0);
  impact_omega2_.assign(z(model_.nblock), 0.0);
  thinnest_ = *std::ranges::min_element(model_.smallest_edge);
}

void ContactBound::begin() {
  for (const int b : sleep_.in_live_pairs()) {
    omega2_[z(b)] = sleep_.has_resting() ? sleep_.omega2(b) : 0;
    impact_omega2_[z(b)] = 0;
  }
  event_rate_ = slip_omega2_ = 0;
}

void ContactBound::end(const ContactForces& forces, FormerJoints& former, Sleep& sleep, MotionBounds& motion) {
  double bears = limit();
  if (limit_.due(bears)) {
    motion.update_all(&sleep);
    update(forces, former, sleep);
    bears = limit();
  }
  allowed_ = limited_by_slip(std::min(limit_.range().longest, bears));
  limit_passing(forces, motion);
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

StepLimit ContactBound::step_limit(bool of_joints) const {
  using enum StepLimit::By;
  const double now = of_joints ? joints_dt() : allowed_;
  if (now >= limit_.range().longest) return {};
  const bool stiff_only = of_joints && any_stiff();
  double most = 0;
  StepLimit out;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] != Kind::moving || (stiff_only && !stiff_[z(b)])) continue;
    const double pressed = limit_.on_block(b, omega2_[z(b)], 0), all = limit_.on_block(b, omega2_[z(b)], impact_omega2_[z(b)]);
    if (all > most) most = all, out = {all > 1.2 * pressed ? impact : state_.topology.joined[z(b)] ? joints : contacts, b};
  }
  if (of_joints) return out;
  const double bears = std::min(limit_.range().longest, limit_.allowed(most));
  if (limited_by_slip(bears) < bears) out = {slip, -1};
  return allowed_ < 0.99 * limited_by_slip(bears) ? StepLimit{passing, -1} : out;
}

double ContactBound::limited_by_slip(double dt) const {
  return slip_omega2_ > 0 ? std::min(dt, max_slip_omega_dt / std::sqrt(slip_omega2_)) : dt;
}

double ContactBound::limited_by_slip(const ContactForces::Force& force) {
  const double omega2 = force.result.slip_omega2;
  return omega2 > 0 ? max_slip_omega_dt / std::sqrt(omega2) : std::numeric_limits<double>::infinity();
}

void ContactBound::bound_elsewhere() {
  std::vector<std::uint8_t> here(z(model_.nblock), 0);
  for (const int b : sleep_.in_live_pairs()) here[z(b)] = 1;
  elsewhere_ = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    if (here[z(b)]) continue;
    omega2_[z(b)] = sleep_.omega2(b), impact_omega2_[z(b)] = 0;
    if (model_.kind[z(b)] == Kind::moving) elsewhere_ = std::max(elsewhere_, limit_.on_block(b, sleep_.omega2(b), 0));
  }
}

void ContactBound::find_stiff_blocks(const FormerJoints& former, const Sleep& sleep) {
  stiff_ = state_.topology.joined;
  for (const int i : sleep.live()) {
    if (former.of_pair(i).joint < 0) continue;
    const ContactPair& pair = state_.contacts.list.pair[z(i)];
    stiff_[z(pair.a)] = stiff_[z(pair.b)] = 1;
  }
}

double ContactBound::joints_dt() const {
  double stiff = 0, any = 0;
  for (int b = 0; sleep_.has_resting() && b < model_.nblock; ++b)
    if (sleep_.asleep(b)) any = std::max(any, limit_.on_block(b, omega2_[z(b)], 0));
  for (const int b : sleep_.in_live_pairs()) {
    if (model_.kind[z(b)] != Kind::moving) continue;
    any = std::max(any, limit_.on_block(b, omega2_[z(b)], 0));
    if (stiff_[z(b)]) stiff = std::max(stiff, limit_.on_block(b, omega2_[z(b)], impact_omega2_[z(b)]));
  }
  for (int b = 0; b < model_.nblock; ++b)
    if (stiff_[z(b)]) stiff = std::max(stiff, limit_.on_block(b, 0, 0));
  return std::min(limit_.range().longest, limit_.allowed(any_stiff() ? stiff : any));
}

double ContactBound::pair_dt(const MotionBounds::PairBound& pair, double slip_omega2, double event_rate, double apart) const {
  double rate = event_rate * event_rate;
  for (const int b : {pair.a, pair.b})
    if (model_.kind[z(b)] == Kind::moving)
      rate = std::max(rate, (stiff_[z(b)] ? limit_.common() : 0) + limit_.on_block(b, omega2_[z(b)], impact_omega2_[z(b)]));
  double dt = rate > 0 ? 1 / std::sqrt(rate) : std::numeric_limits<double>::infinity();
  if (slip_omega2 > 0) dt = std::min(dt, max_slip_omega_dt / std::sqrt(slip_omega2));
  const double speed = (bodies_.block[z(pair.a)].v - bodies_.block[z(pair.b)].v).norm();
  const double thin = std::min(model_.smallest_edge[z(pair.a)], model_.smallest_edge[z(pair.b)]);
  if (apart <= look_ahead * macro_dt(state_.time) * speed && speed * dt > 0.25 * thin) dt = 0.25 * thin / speed;
  return dt;
}

// No body may pass through another unseen: at most a quarter of the thinner body per step.
void ContactBound::limit_passing(const ContactForces& forces, const MotionBounds& motion) {
  if (motion.fastest_pair() * allowed_ <= 0.25 * (1 - MotionBounds::round_off) * thinnest_) return;
  const double soon = look_ahead * std::max(macro_dt(state_.time), state_.time.last_dt);
  const auto pass = [&](int i, double apart) {
    const MotionBounds::PairBound& pair = motion.pair(i);
    const double thin = std::min(model_.smallest_edge[z(pair.a)], model_.smallest_edge[z(pair.b)]);
    const double speed = (bodies_.block[z(pair.a)].v - bodies_.block[z(pair.b)].v).norm();
    if (apart <= soon * speed && speed * allowed_ > 0.25 * thin) allowed_ = 0.25 * thin / speed;
  };
  for (const ContactForces::ThreadPairs& found : forces.results()) {
    for (const ContactForces::Force& one : found.forces) pass(one.pair, one.result.apart);
    for (const ContactForces::SeparatedPair& one : found.separated) pass(one.pair, one.apart);
  }
}

}  // namespace erbs
