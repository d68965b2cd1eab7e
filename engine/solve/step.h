// One time step as a sequence of named phases, run by a persistent team of threads:
//   prepare the step, evaluate loads | contact forces, joint forces | barrier
//   add up contact forces | barrier | release joints | integrate: kick and drift of blocks | barrier
//   close the ledger, update the topology, choose the next step length
#pragma once
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/system/shares.h"
#include "engine/base/system/team.h"
#include "engine/joints/cracked/fading.h"
#include "engine/solve/blocks/integrate.h"
#include "engine/solve/blocks/step_loads.h"
#include "engine/solve/coarse_inertia.h"
#include "engine/solve/contacts/contacts.h"
#include "engine/solve/energy.h"
#include "engine/solve/joint_phase.h"
#include "engine/solve/long_steps.h"
#include "engine/solve/profile.h"
#include "engine/solve/sequential/sequential.h"

namespace erbs {

// When the next sample is due: at the first step at or after `next`, and at the step nearest to `end`.
struct SamplePlan {
  double next = std::numeric_limits<double>::infinity(), end = next;  // s
  bool wrenches = false;                                              // a sample has the wrenches on blocks
  double every = std::numeric_limits<double>::infinity();             // s, between two samples; a macro step is no longer

  bool due(double t, double dt) const { return t + 1e-9 * dt >= next || t >= end - 0.5 * dt; }
};

// The instant of a sample: all quantities at time t. The State has drifted on by then, save energies, joints and contacts.
struct SampleState {
  double t = 0, dt = 0, last_dt = 0;  // s, of the step that began at t, and of the one before
  Excitation excitation;              // means over the kick about t
  BlockPoses pose;
  MotionState before;  // half a step before t; the State has the values half a step after
  // Of joints and contacts, and of loads: N, N m about the centroid; empty unless the plan asks for them [nblock]
  std::vector<Vec6> block_wrench, load_wrench;
  // With levels: N, N m, impulses of the kick beyond the forces times its length; s, interval of loads before it; else empty [nblock]
  std::vector<Vec6> kick_excess;
  std::vector<double> since;
};

class Solver {
 public:
  Solver(const Model& model, State& state, const StepRange& range, int threads);

  // Runs steps until the ledger closes, at a sample or every few steps (`Ledger`), or until a number is not finite. The State is complete
  // then, fit for a checkpoint, and the team waits at its barrier.
  enum class Stop { none, ledger, sample };
  Stop advance(const SamplePlan& plan = {});
  // Without samples, until `stop()`, which is called whenever the ledger has closed.
  template <class F>
  void advance_until(F&& stop) {
    do advance();
    while (!broken_ && !stop());
  }

  void use(CoarseInertia& inertia);           // from now on; for relaxations
  void follow_closely() { closely_ = true; }  // poses, where an elastic ledger would show it; for time histories

  const SampleState& sample() const { return sample_; }
  bool broken() const { return broken_; }
  Vec6 block_wrench(int b) const;                                            // N, N m about the centroid, of joints and contacts
  Vec6 kick_wrench(int b) const;                                             // as `block_wrench`, over the kick of this step (levels.h)
  Vec6 load_wrench(int b) const;                                             // of loads; of a driven block the reaction that moves it
  std::vector<int> take_released() { return std::exchange(released_, {}); }  // joints released to contact since the last call
  std::vector<int> take_cracked() { return joints_.take_cracked(); }         // joints that cracked since then, in ascending order
  const Profile& profile() const { return profile_; }                        // of the steps of this Solver
  StepLimit limit() const;                                                   // what limits the time step now
  LongSteps take_long_steps() { return std::exchange(long_steps_, {}); }     // since the last call
  // s, time step that the present contacts allow; `critical` is the limit of the intact structure.
  double stable_dt(double critical) const;
  Contacts& contacts() { return contacts_; }
  const Contacts& contacts() const { return contacts_; }

 private:
  bool sampling() const { return stop_ != Stop::none; }
  bool timed() const;  // the times of the threads are taken in this step
  void prepare_step(const SamplePlan& plan);
  void work(int thread);
  void forces(int thread);
  void add_up_contacts(int thread);
  void transitions();
  void soften_inertia(int thread, Range mine);
  void integrate(int thread, Range mine);
  void close_step(const SamplePlan& plan);
  void begin_sample();
  void end_sample(bool wrenches);
  void note_excess(int b);
  void update_outdated();
  void note_sleep();
  void apply_prescribed_motions();
  void check_momentum();
  void refine_references();
  // time_step.cpp
  enum class Part { all, fast, loose };  // of the moving blocks (`ContactBound::divide`)
  double next_dt(double now, double allowed, double event, Part part, int steps, int& since_limited) const;
  double next_dt_of_all();
  void plan_macro_step(const SamplePlan& plan);
  void set_dt(double dt);
  void lap(Phase phase);
  double event_rate_of_first_openings() const;
  double event_rate_of_breaks();
  double event_rate_at_start() const;
  void foresee_events();
  bool may_grow(double from, double dt, Part part) const;
  double vibration(Part part) const;
  void judge_step();

  const Model& model_;
  State& state_;
  StepLoads loads_;
  JointPhase joints_;
  Fading fading_;
  Contacts contacts_;
  Ledger ledger_;
  std::optional<Sequential> sequential_;  // replaces the phases `forces` and `integrate`
  Rows contact_wrench_;                   // N, N m: wrenches of contacts once there are any, one row per block
  Rows contact_kick_;                     // the same with levels: impulse of the contacts that act in this step, over the kick
  CoarseInertia* inertia_ = nullptr;
  std::vector<VectorPack<6>> force_;  // N, N m: on blocks, for `inertia_`
  std::vector<BlockConstants> constants_;
  std::vector<BlockSums> block_sums_;   // per chunk
  std::vector<std::uint8_t> outdated_;  // blocks with a new reference pose
  std::vector<std::uint8_t> idle_;      // groups in which every block sleeps
  std::vector<int> released_;
  LongSteps long_steps_;
  Profile profile_;
  double searched_ = 0;  // s, until the last lap of the profile
  SampleState sample_;
  double budget_ = 0;  // J, `event_budget()` of this step
  Stop stop_ = Stop::none;
  bool broken_ = false, has_contacts_ = false, has_transitions_ = false;
  const bool may_have_levels_;
  bool closely_ = false;
  Shares joint_shares_, contact_shares_, block_shares_;
  Team team_;
};

}  // namespace erbs
