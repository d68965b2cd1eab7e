// Dashpots of joints, proportional to their stiffness: c = b k in every direction, the velocity that of the half step before
// (explicit: stable while dt <= (2 / w) (sqrt(1 + xi^2) - xi), xi = b w / 2; stiffness.h bounds the step so).
#pragma once
#include "engine/solve/joint_kernel.h"
#include "engine/solve/lanes.h"

namespace erbs {

// Adds those of the sound joints of batch k, `batch`, to their resultants.
void add_dashpots(const Model& model, State& state, int k, const JointBatch& batch, JointLanes& io, JointSums& sums);

// The same for one sound joint with its frame and arms as they stand (world axes). `force` is its resultant: a dry joint is not
// pulled on, and no joint is sheared past its strength.
void add_dashpots(const Model& model, State& state, int j, const Mat3& frame, const Vec3& arm_a, const Vec3& arm_b, double force[6],
                  JointSums& sums);

// Books the work of joint j's dashpots over the step that ends here: the mean of its two resultants times the change dq.
void book_dashpots(State& state, int j, const double f[6], const double dq[6], JointSums& sums);

}  // namespace erbs
