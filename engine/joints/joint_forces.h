// Common part of intact joints (`intact.h`) and cracked joints (`cracked.h`): their energy account, and one joint evaluated point by point.
#pragma once
#include <vector>

#include "engine/joints/response.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Account of a thread's joints, by fixed chunks of packs, so that sums do not depend on the number of threads.
struct JointSums {
  JointEnergy energy;        // dissipated so far; elastic: stored now, filled on request
  double largest_error = 0;  // J, of a joint's own energy balance over the step
  int worst_joint = -1;
  int cracked_now = 0;    // joints that cracked in this step
  double event_rate = 0;  // greatest `last_dt` over allowed step (`event_bound.h`)
};

// Evaluates one joint point by point and checks its energy balance over the step (work of the resultant = stored + dissipated). `pack`,
// `lane`: the pack and lane of an intact joint, if known.
void joint_by_points(const Model& model, State& state, int j, const double gap[6], double resultant[6], JointSums& sums,
                     const JointPack* pack = nullptr, int lane = 0);

// Intact joints with dashpots: writes the wrench rows of packs [first, last) of `pack`, as `intact.h` does for joints without dashpots.
void damped_joint_forces(const Model& model, State& state, const std::vector<JointPack>& pack, int first, int last, bool sample,
                         JointSums& sums);

// Limits of the small-displacement joint. Beyond them its fixed overlap polygon is wrong and contact detection takes over:
//   slip of 1 % of its side: the polygon errs by as much;
//   rotation of 0.03 rad: the gap of a rotated face, 2 sin(angle / 2) for the angle, errs by angle^3 / 24 of the side, 1e-6; the
//     pairing of moment and rotation rate about the mean frame errs by angle^2 / 12, 8e-5;
//   gap of 0.2 % of its side at the closest place.
bool out_of_range(const Model& model, const Joint& joint, const double gap[6]);
// Beyond its faces and without a bond: to be released to contact.
bool joint_ready_for_contact(const Model& model, const State& state, int j);

}  // namespace erbs
