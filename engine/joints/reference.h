// Plain joint forces: exact geometry in every step, point by point. Slow, short, and the oracle of the fast kernels; selected by
// `kernel = "reference"`.
#pragma once
#include "engine/joints/joint_forces.h"

namespace erbs {

// The same contract as `damped_joint_forces()`, for joints [first, last).
void reference_forces(const Model& model, State& state, int first, int last, bool sample, JointSums& sums);

}  // namespace erbs
