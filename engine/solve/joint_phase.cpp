#include "engine/solve/joint_phase.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/joints/reference.h"
#include "engine/model/joint_packs.h"

namespace erbs {
namespace {

int chunks(int n, int grain) { return std::max(1, (n + grain - 1) / grain); }

}  // namespace

JointPhase::JointPhase(const Model& model, State& state)
    : model_(model),
      state_(state),
      reference_(model.analysis.kernel == "reference" || model.analysis.solver == "sequential"),
      items_(model.analysis.solver == "sequential" ? 0
             : reference_                          ? model.njoint
             : owner_computes(model)               ? int(block_groups(model.nblock))
                                                   : intact_packs(model)),
      grain_(owner_computes(model) ? IntactJoints::grain : pack_grain),
      cracked_(model, state),
      intact_(model, state),
      sums_(z(chunks(items_, grain_))),
      cracked_sums_(z(chunks(cracked_.groups(), Cracked::grain))),
      stage_before_(state.joints.stage),
      any_cracked_(std::ranges::find(state.joints.stage, JointStage::cracked) != state.joints.stage.end()) {
  forget_other_kernel(model, state);
}

void JointPhase::forces(int thread, const Shares& shares, bool sample, double budget) {
  const Range mine = shares.slice(items_, grain_, thread);
  if (owner_computes(model_)) intact_.forces(mine, sample, sums_);
  else
    for (int first = mine.first; first < mine.last; first += pack_grain) {
      const int last = std::min(first + pack_grain, mine.last);
      JointSums& sums = sums_[z(first / pack_grain)];
      if (reference_) reference_forces(model_, state_, first, last, sample, sums);
      else damped_joint_forces(model_, state_, intact_.damped(), first, last, sample, sums);
    }
  const Range cracked = shares.slice(cracked_.groups(), Cracked::grain, thread);
  for (int first = cracked.first; first < cracked.last; first += Cracked::grain)
    cracked_.forces(first, std::min(first + Cracked::grain, cracked.last), sample, budget, cracked_sums_[z(first / Cracked::grain)]);
}

void JointPhase::move_cracked(std::vector<BlockConstants>& constants) {
  bool any = false;
  for (JointSums& sums : sums_) any = std::exchange(sums.cracked_now, 0) > 0 || any;
  if (!any) return;
  any_cracked_ = true;
  for (int j = 0; j < model_.njoint; ++j) {
    const JointStage stage = state_.joints.stage[z(j)], before = std::exchange(stage_before_[z(j)], stage);
    if (before == stage) continue;
    if (!reference_ && stage == JointStage::cracked) cracked_.take(j), intact_.leave(j);
    if (before == JointStage::intact) newly_cracked_.push_back(j);
    for (const int b : {model_.joint[z(j)].a, model_.joint[z(j)].b}) use_wrench_rows(model_, state_, b, constants);
  }
  set_rotation_limits(model_, state_, constants);
  fit_sums();
}

// Never fewer: chunks that have lost their packs may hold losses that are not booked yet.
void JointPhase::fit_sums() { cracked_sums_.resize(std::max(cracked_sums_.size(), z(chunks(cracked_.groups(), Cracked::grain)))); }

void JointPhase::regroup() {
  cracked_.regroup();
  fit_sums();
}

void JointPhase::drop_released() {
  for (const int j : leaving_) cracked_.drop(j);
  leaving_.clear();
}

double JointPhase::take_event_rate() {
  double rate = 0;
  for (std::vector<JointSums>* of : {&sums_, &cracked_sums_})
    for (JointSums& sums : *of) rate = std::max(rate, std::exchange(sums.event_rate, 0.0));
  return rate;
}

}  // namespace erbs
