// How long the next step of a Solver is: what touches, what lands and what opens next bound it (contact_limit.h, landing.h, event_bound.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solve/event_bound.h"
#include "engine/solve/joint_geometry.h"
#include "engine/solve/step.h"

namespace erbs {
namespace {

constexpr double still = 0.1;   // of the haste of what falls: what rests and trembles below the bounds of sleep is no event
constexpr int few_joints = 16;  // of more, one that opens is no event to speak of
std::size_t z(int i) { return std::size_t(i); }

// The next step below on a scale of 32 to the octave: what differs in its last digits, as with blocks that sleep, then makes no difference.
double on_scale(double dt) { return std::exp2(std::floor(32 * std::log2(dt)) / 32); }

}  // namespace

// The step that has just been taken, by what touches where it led to.
void Solver::judge_step() {
  if (!contacts_ || !(state_.last_dt > step_slack * debris_.allowed_dt())) return;
  long_steps_.add(state_.last_dt / debris_.borne_dt());
}

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

// Joints that have not opened yet are passed in lanes that look no further than their limit (sound.h). In a structure of many blocks the
// first opening of one is no event to speak of; where there are few it is, at a step set by a soft bed. What starts without gravity in its
// joints bounces from the first step on: a change of dt would err by more than an opening.
double Solver::haste_of_first_openings() const {
  double haste = 0;
  if (model_.njoint > few_joints || !(state_.last_dt > 0) || model_.analysis.start == "rest") return haste;
  const double dt = state_.last_dt, allowance = event_allowance(model_, state_);
  for (int j = 0; j < model_.njoint; ++j) {
    const Joint& joint = model_.joint[z(j)];
    if (state_.tier[z(j)] != Tier::intact || !model_.laws[z(joint.type->law)].dry) continue;
    const std::size_t a = z(joint.a), b = z(joint.b);
    const JointPose now = joint_pose(model_, state_, j);
    const Vec3 wa = state_.w[a], wb = state_.w[b];
    const Vec3 speed = now.frame.transpose() *
                       (Vec3(state_.v[b]) - Vec3(state_.v[a]) + wb.cross(state_.q[b] * joint.arm_b) - wa.cross(state_.q[a] * joint.arm_a));
    const Vec3 spin = now.frame.transpose() * (wb - wa);
    double before[6];
    for (int i = 0; i < 3; ++i) before[i] = now.q[i] - dt * speed[i], before[3 + i] = now.q[3 + i] - dt * spin[i];
    haste = std::max(haste, foresee(model_, joint, before, now.q, allowance));
  }
  return haste / dt;
}

// The step that what opens and closes next allows (event_bound.h).
void Solver::foresee_events() {
  double haste = 0;
  for (std::vector<JointSums>* of : {&joint_sums_, &cracked_sums_})
    for (JointSums& sums : *of) haste = std::max(haste, std::exchange(sums.haste, 0.0));
  const double first = haste_of_first_openings();
  if (!(budget_ > 0)) {
    if (first > 0) state_.event_dt = state_.event_dt > 0 ? std::min(state_.event_dt, 1 / first) : 1 / first;
    return;
  }
  haste = std::max(first, state_.last_dt > 0 ? haste / state_.last_dt : 0);
  if (contacts_) haste = std::max(haste, debris_.haste());
  const double falls = (now_.gravity - now_.ground).norm() * std::sqrt(mass_ / (8 * budget_));  // in flight the net force is weight
  if (haste > still * falls) haste = std::max(haste, falls);
  state_.event_dt = haste > 0 ? 1 / haste : 0;
}

// What vibrates against its springs errs by F^2 dt^2 / (8 m) less of its energy in longer steps.
bool Solver::may_grow(double dt) const {
  const double budget = event_tolerance * state_.energy.reference, more = (dt * dt - state_.dt * state_.dt) / 8;
  if (!(dt > state_.dt) || !(budget > 0) || model_.analysis.unstable || sequential_) return true;
  return more * vibration() <= budget;
}

// The sum of F^2 / m of all blocks (J/s2), moments and inertias with it.
double Solver::vibration() const {
  double sum = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] != Kind::moving) continue;
    const Vec6 w = block_wrench(b) + load_wrench(b);
    const Vec3 f = w.head<3>() + model_.mass[z(b)] * (now_.gravity - now_.ground);
    const Quat& q = state_.q[z(b)];
    const Vec3 m = q.conjugate() * Vec3(w.tail<3>());
    sum += model_.inverse_mass[z(b)] * f.squaredNorm() + m.dot(model_.inverse_inertia[z(b)] * m);
  }
  return sum;
}

}  // namespace erbs
