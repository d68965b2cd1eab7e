// Linear system of the present joints: stiffness matrix, and bounds on the time step.
#pragma once
#include "engine/base/sparse.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/linear/joint_operator.h"

namespace erbs {

// Relative displacement of joint j per motion of block a and of block b (6 x 6 each), joint frame, present pose.
struct JointMap {
  Mat6 a, b;
};
JointMap joint_map(const Model& model, const State& state, int j);

// Upper bound of a joint's stiffness, intact or cracked: the intact form plus the positive part of the excess of the cracked form.
Mat6 stiffest(const Joint& joint);

// K of all joints not yet released to contact, with the stiffness of intact joints.
Sparse stiffness(const Model& model, const State& state, const Freedom& freedom);

struct StepBounds {
  double critical = 0;        // s, 2 / omega_max of M^-1 K (Lanczos value plus residual), less with dashpots; infinite without joints
  double cracked = 0;         // s, the same for the stiffer of intact and cracked forms, with the dashpots of cracked joints
  double block = 0;           // s, least of sqrt(2 / lambda_max(M^-1/2 K_ii M^-1/2)) over blocks: rigorous
  double element_period = 0;  // s, shortest 2 pi sqrt(m / k) of a block with fixed neighbours: rules (3), (4) of Gu and Miao
  double wave_passage = 0;    // s, least distance of joined centres / sqrt(E / rho): rule (5) of Gu and Miao
  int stiffest_block = -1;
  std::vector<double> of_block;  // s, `block` without dashpots, of each block; infinite without joints [nblock]
};
StepBounds step_bounds(const Model& model, const State& state);

}  // namespace erbs
