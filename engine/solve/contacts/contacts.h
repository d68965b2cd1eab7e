// Contacts between blocks, phase by phase: release of joints to contact, search for new neighbours of loose blocks, contact forces, and
// their bound on the time step. An intact structure needs nothing of this but the watch over its neighbours.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/joints/cracked/cracked.h"
#include "engine/model/levels.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/block_levels.h"
#include "engine/solve/contacts/bodies.h"
#include "engine/solve/contacts/contact_bound.h"
#include "engine/solve/contacts/contact_forces.h"
#include "engine/solve/contacts/contact_sums.h"
#include "engine/solve/contacts/former_joints.h"
#include "engine/solve/contacts/motion_bounds.h"
#include "engine/solve/contacts/neighbour_watch.h"
#include "engine/solve/contacts/sleep.h"

namespace erbs {

class Contacts {
 public:
  Contacts(const Model& model, State& state, const StepRange& range, int threads);

  bool active() const { return !involved_.empty() || !state_.contacts.list.pair.empty(); }
  // Marks blocks as loose, so that they may find new neighbours: blocks without a path of joints to a support, and those that may touch
  // another within `time` (s; 0: not looked for).
  void activate_loose_blocks(double time = 0);
  // Before the forces of a step: the remaining poses, and every few steps the check whether a new search is necessary. `budget`: J, of
  // events (`event_bound.h`).
  void prepare(double budget);
  void find_columns();  // sets the scale of interlock of all pairs that touch (model/columns.h)
  // The same within a macro step (model/levels.h): the list of pairs stays.
  void prepare_substep();
  // Forces of this thread's pairs.
  void forces(int thread, bool sample) {
    forces_.evaluate(thread, at_macro_step(state_.time) ? sleep_.live() : fast_, sample);
    if (at_macro_step(state_.time)) sums_.condense(thread);
  }
  // Then, at the start of a macro step, all threads add up `sums()`. `end_sums()` makes pairs slow or fast for the macro step, and finds
  // the time step that they allow.
  ContactSums& sums() { return sums_; }
  void end_sums(bool levels, const StepLoads& loads);
  void add_up_substep(double* kick);                                 // within a macro step: of the pairs that act in this step
  const BlockLevels& block_levels() const { return block_levels_; }  // of loads
  void join_parts() { state_.contacts.list.fast.clear(); }           // all pairs act in every step of the next macro step
  // Releases joints without bond and beyond their range (`joint_ready_for_contact()`) to contact and returns them. Called between forces
  // and drift: this step still has the wrench and stored energy of the joint, the next step has those of the contact.
  std::vector<int> release_joints(Cracked& cracked);
  // Softens former joints at the same place (`FormerJoints`), all of them or those that soften already.
  void soften_former_joints(double most, bool find, double dt);
  // Afterwards: puts blocks to sleep and wakes sleepers (`sleep.h`). True if the set of sleepers has changed.
  bool sleep(const Excitation& now, const double* contact_wrench);
  // Updates the poses of blocks [first, last) after their drift; each thread has its own range.
  void track(int thread, int first, int last) { motion_.track(thread, first, last, state_.time.substep + 1 < state_.time.substeps); }

  const ContactBound& bound() const { return bound_; }
  FormerJoints& former_joints() { return former_; }
  const ContactSums& sums() const { return sums_; }
  long slept() const { return sleep_.slept(); }  // steps of sleeping blocks, since the start of this Solver
  double searched() const { return searched_; }  // s, spent on searches by this Solver
 private:
  void initialise();
  void list_involved();
  void rebuild_lists();
  void update();
  std::vector<int> search_pairs(double& reset, std::span<const std::uint8_t> still);
  bool overlap_at_rest(const ContactPair& pair) const;
  void sort();
  void find_still();
  void start_macro_step();
  std::vector<std::uint8_t> blocks_with_slow_pair() const;
  void list_fast_pairs();
  std::vector<int> ready_joints(const Cracked& cracked) const;

  const Model& model_;
  State& state_;
  ContactBodies bodies_;
  MotionBounds motion_;
  FormerJoints former_;
  ContactForces forces_;
  Sleep sleep_;
  ContactBound bound_;
  ContactSums sums_;
  BlockLevels block_levels_;
  NeighbourWatch watch_;
  std::vector<int> fast_, fast_blocks_;  // live pairs that act in every step, within a macro step, and their blocks
  std::vector<int> involved_;            // blocks that are loose or listed in a pair
  std::vector<std::uint64_t> jointed_;   // pairs of blocks that still have a joint, sorted
  std::vector<std::uint8_t> still_;      // sleepers with the pose of the last search [nblock]; empty without sleepers
  const bool may_have_levels_;
  bool unsorted_ = true, initialised_ = false;
  double searched_ = 0;
};

}  // namespace erbs
