// Length of the next time step. Present contacts, coming impacts and coming openings bound it (`time_step_bound.h`, `impact_bound.h`,
// `event_bound.h`).
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/count.h"
#include "engine/joints/event_bound.h"
#include "engine/joints/kinematics.h"
#include "engine/laws/yield.h"
#include "engine/model/levels.h"
#include "engine/solve/jolts.h"
#include "engine/solve/step.h"

namespace erbs {
namespace {

constexpr double trembling = 0.1;  // of the event rate of free fall; below it a body at rest only trembles under the thresholds of sleep

// Relative displacement of a joint and its rate, in the joint frame.
struct JointMotion {
  double gap[6], rate[6];  // m, rad; m/s, rad/s
};
JointMotion joint_motion(const Model& m, const State& s, int j) {
  const Joint& joint = m.joint[z(j)];
  const std::size_t a = z(joint.a), b = z(joint.b);
  const JointPose now = joint_pose(m, s, j);
  const Vec3 wa = s.motion.w[a], wb = s.motion.w[b];
  const Vec3 speed = now.frame.transpose() * (Vec3(s.motion.v[b]) - Vec3(s.motion.v[a]) + wb.cross(s.pose.q[b] * joint.arm_b) -
                                              wa.cross(s.pose.q[a] * joint.arm_a));
  const Vec3 spin = now.frame.transpose() * (wb - wa);
  JointMotion out;
  std::copy_n(now.gap, 6, out.gap);
  for (int i = 0; i < 3; ++i) out.rate[i] = speed[i], out.rate[3 + i] = spin[i];
  return out;
}

// Steps after which a bond may break if its blocks go on as they move: `soonest` times a power of two, or `latest`, not before that.
constexpr int soonest = 32;
int steps_to_break(const PointLaw& law, const JointType& type, const JointMotion& now, double dt, int latest) {
  const auto limits = scalar::yield_limits(law);
  for (int steps = soonest; steps < latest; steps *= 2) {
    double gap[6];
    for (int i = 0; i < 6; ++i) gap[i] = now.gap[i] + steps * dt * now.rate[i];
    if (scalar::face_bound(limits, gap, type.half_s, type.half_t, type.radius) > 0) return steps;
  }
  return latest;
}

// Event rate (1/s) of a bond that is about to break. Freed of it, its blocks swing with the energy E that it stores, at most as fast as the
// step was chosen for, and open or close again within half a swing. Each such event errs by up to E (omega dt)^2 / 4. 0 for blocks that
// swing already: their next steps are past prediction.
double break_rate(const JointType& type, const JointMotion& now, double omega, double allowance) {
  constexpr double still = 0.01;  // of the stored energy, at most, in a swing
  double stored = 0, power = 0;   // J; J/s2
  for (int i = 0; i < 6; ++i) {
    stored += 0.5 * type.stiffness[i] * now.gap[i] * now.gap[i];
    power += type.stiffness[i] * now.rate[i] * now.rate[i];
  }
  return power > still * 2 * stored * omega * omega ? 0 : omega * std::sqrt(event_share * 2 * stored / allowance);
}

// Rounds dt down to a scale of 32 steps per octave. Differences in the last digits, as sleeping blocks cause them, then leave dt equal.
double on_scale(double dt) { return std::exp2(std::floor(32 * std::log2(dt)) / 32); }

}  // namespace

double Solver::stable_dt(double critical) const {
  const double target = state_.time.dt_target, contacts = has_contacts_ ? contacts_.bound().stable_dt() : target;
  return contacts < target ? std::min(contacts, critical) : contacts > target ? std::max(contacts, critical) : critical;
}

// Judges the last step by the contacts at its end.
void Solver::judge_step() {
  if (!has_contacts_) return;
  const TimeStep& time = state_.time;
  const ContactBound& bound = contacts_.bound();
  const auto judge = [&](double taken, double allowed, auto stable) {
    if (taken > step_slack * allowed) long_steps_.add(taken / stable());
  };
  if (time.last_substeps == 1 || !bound.is_split()) return judge(time.last_dt, bound.allowed_dt(), [&] { return bound.stable_dt(); });
  for (const bool loose : {false, true})
    judge(interval_before(time, loose), bound.allowed_dt(loose), [&] { return bound.stable_dt(loose); });
}

// The step `now` follows what is allowed. It shrinks at once. It grows after 100 steps without a limit, and by half at most, because
// impacts are predicted only a few steps ahead. `steps`: since the last call; `since_limited` counts them.
double Solver::next_dt(double now, double allowed, double event, Part part, int steps, int& since_limited) const {
  if (event > 0) allowed = std::min(allowed, event);
  double dt = now;
  if (allowed < now) {
    dt = on_scale(0.95 * allowed);
    since_limited = 0;
  } else if (now < std::max(allowed, state_.time.dt_target) && (since_limited += steps) > 100) {
    if (part == Part::loose) allowed = std::min(allowed, contacts_.bound().longest_interval());
    if (allowed > 1.1 * now) dt = std::min(on_scale(0.95 * allowed), 1.5 * now);
    if (!may_grow(now, dt, part)) dt = now;
    since_limited = 0;
  }
  return dt;
}

double Solver::next_dt_of_all() {
  TimeStep& time = state_.time;
  return next_dt(time.dt, has_contacts_ ? contacts_.bound().allowed_dt() : time.dt_target, time.event_dt, Part::all, time.substeps,
                 time.steps_since_limited);
}

StepLimit Solver::limit() const {
  const TimeStep& time = state_.time;
  const double event = time.event_dt > 0 ? time.event_dt : std::numeric_limits<double>::infinity();
  const bool split = has_contacts_ && contacts_.bound().is_split();
  const double contacts = !has_contacts_ ? time.dt_target
                          : split        ? contacts_.bound().allowed_dt(false)
                                         : contacts_.bound().allowed_dt(),
               dt = split ? time.fast_dt : time.next_dt;
  if (std::min(event, contacts) > 1.2 * dt && dt < 0.9 * time.dt_target) return {StepLimit::By::growth, -1};
  if (event < std::min(contacts, time.dt_target)) return {StepLimit::By::event, -1};
  return has_contacts_ && contacts != time.dt_target ? contacts_.bound().step_limit(split) : StepLimit{};
}

void Solver::set_dt(double dt) {
  TimeStep& time = state_.time;
  if (dt == time.dt) return;
  time.dt = dt;
  time.start_t = time.t;
  time.start_step = time.step;
}

// Step and number of steps of the next macro step (levels.h). Fast and loose blocks have a step each, by the same rule. The shorter one is
// divided further, if need be, so that the longer one is a multiple of it; the cheapest number of steps counts.
void Solver::plan_macro_step(const SamplePlan& plan) {
  constexpr double worth = 1.2;  // steps: a shorter interval would gain little
  constexpr int wait = 1024;     // macro steps until blocks are divided again
  TimeStep& time = state_.time;
  const ContactBound& bound = contacts_.bound();
  time.next_substeps = 1;
  if (time.macro_steps_since_limited < 0) ++time.macro_steps_since_limited;
  if (has_contacts_ && bound.is_split() && divides(time) && bound.longest_interval() < worth * std::max(time.fast_dt, time.dt)) {
    contacts_.join_parts();
    time.macro_steps_since_limited = -wait;
  }
  if (!has_contacts_ || !bound.is_split()) {
    time.next_dt = next_dt_of_all();
    time.fast_dt = time.slow_dt = 0;
    return;
  }
  if (time.fast_dt == 0) time.fast_dt = time.slow_dt = time.dt, time.macro_steps_since_limited = 0;
  time.fast_dt = next_dt(time.fast_dt, bound.allowed_dt(false), time.event_dt, Part::fast, time.substeps, time.steps_since_limited);
  time.slow_dt = next_dt(time.slow_dt, bound.allowed_dt(true), time.slow_event_dt, Part::loose, 1, time.macro_steps_since_limited);
  if (const double longest = bound.longest_interval(); longest < time.slow_dt) {
    time.slow_dt = std::max(on_scale(longest), std::min(time.fast_dt, time.slow_dt));
    time.macro_steps_since_limited = 0;
  }
  time.next_dt = std::min(time.fast_dt, time.slow_dt);
  // Samples are taken at the start of macro steps: none is left out, and the last one is at the end.
  const double left = plan.end - (time.t + (time.substeps - 1) * time.dt),
               longest = std::min({time.slow_dt, left, plan.every * (1 + 1e-9)});
  double least = 1 / time.next_dt;  // cost of a second
  for (int steps = 2; steps <= most_steps(model_); ++steps) {
    const double dt = std::min(time.fast_dt, longest / steps), cost = (1 + (steps - 1) * ContactBound::short_step) / (steps * dt);
    if (dt > 0 && cost < least) least = cost, time.next_dt = dt, time.next_substeps = steps;  // beyond the end there is no time left
  }
}

// Event rate (1/s) of intact dry joints that are about to open for the first time. The kernel of intact joints evaluates nothing but their
// limits (`intact.h`), so they are evaluated here. In a structure of many joints the first opening of one is no significant event. In a
// structure of few joints it is, because a soft joint allows a long step. A run with `start = "rest"` has no gravity in its joints and
// bounces from the first step on, which `event_rate_at_start` has shortened.
double Solver::event_rate_of_first_openings() const {
  double event_rate = 0;
  if (model_.njoint > few_joints || !(state_.time.last_dt > 0) || model_.analysis.start == "rest") return event_rate;
  const double dt = state_.time.last_dt, allowance = event_allowance(model_, state_);
  for (int j = 0; j < model_.njoint; ++j) {
    const Joint& joint = model_.joint[z(j)];
    if (state_.joints.stage[z(j)] != JointStage::intact || model_.laws[z(joint.type->law)].has_bond()) continue;
    const JointMotion now = joint_motion(model_, state_, j);
    double before[6];
    for (int i = 0; i < 6; ++i) before[i] = now.gap[i] - dt * now.rate[i];
    event_rate = std::max(event_rate, foresee(model_, joint, before, now.gap, allowance));
  }
  // The error of an opening falls with the square of the step: at dt it is some event_rate^2 of the allowance. A change of dt that costs
  // far more is left alone. Factors of 4 to 20 serve m02_hop and h14_overlap_from_nothing alike; 1 is too few for m02_hop.
  if (event_rate > 1 && vibration(Part::all) * dt * dt / 8 > 10 * event_rate * event_rate * allowance) return 0;
  return event_rate / dt;
}

// The same of bonds that are about to break under loads that grow slowly. They break when the structure is nearly still, and set it
// swinging: a step that is short by then costs nothing, one that shortens afterwards errs by as much as it saves. So it is left as it is
// where its change would err by a hundredth of that, or, while all is elastic, by a fifth of what the ledger then bears: the bond may hold.
double Solver::event_rate_of_breaks() {
  constexpr double elastic_share = 2e-7;
  constexpr int most_joints = 256;  // the energy of one bond is little among more, and asking them takes a part of the step
  TimeStep& time = state_.time;
  const double dt = time.last_dt, allowance = event_allowance(model_, state_);
  if (model_.njoint > most_joints || time.step < time.bonds_due || !(dt > 0) || !(allowance > 0) || model_.analysis.start == "rest")
    return 0;
  double rate = 0;
  const int latest = 4 * std::clamp(2 * model_.njoint, 16, 128);  // steps; asking a structure at rest takes a twentieth of its time
  int next = latest;
  for (int j = 0; j < model_.njoint; ++j) {
    const JointType& type = *model_.joint[z(j)].type;
    const PointLaw& law = model_.laws[z(type.law)];
    if (state_.joints.stage[z(j)] != JointStage::intact || !law.has_bond()) continue;
    const JointMotion now = joint_motion(model_, state_, j);
    const int steps = steps_to_break(law, type, now, dt, latest);
    const double breaks = steps < latest ? break_rate(type, now, 2 / time.dt_target, allowance) : 0;
    if (breaks > 0) next = std::min(next, steps);
    if (steps == soonest) rate = std::max(rate, breaks);
  }
  time.bonds_due = time.step + next / (next == soonest ? 2 : 4);
  if (!(rate * dt > 1)) return 0;
  const double swing = vibration(Part::all) / 8;
  const bool elastic = !joints_.any_cracked() && state_.energy.contact_damping == 0;
  if (elastic && swing * dt * dt > elastic_share * state_.energy.reference) return 0;
  return swing < 0.01 * rate * rate * allowance ? rate : 0;
}

// Event rate (1/s) of intact joints whose blocks move apart or together at the start, so fast that in two steps they may yield, at once or
// as they swing back: until they have cracked nothing else predicts them. They err as one-sided springs do, each by its whole stiffness.
// A joint may also start beyond its limits, as that of a block that is let go on its edge. The strip that bears grows with the load, and a
// swing on it errs as a change of the step does. So do dry beds of few joints whose load acts at once: they open as they first swing.
double Solver::event_rate_at_start() const {
  const double allowance = event_allowance(model_, state_);
  double event_rate = 0;
  bool tilted = false;
  const bool sudden = model_.analysis.start == "rest" && model_.njoint <= few_joints;
  for (int j = 0; j < model_.njoint && allowance > 0; ++j) {
    const JointType& type = *model_.joint[z(j)].type;
    const JointStage stage = state_.joints.stage[z(j)];
    if (stage == JointStage::contact) continue;
    const JointMotion now = joint_motion(model_, state_, j);
    const auto limits = scalar::yield_limits(model_.laws[z(type.law)]);
    const auto may_yield = [&](double time) {
      double gap[6];
      for (int i = 0; i < 6; ++i) gap[i] = now.gap[i] + time * now.rate[i];
      return scalar::face_bound(limits, gap, type.half_s, type.half_t, type.radius) > 0;
    };
    const bool opens = sudden && stage == JointStage::intact && !model_.laws[z(type.law)].has_bond();
    tilted = tilted || opens || may_yield(0);
    if (stage != JointStage::intact) continue;
    double power = 0;
    for (int i = 0; i < 6; ++i) power += type.stiffness[i] * now.rate[i] * now.rate[i];
    if (power > 0 && (may_yield(2 * state_.time.dt) || may_yield(-2 * state_.time.dt)))
      event_rate = std::max(event_rate, std::sqrt(event_share / allowance * power));
  }
  return tilted ? std::max(event_rate, std::sqrt(vibration(Part::all) / (8 * allowance))) : event_rate;
}

// Time step that the next openings and closings allow (`event_bound.h`).
void Solver::foresee_events() {
  double event_rate = joints_.take_event_rate();
  const double first = std::max(event_rate_of_first_openings(), event_rate_of_breaks());
  if (!(budget_ > 0)) {
    if (first > 0) state_.time.event_dt = state_.time.event_dt > 0 ? std::min(state_.time.event_dt, 1 / first) : 1 / first;
    return;
  }
  event_rate = std::max(first, state_.time.last_dt > 0 ? event_rate / state_.time.last_dt : 0);
  if (has_contacts_) event_rate = std::max(event_rate, contacts_.bound().event_rate(false));
  const double jolts = jolt_rate(model_, state_, budget_, blow_share(model_));
  event_rate = std::max(event_rate, jolts);
  const double falls = (loads_.now().gravity - loads_.now().ground).norm() *
                       std::sqrt(ledger_.mass() / (8 * budget_));  // in flight the net force is the weight
  const auto step = [&](double rate) { return rate > 0 ? 1 / (rate > trembling * falls ? std::max(rate, falls) : rate) : 0; };
  state_.time.event_dt = step(event_rate);
  state_.time.slow_event_dt = has_contacts_ ? step(std::max(jolts, contacts_.bound().event_rate(true))) : 0;
}

// A change of dt changes the energy of a block that vibrates on its springs by F^2 (dt_1^2 - dt_0^2) / (8 m). A longer step is allowed
// while the sum over all blocks stays within the event tolerance. A fragment that vibrates from its start keeps the step of
// `event_rate_at_start` until it breaks or has struck something.
bool Solver::may_grow(double from, double dt, Part part) const {
  const bool as_at_start = model_.njoint > 0 && !joints_.any_cracked() && state_.energy.contact_damping == 0;
  if (dt > from && model_.analysis.start == "rest" && as_at_start) return false;
  const double budget = event_tolerance * state_.energy.reference, more = (dt * dt - from * from) / 8;
  if (!(dt > from) || !(budget > 0) || model_.analysis.unstable || sequential_) return true;
  return more * (part == Part::loose ? contacts_.bound().slow_forces() : vibration(part)) <= budget;
}

// Sum over the blocks of a part of F^2 / m, and of M^T I^-1 M for moments (J/s2).
double Solver::vibration(Part part) const {
  double sum = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] != Kind::moving) continue;
    if (part != Part::all && contacts_.bound().loose(b, b) != (part == Part::loose)) continue;
    const Vec6 w = block_wrench(b) + load_wrench(b);
    const Vec3 f = w.head<3>() + model_.mass[z(b)] * weight_share(model_, b) * (loads_.now().gravity - loads_.now().ground);
    const Quat& q = state_.pose.q[z(b)];
    const Vec3 m = q.conjugate() * Vec3(w.tail<3>());
    sum += model_.inverse_mass[z(b)] * f.squaredNorm() + m.dot(model_.inverse_inertia[z(b)] * m);
  }
  return sum;
}

}  // namespace erbs
