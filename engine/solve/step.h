// One step as a list of named phases, run by a team of threads that stays together:
//   excite -> (contacts) -> joint forces | barrier | kick and drift of blocks | barrier | settle the ledger, look after topology.
#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/solve/cracked.h"
#include "engine/solve/debris.h"
#include "engine/solve/integrate.h"
#include "engine/solve/joint_kernel.h"
#include "engine/solve/long_steps.h"
#include "engine/solve/sequential.h"
#include "engine/solve/sound.h"

namespace erbs {

// The instant at which a sample is taken: everything at time t.
struct Instant {
  double t = 0;
  Excitation excitation;  // means over the kick about t
  // Velocities and spin momenta half a step before t; those half a step after it are in the state during sampled().  [nblock + 1]
  BlockVec3 v_before, w_before, spin_before;  // m/s, rad/s, kg m2/s
  BlockVec3 u;                                // m, poses at t while the state has drifted on; swapped with it during sampled()
  BlockQuat q;
};

class Solver {
 public:
  Solver(const Model& model, State& state, int threads);

  // Steps until `stop` says so, or a number breaks. A step whose time is wanted is a sample: the ledger is settled there, and
  // sampled() is called with the state as it is at t and the velocities about t in instant(). Every 32nd step the ledger is
  // settled as well. stop() is called after such steps, when the state is whole: a checkpoint may be taken there.
  struct Hooks {
    std::function<bool(double t)> wanted;
    std::function<void()> sampled;
    std::function<bool()> stop;
  };
  void run(const Hooks& hooks);

  const Instant& instant() const { return instant_; }
  bool broken() const { return broken_; }
  Vec6 block_wrench(int b) const;  // N, N m about the centroid: joints and contacts
  Vec6 load_wrench(int b) const;   // loads; on a driven block what holds it on its course
  std::vector<int> take_opened();  // joints handed over to contact since the last call
  std::vector<HandOver> take_handed() { return debris_.take_handed(); }
  // s, the step that what touches bears at present, `critical` being that of the sound structure
  double borne_dt(double critical) const {
    const double contacts = contacts_ ? debris_.borne_dt() : state_.dt_goal, goal = state_.dt_goal;
    return contacts < goal ? std::min(contacts, critical) : contacts > goal ? std::max(contacts, critical) : critical;
  }
  LongSteps take_long_steps() { return std::exchange(long_steps_, {}); }  // since the last call
  int touching() const { return debris_.touching(); }
  long touched() const { return debris_.touched(); }
  long slept() const { return debris_.slept(); }
  double contact_seconds() const { return contact_seconds_; }
  std::vector<int> take_cracked();  // joints that cracked since the last call, in the order of their number

 private:
  enum class Sample { none, ledger, full };
  void begin(const Hooks& hooks);
  void excite();
  void joints(int thread);
  void between();
  void blocks(int thread);
  void refresh_stale();
  void note_sleep();
  void follow_contacts();
  double haste_of_first_openings() const;
  void foresee_events();
  bool may_grow(double dt) const;
  double vibration() const;
  void judge_step();
  void finish(const Hooks& hooks);
  void drive();
  void settle_ledger();
  void note_cracks();
  void check_momentum();

  const Model& model_;
  State& state_;
  const int threads_;
  const bool reference_;
  const int joint_items_,
      joint_grain_;       // groups of blocks with the sound joints they keep, batches of damped ones, joints for the reference
  double floor_ = 0;      // J, below which the ledger's scale does not go
  double lift_ = 0;       // J, that lifts all blocks by a thousandth of the structure's height
  double budget_ = 0;     // J, event_budget() of this step
  int ledger_steps_ = 1;  // from one settling of the ledger to the next
  double mass_ = 0;       // kg, of all blocks that move
  Excitation now_;
  Rows push_, load_;  // N, N m: of contacts (once there are any) and of loads, a row a block
  std::vector<LoadedBlock> loaded_;
  std::vector<BlockConstants> constants_;
  std::vector<std::uint8_t> stale_;                   // blocks that were refreshed last
  std::vector<std::uint8_t> idle_;                    // groups of blocks that sleep, all of them
  std::vector<JointSums> joint_sums_, cracked_sums_;  // per chunk
  std::vector<BlockSums> block_sums_;
  std::vector<int> newly_cracked_, opened_, leaving_;
  Cracked cracked_;
  Sound sound_;  // what the cracked ones have left
  Debris debris_;
  std::optional<Sequential> sequential_;  // in place of joints and blocks
  bool any_cracked_ = false;
  double contact_seconds_ = 0;
  std::vector<Tier> tier_before_;
  LongSteps long_steps_;
  Instant instant_;
  Sample sample_ = Sample::none;
  bool broken_ = false, stop_ = false, contacts_ = false, between_ = false;
};

}  // namespace erbs
