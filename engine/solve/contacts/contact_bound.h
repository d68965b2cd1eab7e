// Time step that contacts allow: bounds of present contacts and slipping patches, coming impacts, predicted events, and bodies that must
// not pass others. Rates are gathered in every step; `ContactLimit` combines them with its matrices.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "engine/contact/overlap/overlap.h"
#include "engine/model/state.h"
#include "engine/solve/blocks/step_loads.h"
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

  // Of the time of a whole step, that of one without slow pairs: 82 of 480 us in the heap of a house.
  static constexpr double short_step = 0.15;

  // Pairs with a fast block, or of two loose ones.
  struct Part {
    double slip_omega2 = 0, event_rate = 0, dt = 0;  // 1/s2, 1/s, s
    int pairs = 0;                                   // with forces
  };
  using Parts = std::array<Part, 2>;

  // A step: `begin()` and the rates on each block; `begin_totals()` and those of all pairs, summed by each thread; `end()`.
  void begin(std::span<const int> blocks);
  void add(int b, double omega2, double impact_omega2) {
    double &sum = omega2_[std::size_t(b)], &impact = impact_omega2_[std::size_t(b)];
    sum += std::max(0.0, omega2);
    impact = std::max(impact, impact_omega2);
  }
  // Forces of slow pairs, summed by each thread for its blocks, if `is_split()`.
  void begin_slow(std::span<const int> blocks) {
    for (const int b : blocks) slow_wrench_[std::size_t(b)].setZero(), slow_force2_[std::size_t(b)] = 0;
  }
  void add_slow_to_a(int a, const PairWrench& w) {
    slow_wrench_[std::size_t(a)].head<3>() -= w.force, slow_wrench_[std::size_t(a)].tail<3>() += w.moment_a;
  }
  void add_slow_to_b(int b, const PairWrench& w) {
    slow_wrench_[std::size_t(b)].head<3>() += w.force, slow_wrench_[std::size_t(b)].tail<3>() += w.moment_b;
  }
  void square_slow_forces(std::span<const int> blocks, const StepLoads& loads);
  void begin_totals() { part_ = {}; }
  void add(const MotionBounds::PairBound& pair, const PairResult& r, Parts& to) const {
    Part& part = to[loose(pair.a, pair.b)];
    part.slip_omega2 = std::max(part.slip_omega2, r.slip_omega2);
    part.event_rate = std::max(part.event_rate, r.event_rate);
    ++part.pairs;
  }
  void add(const MotionBounds::PairBound& pair, const ContactForces::SeparatedPair& one, Parts& to) const {
    Part& part = to[loose(pair.a, pair.b)];
    part.event_rate = std::max(part.event_rate, one.event_rate);
  }
  void add(const Parts& more) {
    for (std::size_t i = 0; i < part_.size(); ++i) {
      part_[i].slip_omega2 = std::max(part_[i].slip_omega2, more[i].slip_omega2);
      part_[i].event_rate = std::max(part_[i].event_rate, more[i].event_rate);
      part_[i].pairs += more[i].pairs;
    }
  }
  void end(const ContactForces& forces, FormerJoints& former, Sleep& sleep, MotionBounds& motion, const StepLoads& loads, bool divides);
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
  // J/s2, sum over loose blocks of F^2 / m + M^T I^-1 M by slow pairs; s, the interval at which they err by little
  double slow_forces() const { return slow_forces_; }
  double longest_interval() const;
  int pairs(bool loose) const { return part_[loose].pairs; }  // with forces

 private:
  static constexpr std::uint8_t hastened = 2;  // in `PairList::fast`: since the last division
  void update(const ContactForces& forces, FormerJoints& former, Sleep& sleep);
  void divide(const ContactForces& forces, const FormerJoints& former, const StepLoads& loads);
  void hasten(const ContactForces& forces);
  template <class Slow>
  void find_slow_forces(const ContactForces& forces, const StepLoads& loads, Slow slow);
  double bears(int b) const;
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
  Parts part_;
  std::vector<Vec6> slow_wrench_;    // N, N m, of slow pairs [nblock]
  std::vector<double> slow_force2_;  // J/s2, F^2 / m + M^T I^-1 M of it [nblock]
  double slow_forces_ = 0;           // J/s2, sum over loose blocks
  double elsewhere_ = 0;             // 1/s2, greatest `on_block()` of blocks without a live pair
  double allowed_ = 0;
  double thinnest_ = 0;  // m, thinnest extent of all blocks
};

}  // namespace erbs
