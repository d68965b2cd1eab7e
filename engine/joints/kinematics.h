// Relative pose of the two blocks of a joint: exact, and to low order in the motion since the reference poses.
//
// The joint frame rotates by the mean rotation of its blocks. The joint force acts at the midpoint of the two material points that
// coincided at rest. So a rigid motion causes no strain, and momentum is conserved to round-off whichever block is called a. With X from
// the centroid of a to that of b, A_a and A_b the rotated arms, S = A_a + A_b:
//   displacement  D = X + A_b - A_a            moment arms  c - x_a = (S + X)/2,  c - x_b = (S - X)/2.
//
// Cracked joints are evaluated so in every step (`relative_pose.h`). Intact joints use the motion of each block since its reference pose:
// (du, th), th = tan(angle) about the axis of rotation. With r(th, A) = (1 - th.th/2) th x A + th x (th x A)/2, the change of an arm to
// third order, th_m the mean of th_a and th_b, and d half their difference:
//   D = D_ref + du + r(th_b, A_b) - r(th_a, A_a),   rotation = rho_ref + 2 d - th_m x d.
// D is rotated back by th_m. Resultants are rotated forward by th_m; they act on a with the arm A_a + r(th_a, A_a) + D/2, on b with
// A_b + r(th_b, A_b) - D/2.
//
// Errors: a rigid rotation by th strains a joint by some th^4 of its arms. D, itself small, and the resultants are rotated to first order,
// with an error of th^2/2 of their size: 5e-9 at the default tolerance. The coupling of d with rho_ref, d rho_ref^2/6, is neglected; the
// next update of the reference poses corrects it. The kernel of intact joints (`intact_kernel.h`) takes r to second order only. With
// th = 2 sin(angle / 2) its third-order error of a rigid motion would be 3/8 th.th th x X; th = tan(angle) removes it.
#pragma once
#include "engine/base/rotation.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct JointPose {
  Mat3 frame;       // world, columns s, t, n
  Vec3 apart, sum;  // m, X and S
  double gap[6];    // m, rad, joint frame
};

// Rotation vector of a quaternion (v, w): 2 asin(|v|) / |v| v. The series is used where its next term is below round-off.
inline Vec3 small_rotation_vector(const Quat& q) {
  const double x = q.vec().squaredNorm();
  if (x > 4e-3) return rotation_vector(q);
  constexpr double c[] = {1.0 / 6, 3.0 / 40, 15.0 / 336, 105.0 / 3456, 945.0 / 42240, 10395.0 / 599040};
  const double series = 1 + x * (c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))));
  return (q.w() < 0 ? -2 : 2) * series * q.vec();
}

// Always inlined, so that the pose stays in registers: a load of parts of a stored pose would stall.
[[gnu::always_inline]] inline JointPose pose_of(const Joint& joint, const Vec3& ua, const Quat& qa, const Vec3& ub, const Quat& qb) {
  const Vec3 rho = small_rotation_vector(qb * qa.conjugate());  // world
  // The sum of two unit quaternions of one sign is the rotation half way between them.
  const Quat mean = Quat(qa.coeffs() + (qa.dot(qb) < 0 ? -1 : 1) * qb.coeffs()).normalized();
  JointPose p;
  p.frame = mean.toRotationMatrix() * joint.type->frame;
  const Vec3 rotated_a = rotation_change(qa, joint.arm_a), rotated_b = rotation_change(qb, joint.arm_b);
  const Vec3 du = ub - ua;
  p.apart = (joint.arm_a - joint.arm_b) + du;
  p.sum = joint.arm_a + joint.arm_b + rotated_a + rotated_b;
  const Vec3 d = p.frame.transpose() * (du + rotated_b - rotated_a);
  const Vec3 r = p.frame.transpose() * rho;
  for (int i = 0; i < 3; ++i) p.gap[i] = d[i], p.gap[3 + i] = r[i];
  return p;
}

[[gnu::always_inline]] inline JointPose joint_pose(const Model& m, const State& s, int j) {
  const Joint& joint = m.joint[std::size_t(j)];
  const std::size_t a = std::size_t(joint.a), b = std::size_t(joint.b);
  return pose_of(joint, s.u[a], s.q[a], s.u[b], s.q[b]);
}

// tan(angle) of the rotation from `base` to q, about its axis, to fourth order; the form that pose rows have.
Vec3 rotation_since(const Quat& q, const Quat& base);
// Makes the present pose of block b its reference pose.
void set_reference(State& state, int b);
// Set `State::pose_row` and `State::increment` of block b, from its pose or to `row`.
void set_pose_row(State& state, int b);
void put_pose_row(State& state, int b, const double row[6]);
void update_all_references(const Model& model, State& state);
// Writes joint j to lane `lane` of `pack`, with its geometry at the reference poses of its blocks.
void set_lane(const Model& model, const State& state, int j, JointPack& pack, int lane);
// Frames, arms, gaps and rotations of eight joints in their lanes; -1: an empty lane.
void set_geometry(const Model& model, const State& state, const int* joints, JointPack& pack);
// The same, with all constants of the joints.
JointPack pack_of(const Model& model, const State& state, const int* joints);
// The joints of pack k that still have their slot; the other lanes are empty.
JointPack intact_pack(const Model& model, const State& state, int k);

// Relative displacement of joint j at the present poses, exact.
void joint_gap(const Model& model, const State& state, int j, double gap[6]);

}  // namespace erbs
