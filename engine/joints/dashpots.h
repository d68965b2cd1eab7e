// Joint dashpots proportional to stiffness: c = b k in every direction, with the velocity of half a step before. They are explicit: stable
// while dt <= (2 / w) (sqrt(1 + xi^2) - xi), xi = b w / 2; `stiffness.h` bounds the step accordingly.
#pragma once
#include "engine/joints/joint_forces.h"
#include "engine/joints/kernels.h"

namespace erbs {

// Adds the dashpots of the intact joints in pack k, `pack`, to their resultants.
void add_dashpots(const Model& model, State& state, int k, const JointPack& pack, ElasticPack& io, JointSums& sums);

// The same for one intact joint with its present frame and arms (world axes). `force` is its resultant. A dashpot never pulls a dry joint,
// and no joint is sheared beyond its strength.
void add_dashpots(const Model& model, State& state, int j, const Mat3& frame, const Vec3& arm_a, const Vec3& arm_b, double force[6],
                  JointSums& sums);

// Books the work of joint j's dashpots over the step that ends here: the mean of its two resultants times the change dq.
void book_dashpots(State& state, int j, const double f[6], const double dq[6], JointSums& sums);

}  // namespace erbs
