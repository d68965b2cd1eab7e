// The linear system of the joints as they stand: stiffness matrix, and the two bounds on the time step.
#pragma once
#include "engine/base/sparse.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/joint_operator.h"

namespace erbs {

// Relative displacement of joint j per motion of block a and block b (6 x 6 each), joint frame, present pose.
struct JointMap {
  Mat6 a, b;
};
JointMap joint_map(const Model& model, const State& state, int j);

// A bound on every form the joint may take, cracked or sound: the sound form and the positive part of what the other has beyond it.
Mat6 stiffest(const Joint& joint);

// K of all joints that are not open, with the stiffness of sound joints.
Sparse stiffness(const Model& model, const State& state, const Freedom& freedom);

struct StepBounds {
  double critical = 0;        // s, 2 / omega_max of M^-1 K (Lanczos, its residual added), less with dashpots; infinite without joints
  double cracked = 0;         // s, the same with the stiffer of a joint's sound and cracked forms and the dashpots of cracked ones
  double block = 0;           // s, min over blocks of sqrt(2 / lambda_max(M^-1/2 K_ii M^-1/2)): rigorous
  double element_period = 0;  // s, shortest 2 pi sqrt(m / k) of a block with its neighbours fastened: rules (3) and (4)
  double wave_passage = 0;    // s, min distance of joined centres / sqrt(E / rho): rule (5)
  int stiffest_block = -1;
};
StepBounds step_bounds(const Scene& scene, const Model& model, const State& state);

}  // namespace erbs
