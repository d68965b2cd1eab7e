// How long the next step of a Solver is: what touches, what lands and what opens next bound it (contact_limit.h, landing.h, event_bound.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solve/event_bound.h"
#include "engine/solve/step.h"

namespace erbs {
namespace {

constexpr double still = 0.1;  // of the haste of what falls: what rests and trembles below the bounds of sleep is no event
std::size_t z(int i) { return std::size_t(i); }

// The next step below on a scale of 32 to the octave: what differs in its last digits, as with blocks that sleep, then makes no difference.
double on_scale(double dt) { return std::exp2(std::floor(32 * std::log2(dt)) / 32); }

}  // namespace

// The step follows the contacts: shorter at once, longer again after a while of calm, and then by no more than half, since what may land
// is looked for a few steps ahead only.
void Solver::follow_contacts() {
  State& s = state_;
  double allowed = contacts_ ? debris_.allowed_dt() : s.dt_goal;
  if (s.event_dt > 0) allowed = std::min(allowed, s.event_dt);
  double dt = s.dt;
  if (allowed < s.dt) {
    dt = on_scale(0.95 * allowed);
    s.calm = 0;
  } else if (s.dt < std::max(allowed, s.dt_goal) && ++s.calm > 100) {
    if (allowed > 1.1 * s.dt) dt = std::min(on_scale(0.95 * allowed), 1.5 * s.dt);
    if (!may_grow(dt)) dt = s.dt;
    s.calm = 0;
  }
  if (dt == s.dt) return;
  s.dt = dt;
  s.start_t = s.t;
  s.start_step = s.step;
}

// The step that what opens and closes next allows (event_bound.h).
void Solver::foresee_events() {
  double haste = 0;
  for (std::vector<JointSums>* of : {&joint_sums_, &cracked_sums_})
    for (JointSums& sums : *of) haste = std::max(haste, std::exchange(sums.haste, 0.0));
  if (!(budget_ > 0)) return;
  haste = state_.last_dt > 0 ? haste / state_.last_dt : 0;
  if (contacts_) haste = std::max(haste, debris_.haste());
  const double falls = (now_.gravity - now_.ground).norm() * std::sqrt(mass_ / (8 * budget_));  // in flight the net force is weight
  if (haste > still * falls) haste = std::max(haste, falls);
  state_.event_dt = haste > 0 ? 1 / haste : 0;
}

// What vibrates against its springs errs by F^2 dt^2 / (8 m) less of its energy in longer steps.
bool Solver::may_grow(double dt) const {
  const double budget = event_tolerance * state_.energy.reference, more = (dt * dt - state_.dt * state_.dt) / 8;
  if (!(dt > state_.dt) || !(budget > 0) || model_.analysis.unstable || sequential_) return true;
  double errs = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] != Kind::moving) continue;
    const Vec6 w = block_wrench(b) + load_wrench(b);
    const Vec3 f = w.head<3>() + model_.mass[z(b)] * (now_.gravity - now_.ground);
    const Quat& q = state_.q[z(b)];
    const Vec3 m = q.conjugate() * Vec3(w.tail<3>());
    errs += model_.inverse_mass[z(b)] * f.squaredNorm() + m.dot(model_.inverse_inertia[z(b)] * m);
  }
  return more * errs <= budget;
}

}  // namespace erbs
