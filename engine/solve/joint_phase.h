// Joints of a step: intact ones in the lanes of their owners, cracked ones in packs of their law, or all of them by the reference kernel.
#pragma once
#include <utility>
#include <vector>

#include "engine/base/system/shares.h"
#include "engine/joints/cracked/cracked.h"
#include "engine/joints/intact/intact.h"
#include "engine/joints/joint_forces.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs {

class JointPhase {
 public:
  JointPhase(const Model& model, State& state);

  // Forces of the share of `thread`. `budget`: J, for `event_bound.h`; energies are summed if `sample`.
  void forces(int thread, const Shares& shares, bool sample, double budget);
  void update_reference(const std::vector<std::uint8_t>& outdated) { intact_.update_reference(outdated); }
  // Joints that cracked in this step change their lanes, once all its forces are complete, and their blocks sum other rows.
  void move_cracked(std::vector<BlockConstants>& constants);
  std::vector<int> take_cracked() { return std::exchange(newly_cracked_, {}); }  // since the last call, in ascending order
  // Joints released to contact act until the step is closed: a sample needs their forces.
  void leave(std::vector<int> released) { leaving_ = std::move(released); }
  void drop_released();
  void regroup();  // of cracked joints, between two steps
  void store() { cracked_.store(); }
  double take_event_rate();  // greatest `JointSums::event_rate` since the last call
  bool any_cracked() const { return any_cracked_; }
  bool reference() const { return reference_; }
  Cracked& cracked() { return cracked_; }
  std::vector<JointSums>& sums() { return sums_; }                  // per chunk of joints that are intact, or of all of them
  std::vector<JointSums>& cracked_sums() { return cracked_sums_; }  // per chunk of cracked joints

 private:
  void fit_sums();

  const Model& model_;
  State& state_;
  const bool reference_;
  // Work items: block groups with the intact joints they own, packs with dashpots, or joints of the reference kernel.
  const int items_, grain_;
  Cracked cracked_;
  IntactJoints intact_;
  std::vector<JointSums> sums_, cracked_sums_;
  std::vector<JointStage> stage_before_;
  std::vector<int> newly_cracked_, leaving_;
  bool any_cracked_ = false;
};

}  // namespace erbs
