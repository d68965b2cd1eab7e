// Geometry of a joint between the poses of its two blocks: exact, and carried between refreshes.
//
// The joint's frame turns with the mean rotation of its blocks, and its force acts at the midpoint of the two material points
// that coincided at rest, so that a rigid motion leaves it without strain and momentum is conserved to round-off whichever block
// is called a. With X the distance of the centroids, A_a and A_b the turned arms, S = A_a + A_b:
//   displacement  D = X + A_b - A_a            moment arms  c - x_a = (S + X)/2,  c - x_b = (S - X)/2.
// Joints that have cracked are looked at so in every step (lanes_pose.inc). Sound ones are carried between refreshes of their geometry:
// each block has moved by (du, th), th = tan(angle) about its axis. With r(th, A) = (1 - th.th/2) th x A + th x (th x
// A)/2 the change of an arm to third order, th_m the mean of th_a and th_b, d half their difference:
//   D = D_ref + du + r(th_b, A_b) - r(th_a, A_a),   rotation = rho_ref + 2 d - th_m x d,
// D turned back by th_m; resultants turn forward by it and act on a with the arm A_a + r(th_a, A_a) + D/2, on b with A_b + r(th_b, A_b) -
// D/2. A rigid motion by th strains a joint by some th^4 of its arms. D, small itself, and resultants turn to first order: amiss by th^2/2
// of themselves, 5e-9 at the default tolerance. The coupling of d with rho_ref is left out, d rho_ref^2/6; the next refresh puts it right.
// lanes_sound.inc does with second order in r. Its third order of a rigid motion would be 3/8 th.th th x X, X the distance of the
// centroids, with th = 2 sin(angle / 2); tan(angle) is what takes it away.
#pragma once
#include "engine/base/turn.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct JointPose {
  Mat3 frame;       // world, columns s, t, n
  Vec3 apart, sum;  // m, X and S
  double q[6];      // m, rad in the frame
};

// Rotation vector of a quaternion (v, w): 2 asin(|v|) / |v| v, by its series where the next term is below round-off.
inline Vec3 small_rotation_vector(const Quat& q) {
  const double x = q.vec().squaredNorm();
  if (x > 4e-3) return rotation_vector(q);
  constexpr double c[] = {1.0 / 6, 3.0 / 40, 15.0 / 336, 105.0 / 3456, 945.0 / 42240, 10395.0 / 599040};
  const double series = 1 + x * (c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))));
  return (q.w() < 0 ? -2 : 2) * series * q.vec();
}

// Always inlined, so that the pose stays in registers: stored and read back in other pieces it would stall.
[[gnu::always_inline]] inline JointPose pose_of(const Joint& joint, const Vec3& ua, const Quat& qa, const Vec3& ub, const Quat& qb) {
  const Vec3 rho = small_rotation_vector(qb * qa.conjugate());  // world
  // half way between two unit quaternions of one sign is their sum
  const Quat mean = Quat(qa.coeffs() + (qa.dot(qb) < 0 ? -1 : 1) * qb.coeffs()).normalized();
  JointPose p;
  p.frame = mean.toRotationMatrix() * joint.type->frame;
  const Vec3 turned_a = turn_minus(qa, joint.arm_a), turned_b = turn_minus(qb, joint.arm_b);
  const Vec3 du = ub - ua;
  p.apart = (joint.arm_a - joint.arm_b) + du;
  p.sum = joint.arm_a + joint.arm_b + turned_a + turned_b;
  const Vec3 d = p.frame.transpose() * (du + turned_b - turned_a);
  const Vec3 r = p.frame.transpose() * rho;
  for (int i = 0; i < 3; ++i) p.q[i] = d[i], p.q[3 + i] = r[i];
  return p;
}

[[gnu::always_inline]] inline JointPose joint_pose(const Model& m, const State& s, int j) {
  const Joint& joint = m.joint[std::size_t(j)];
  const std::size_t a = std::size_t(joint.a), b = std::size_t(joint.b);
  return pose_of(joint, s.u[a], s.q[a], s.u[b], s.q[b]);
}

// tan(angle) about its axis of the turn from `base` to q, to fourth order, as rows of blocks have it.
Vec3 rotation_since(const Quat& q, const Quat& base);
// The present pose of block b becomes its reference.
void take_pose(State& state, int b);
// State::row and State::shift of block b, from its pose or as they are given.
void set_row(State& state, int b);
void put_row(State& state, int b, const double row[6]);
void refresh_all(const Model& model, State& state);
// Joint j as lane `lane` of `batch`, with its geometry at the last refresh of its blocks.
void set_lane(const Model& model, const State& state, int j, JointBatch& batch, int lane);
// Frames, arms, gaps and turns of eight joints in their lanes, -1 for an empty one.
void set_geometry(const Model& model, const State& state, const int* joints, JointBatch& batch);
// ... with all that no refresh changes.
JointBatch batch_of(const Model& model, const State& state, const int* joints);
// The joints of batch k that are still in their place; the other lanes are empty.
JointBatch sound_batch(const Model& model, const State& state, int k);

// The relative displacement of joint j as the step sees it: carried since the refresh.
void joint_q(const Model& model, const State& state, int j, double q[6]);

}  // namespace erbs
