// One time step as a sequence of named phases, run by a persistent team of threads:
//   prepare the step, evaluate loads | contact forces, joint forces | barrier
//   gather contact forces, release joints | integrate: kick and drift of blocks | barrier
//   close the ledger, update the topology, choose the next step length
#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/system/team.h"
#include "engine/joints/cracked/cracked.h"
#include "engine/joints/intact/intact.h"
#include "engine/joints/joint_forces.h"
#include "engine/solve/blocks/integrate.h"
#include "engine/solve/contacts/contacts.h"
#include "engine/solve/long_steps.h"
#include "engine/solve/sequential/sequential.h"

namespace erbs {

// The instant of a sample: all quantities at time t.
struct SampleState {
  double t = 0;
  Excitation excitation;  // means over the kick about t
  // Velocities and spin momenta half a step before t. During `sampled()` the state has the values half a step after t. [nblock + 1]
  BlockVec3 v_before, w_before, spin_before;  // m/s, rad/s, kg m2/s
  BlockVec3 u;                                // m, poses at t; the state has drifted on, so they are swapped with it during `sampled()`
  BlockQuat q;
};

class Solver {
 public:
  Solver(const Model& model, State& state, int threads);

  // Runs steps until `stop()` is true or a number is not finite. A step at a wanted time is a sample: the ledger closes there, the state
  // has the poses at t, `sample_state()` has the velocities about t, and `sampled()` is called. The ledger also closes every few steps in
  // between (`ledger_every` of `step.cpp`). `stop()` is called after each of these steps; the state is complete then, fit for a checkpoint.
  struct Hooks {
    std::function<bool(double t)> wanted;
    std::function<void()> sampled;
    std::function<bool()> stop;
  };
  void run(const Hooks& hooks);

  const SampleState& sample_state() const { return sample_state_; }
  bool broken() const { return broken_; }
  Vec6 block_wrench(int b) const;    // N, N m about the centroid, of joints and contacts
  Vec6 load_wrench(int b) const;     // of loads; for a driven block the reaction that prescribes its motion
  std::vector<int> take_released();  // joints released to contact since the last call
  std::vector<JointRelease> take_releases() { return contacts_.take_releases(); }
  // s, time step that the present contacts allow; `critical` is the limit of the intact structure.
  double stable_dt(double critical) const {
    const double contacts = has_contacts_ ? contacts_.stable_dt() : state_.dt_target, goal = state_.dt_target;
    return contacts < goal ? std::min(contacts, critical) : contacts > goal ? std::max(contacts, critical) : critical;
  }
  LongSteps take_long_steps() { return std::exchange(long_steps_, {}); }  // since the last call
  int touching() const { return contacts_.touching(); }
  long touched() const { return contacts_.touched(); }
  long slept() const { return contacts_.slept(); }
  double contact_seconds() const { return contact_seconds_; }
  std::vector<int> take_cracked();  // joints that cracked since the last call, in ascending order

 private:
  enum class Sample { none, ledger, full };
  void prepare_step(const Hooks& hooks);
  void excite();
  void forces(int thread);
  void transitions();
  void integrate(int thread);
  void update_outdated();
  void note_sleep();
  void adapt_time_step();
  double event_rate_of_first_openings() const;
  void foresee_events();
  bool may_grow(double dt) const;
  double vibration() const;
  void judge_step();
  void close_step(const Hooks& hooks);
  void apply_prescribed_motions();
  void settle_ledger();
  void note_cracks();
  void check_momentum();

  const Model& model_;
  State& state_;
  const int threads_;
  const bool reference_;
  // Work items of the joint phase: block groups with the intact joints they own, packs with dashpots, or joints of the reference kernel.
  const int joint_items_, joint_grain_;
  double floor_ = 0;      // J, least scale of the ledger
  double lift_ = 0;       // J, work that lifts all blocks by a thousandth of the structure's height
  double budget_ = 0;     // J, `event_budget()` of this step
  int ledger_steps_ = 1;  // steps between two closings of the ledger
  double mass_ = 0;       // kg, of all moving blocks
  Excitation now_;
  Rows contact_wrench_, load_;  // N, N m: wrenches of contacts (once there are any) and of loads, one row per block
  std::vector<LoadedBlock> loaded_;
  std::vector<BlockConstants> constants_;
  std::vector<std::uint8_t> outdated_;                // blocks with a new reference pose
  std::vector<std::uint8_t> idle_;                    // groups in which every block sleeps
  std::vector<JointSums> joint_sums_, cracked_sums_;  // per chunk
  std::vector<BlockSums> block_sums_;
  std::vector<int> newly_cracked_, released_, leaving_;
  Cracked cracked_;
  IntactJoints intact_;  // the joints that have not cracked
  Contacts contacts_;
  std::optional<Sequential> sequential_;  // replaces the phases `forces` and `integrate`
  bool any_cracked_ = false;
  double contact_seconds_ = 0;
  std::vector<JointStage> stage_before_;
  LongSteps long_steps_;
  SampleState sample_state_;
  Sample sample_ = Sample::none;
  bool broken_ = false, stop_ = false, has_contacts_ = false, has_transitions_ = false;
};

}  // namespace erbs
