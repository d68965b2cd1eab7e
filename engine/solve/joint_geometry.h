// Geometry of a joint between the poses of its two blocks: exact, and carried between refreshes.
//
// The joint's frame turns with the mean rotation of its blocks, and its force acts at the midpoint of the two material points
// that coincided at rest, so that a rigid motion leaves it without strain and momentum is conserved to round-off whichever block
// is called a. With X the distance of the centroids, A_a and A_b the turned arms, S = A_a + A_b:
//   displacement  D = X + A_b - A_a            moment arms  c - x_a = (S + X)/2,  c - x_b = (S - X)/2.
// Between refreshes each block has moved by (du, th), |th| <= Analysis::lazy_rotation. With th_m their mean rotation, d half their
// difference and d' = d - (th_m x d)/2, turned back by th_m, to second order:
//   Y = X + du - th_m x (X + du) + th_m x (th_m x (X + du))/2,   D = (Y - X) + D_ref + d' x (S + g/2),   rotation = rho_ref + 2 d',
// g = d' x (A_b - A_a) being the change of S; forces act with the arms of Y and S + g.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct JointPose {
  Mat3 frame;       // world, columns s, t, n
  Vec3 apart, sum;  // m, X and S
  double q[6];      // m, rad in the frame
};

JointPose joint_pose(const Model& model, const State& state, int j);

// Takes the present pose of the blocks as their new reference, and the geometry of their joints with it: `joints` are all that end
// at one of them.
void refresh(const Model& model, State& state, const std::vector<int>& blocks, const std::vector<int>& joints);
void refresh_all(const Model& model, State& state);

// The relative displacement of joint j as the step sees it: carried since the refresh.
void joint_q(const Model& model, const State& state, int j, double q[6]);

}  // namespace erbs
