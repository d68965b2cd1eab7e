#include "engine/solve/contacts/contact_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

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

void ContactBound::begin(std::span<const int> blocks) {
  for (const int b : blocks) {
    omega2_[z(b)] = sleep_.has_resting() ? sleep_.omega2(b) : 0;
    impact_omega2_[z(b)] = 0;
  }
}

void ContactBound::end(const ContactForces& forces, FormerJoints& former, Sleep& sleep, MotionBounds& motion, bool divides) {
  double bears = limit();
  if (limit_.due(bears)) {
    motion.update_all(&sleep);
    update(forces, former, sleep);
    bears = limit();
  }
  allowed_ = limited_by_passing(limited_by_slip(std::min(limit_.range().longest, bears)), forces, motion);
  if (divides) divide(forces, former);
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
    if (model_.kind[z(b)] == Kind::moving) elsewhere_ = std::max(elsewhere_, limit_.on_block(b, sleep_.omega2(b), 0));
  }
}

// Blocks with joints, or with a pair that is a former joint, are fast. A macro step of m steps leaves the others loose but for a few whose
// contacts do not bear it; the m with the least evaluations of contacts counts. Where many contacts would be fast, a structure still
// breaks: forces are large, and longer intervals would leave more in the ledger than they gain (tests/bench/README.md).
void ContactBound::divide(const ContactForces& forces, const FormerJoints& former) {
  constexpr double few_pairs = 0.05, many_pairs = 0.25, worth = 0.75;  // of all contacts; of the evaluations without levels
  constexpr int worth_asking = 16;                                     // steps; more gain little
  const int most = std::min(worth_asking, most_steps(model_));
  PairList& list = state_.contacts.list;
  const double dt = state_.time.fast_dt > 0 ? state_.time.fast_dt : state_.time.dt;
  std::vector<std::uint8_t> stiff(state_.topology.joined.begin(), state_.topology.joined.begin() + model_.nblock);
  for (int i = 0; i < int(list.pair.size()); ++i)
    if (former.of_pair(i).joint >= 0) stiff[z(list.pair[z(i)].a)] = stiff[z(list.pair[z(i)].b)] = 1;
  bool any = false;
  std::vector<int> bears(z(model_.nblock), most);  // steps in a macro step
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] != Kind::moving) continue;  // supports limit no step
    any = any || stiff[z(b)];
    const double allowed = limit_.allowed(limit_.on_block(b, omega2_[z(b)], 0), false);
    bears[z(b)] = stiff[z(b)] ? 0 : int(std::clamp(0.95 * allowed / dt, 1.0, 1.0 * most));
  }
  std::array<int, worth_asking + 1> pairs{};  // by the steps that they bear
  for (const ContactForces::ThreadPairs& found : forces.results())
    for (const ContactForces::Force& one : found.forces) {
      const ContactPair& pair = list.pair[z(one.pair)];
      ++pairs[z(std::min(bears[z(pair.a)], bears[z(pair.b)]))];
    }
  const int all = std::accumulate(pairs.begin(), pairs.end(), 0);
  list.fast.clear();
  if (!any || pairs[0] > many_pairs * all) return;
  double least = worth;
  int best = 1, short_of = 0;
  for (int m = 2; m <= most; ++m) {
    if ((short_of += pairs[z(m - 1)]) > few_pairs * all) break;
    const double share = (all + double(m - 1) * (pairs[0] + short_of)) / (double(m) * all);
    if (share < least) least = share, best = m;
  }
  if (best == 1) return;
  for (const int steps : bears) list.fast.push_back(steps < best);
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
