// Part of `Debris` that bounds the time step: by present contacts, coming impacts, predicted events, and bodies that must not pass others.
#include <algorithm>
#include <cmath>

#include "engine/contact/landing.h"
#include "engine/contact/view.h"
#include "engine/solve/debris.h"

namespace erbs {
namespace {

// Largest omega dt of a slipping patch, omega along its normal. Friction makes the stiffness unsymmetric, so a patch pressed near its edge
// may flutter (`dry_friction.h`). The dashpot of the contact ends the flutter, but an explicit step allows it only c dt / m = 1/4
// (`contact.cpp`): a viscous ratio of 1 / (8 omega dt), .12 here. The block of V10 with mu = .9 flutters more and more at 1.1, not at .8.
constexpr double rubbing_angle = 1.0;
// Times the event budget: least energy m v^2 of two blocks relative to each other for which events are predicted.
constexpr double worth_a_look = 2;
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

// Predicts events of touching pairs with enough kinetic energy. With less, an event stays within the budget at any step.
void Debris::foresee_touching(int thread) {
  if (!(settings_.event_budget > 0)) return;
  const double soon = 1.5 * std::max(state_.dt, state_.last_dt);
  for (Active& one : looked_[z(thread)].active) {
    const Waiting& pair = waiting_[z(one.pair)];
    const ContactBlock &a = blocks_[z(pair.a)], &b = blocks_[z(pair.b)];
    const double square = (b.v - a.v).squaredNorm() + spin_[z(pair.a)] * spin_[z(pair.a)] + spin_[z(pair.b)] * spin_[z(pair.b)];
    if (!(square > worth_a_look * settings_.event_budget * std::max(a.inverse_mass, b.inverse_mass))) continue;
    const PairBodies& bodies = lane_[z(one.pair)].bodies;
    const View view{bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
    foresee(state_.debris.pair[z(one.pair)], view, settings_, soon, one.result);
  }
}

// Updates the bound: it then contains the present rates of all contacts. Former joints count with the rates of their joints.
void Debris::count() {
  place_all(false);
  std::vector<Pair>& pair = state_.debris.pair;
  std::vector<double> sum(z(model_.nblock), 0.0);
  const auto note = [&](int i, double a, double b) {
    if (pair[z(i)].bed) return;
    pair[z(i)].counted_a = bed_[z(i)].rate_a = a;
    pair[z(i)].counted_b = bed_[z(i)].rate_b = b;
    sum[z(pair[z(i)].a)] += a;
    sum[z(pair[z(i)].b)] += b;
  };
  for (int i = 0; i < int(pair.size()); ++i) note(i, 0, 0);
  sleep_.each_resting([&](int i, const PairResult& r) { note(i, r.rate_a, r.rate_b); });
  for (const Looked& looked : looked_)
    for (const Active& one : looked.active) note(one.pair, one.result.rate_a, one.result.rate_b);
  limit_.count(shapes_, blocks_, sum, room_.front());
  sleep_.add_rates();
  ask_elsewhere();
  for (const int b : sleep_.pushed()) rate_[z(b)] = sleep_.holds() ? sleep_.rate(b) : 0;
}

double Debris::limit() const {
  const double most = std::max(elsewhere_, limit_.on_most(sleep_.pushed(), rate_, landing_));
  return limit_.allowed(most);
}

double Debris::borne_dt() const {
  if (allowed_ >= state_.last_dt) return allowed_;
  double most = elsewhere_;
  for (const int b : sleep_.pushed())
    if (model_.kind[z(b)] == Kind::moving) most = std::max(most, limit_.on_block(b, rate_[z(b)], 0));
  const double bears = std::min(model_.dt_most, limit_.allowed(most));
  return unless_it_rubs(bears);
}

double Debris::unless_it_rubs(double dt) const { return rubbing_ > 0 ? std::min(dt, rubbing_angle / std::sqrt(rubbing_)) : dt; }

// Greatest demand of blocks without a live pair: joined blocks, and sleepers as if awake, so that the bound is valid when one wakes.
void Debris::ask_elsewhere() {
  std::vector<std::uint8_t> here(z(model_.nblock), 0);
  for (const int b : sleep_.pushed()) here[z(b)] = 1;
  elsewhere_ = 0;
  for (int b = 0; b < model_.nblock; ++b)
    if (!here[z(b)] && model_.kind[z(b)] == Kind::moving) elsewhere_ = std::max(elsewhere_, limit_.on_block(b, sleep_.rate(b), 0));
}

// Records a coming impact. A former joint that closes again is no stiffer than its joint was, so it counts only while it touches: its
// blocks may then fall flat on other faces.
void Debris::land(int i, double landing_a, double landing_b, bool touching) {
  if (!(landing_a > 0 || landing_b > 0) || (bed_[z(i)].joint >= 0 && !touching)) return;
  const Waiting& pair = waiting_[z(i)];
  landing_[z(pair.a)] = std::max(landing_[z(pair.a)], landing_a);
  landing_[z(pair.b)] = std::max(landing_[z(pair.b)], landing_b);
}

// No body may pass through another unseen: at most a quarter of the thinner body per step.
void Debris::limit_passing() {
  if (fastest_pair_ * allowed_ <= 0.25 * (1 - round_off) * thinnest_) return;
  const double soon = look_ahead * std::max(state_.dt, state_.last_dt);
  const auto pass = [&](int i, double apart) {
    const Waiting& pair = waiting_[z(i)];
    const double thin = std::min(model_.smallest_edge[z(pair.a)], model_.smallest_edge[z(pair.b)]);
    const double speed = (blocks_[z(pair.a)].v - blocks_[z(pair.b)].v).norm();
    if (apart <= soon * speed && speed * allowed_ > 0.25 * thin) allowed_ = 0.25 * thin / speed;
  };
  for (const Looked& looked : looked_) {
    for (const Active& one : looked.active) pass(one.pair, one.result.apart);
    for (const Near& one : looked.near) pass(one.pair, one.apart);
  }
}

}  // namespace erbs
