// Time step that contacts allow: bounds of present contacts and slipping patches, coming impacts, predicted events, and bodies that must
// not pass others. Rates are gathered in every step; `ContactLimit` combines them with its matrices.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "engine/contact/overlap/overlap.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/contact_forces.h"
#include "engine/solve/contacts/former_joints.h"
#include "engine/solve/contacts/motion_bounds.h"
#include "engine/solve/contacts/sleep.h"
#include "engine/solve/contacts/step_limit.h"
#include "engine/solve/contacts/time_step_bound.h"

namespace erbs {

class ContactBound {
 public:
  ContactBound(const Model& model, State& state, const StepRange& range, const ContactBodies& bodies, const Sleep& sleep)
      : model_(model), state_(state), bodies_(bodies), sleep_(sleep), limit_(model, state, range) {}
  void initialise();

  // A step: `begin()`, the rates of all pairs, `end()`.
  void begin();
  void add(const ContactForces::Force& force, const MotionBounds::PairBound& pair, const FormerJoints::FormerJoint& former) {
    const PairResult& r = force.result;
    slip_omega2_ = std::max(slip_omega2_, r.slip_omega2);
    omega2_[std::size_t(pair.a)] += std::max(0.0, r.omega2_a - former.omega2_a);
    omega2_[std::size_t(pair.b)] += std::max(0.0, r.omega2_b - former.omega2_b);
    event_rate_ = std::max(event_rate_, r.event_rate);
    if (former.joint < 0 || r.touching) add_impact(pair, r.impact_omega2_a, r.impact_omega2_b);
  }
  void add(const ContactForces::SeparatedPair& one, const MotionBounds::PairBound& pair, const FormerJoints::FormerJoint& former) {
    event_rate_ = std::max(event_rate_, one.event_rate);
    // A former joint that closes again is no stiffer than its joint was: only while it touches may its blocks fall flat on other faces.
    if (former.joint < 0) add_impact(pair, one.impact_omega2_a, one.impact_omega2_b);
  }
  void end(const ContactForces& forces, FormerJoints& former, Sleep& sleep, MotionBounds& motion);
  // s, interval that one pair allows (model/levels.h): all that acts on its two blocks, and its own coming events. After
  // `find_stiff_blocks()`.
  void find_stiff_blocks(const FormerJoints& former, const Sleep& sleep);
  double pair_dt(const ContactForces::Force& force, const MotionBounds::PairBound& pair) const {
    return pair_dt(pair, force.result.slip_omega2, force.result.event_rate, force.result.apart);
  }
  double steady_dt(const ContactForces::Force& force, const MotionBounds::PairBound& pair) const {
    return pair_dt(pair, force.result.slip_omega2, 0, -1);
  }
  double steady_dt(int a, int b, const PairResult& at_rest) const { return pair_dt({a, b}, at_rest.slip_omega2, 0, -1); }
  bool on_stiff_block(const MotionBounds::PairBound& pair) const { return stiff_[std::size_t(pair.a)] || stiff_[std::size_t(pair.b)]; }
  static double limited_by_slip(const ContactForces::Force& force);  // s; infinite if the patch does not slip
  double pair_dt(const ContactForces::SeparatedPair& one, const MotionBounds::PairBound& pair) const {
    return pair_dt(pair, 0, one.event_rate, one.apart);
  }
  // Bound of blocks without a live pair: joined blocks, and sleepers as if awake, so that it is valid when one wakes.
  void bound_elsewhere();

  // s, step of joints: all that acts on blocks with joints or former joints. Without any of these, of all touching blocks.
  double joints_dt() const;
  bool any_stiff() const { return std::ranges::find(stiff_, 1) != stiff_.end(); }
  double allowed_dt() const { return allowed_; }     // s, at most `StepRange::longest`
  double stable_dt() const;                          // s, of present contacts, without coming impacts; the last step is judged by it
  StepLimit step_limit(bool of_joints) const;        // what limits `allowed_dt()`, or `joints_dt()`
  double event_rate() const { return event_rate_; }  // 1/s: one over the step that the next openings and closings allow (`event_bound.h`)

 private:
  void add_impact(const MotionBounds::PairBound& pair, double omega2_a, double omega2_b) {
    double &a = impact_omega2_[std::size_t(pair.a)], &b = impact_omega2_[std::size_t(pair.b)];
    a = std::max(a, omega2_a);
    b = std::max(b, omega2_b);
  }
  void update(const ContactForces& forces, FormerJoints& former, Sleep& sleep);
  double pair_dt(const MotionBounds::PairBound& pair, double slip_omega2, double event_rate, double apart) const;
  double limit() const;                     // s, time step that contacts and joints allow, ...
  double limited_by_slip(double dt) const;  // s, ... and slipping patches
  void limit_passing(const ContactForces& forces, const MotionBounds& motion);

  const Model& model_;
  State& state_;
  const ContactBodies& bodies_;
  const Sleep& sleep_;
  ContactLimit limit_;
  OverlapRoom room_;
  std::vector<double> omega2_;         // 1/s2, of contacts beyond the bound of `limit_` [nblock]
  std::vector<double> impact_omega2_;  // 1/s2, of the stiffest face that may strike the block next; there is room for only one [nblock]
  std::vector<std::uint8_t> stiff_;    // blocks with joints or former joints, on which the bound of the structure acts [nblock]
  double elsewhere_ = 0;               // 1/s2, greatest `on_block()` of blocks without a live pair
  double allowed_ = 0, event_rate_ = 0, slip_omega2_ = 0;
  double thinnest_ = 0;  // m, thinnest extent of all blocks
};

}  // namespace erbs
