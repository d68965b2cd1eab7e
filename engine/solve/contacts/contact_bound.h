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
    Part& part = part_of(pair);
    part.slip_omega2 = std::max(part.slip_omega2, r.slip_omega2);
    ++part.pairs;
    omega2_[std::size_t(pair.a)] += std::max(0.0, r.omega2_a - former.omega2_a);
    omega2_[std::size_t(pair.b)] += std::max(0.0, r.omega2_b - former.omega2_b);
    part.event_rate = std::max(part.event_rate, r.event_rate);
    if (former.joint < 0 || r.touching) add_impact(pair, r.impact_omega2_a, r.impact_omega2_b);
  }
  void add(const ContactForces::SeparatedPair& one, const MotionBounds::PairBound& pair, const FormerJoints::FormerJoint& former) {
    Part& part = part_of(pair);
    part.event_rate = std::max(part.event_rate, one.event_rate);
    // A former joint that closes again is no stiffer than its joint was: only while it touches may its blocks fall flat on other faces.
    if (former.joint < 0) add_impact(pair, one.impact_omega2_a, one.impact_omega2_b);
  }
  void end(const ContactForces& forces, FormerJoints& former, Sleep& sleep, MotionBounds& motion, bool divides);
  // `end()` may divide the blocks in two parts, each with a bound of its own (model/levels.h): fast ones, with joints or former joints or
  // with contacts that bear only a short step, and loose ones. All is one part where little would be gained.
  bool is_split() const { return !state_.contacts.list.fast.empty(); }
  bool loose(int a, int b) const {
    return is_split() && !state_.contacts.list.fast[std::size_t(a)] && !state_.contacts.list.fast[std::size_t(b)];
  }
  // Bound of blocks without a live pair: joined blocks, and sleepers as if awake, so that it is valid when one wakes.
  void bound_elsewhere();

  double allowed_dt() const { return allowed_; }                   // s, at most `StepRange::longest`
  double allowed_dt(bool loose) const { return part_[loose].dt; }  // s, of one part
  // s, of present contacts, without coming impacts; the last step is judged by it
  double stable_dt() const;
  double stable_dt(bool loose) const { return part_dt(loose, false); }
  StepLimit step_limit(bool of_fast) const;  // what limits `allowed_dt()`, or that of fast blocks
  // 1/s: one over the step that the next openings and closings allow (`event_bound.h`)
  double event_rate() const { return std::max(part_[0].event_rate, part_[1].event_rate); }
  double event_rate(bool loose) const { return is_split() ? part_[loose].event_rate : loose ? 0 : event_rate(); }
  int pairs(bool loose) const { return part_[loose].pairs; }  // with forces

 private:
  void add_impact(const MotionBounds::PairBound& pair, double omega2_a, double omega2_b) {
    double &a = impact_omega2_[std::size_t(pair.a)], &b = impact_omega2_[std::size_t(pair.b)];
    a = std::max(a, omega2_a);
    b = std::max(b, omega2_b);
  }
  void update(const ContactForces& forces, FormerJoints& former, Sleep& sleep);
  // Pairs with a fast block, or of two loose ones.
  struct Part {
    double slip_omega2 = 0, event_rate = 0, dt = 0;  // 1/s2, 1/s, s
    int pairs = 0;
  };
  Part& part_of(const MotionBounds::PairBound& pair) { return part_[loose(pair.a, pair.b)]; }
  void divide(const ContactForces& forces, const FormerJoints& former);
  double part_dt(bool loose, bool impacts) const;
  double limit() const;  // s, time step that contacts and joints allow, ...
  // s, ... and slipping patches
  static double limited_by_slip(double dt, double slip_omega2);
  double limited_by_slip(double dt) const { return limited_by_slip(dt, std::max(part_[0].slip_omega2, part_[1].slip_omega2)); }
  // s, at most `dt`, such that no body passes through another unseen
  double limited_by_passing(double dt, const ContactForces& forces, const MotionBounds& motion) const;

  const Model& model_;
  State& state_;
  const ContactBodies& bodies_;
  const Sleep& sleep_;
  ContactLimit limit_;
  OverlapRoom room_;
  std::vector<double> omega2_;         // 1/s2, of contacts beyond the bound of `limit_` [nblock]
  std::vector<double> impact_omega2_;  // 1/s2, of the stiffest face that may strike the block next; there is room for only one [nblock]
  Part part_[2];
  double elsewhere_ = 0;  // 1/s2, greatest `on_block()` of blocks without a live pair
  double allowed_ = 0;
  double thinnest_ = 0;  // m, thinnest extent of all blocks
};

}  // namespace erbs
