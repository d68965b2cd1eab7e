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
#include "engine/joints/block_motion.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct JointPose {
  Mat3 frame;       // world, columns s, t, n
  Vec3 apart, sum;  // m, X and S
  double gap[6];    // m, rad, joint frame
};

inline JointPose pose_of(const Joint& joint, const Vec3& ua, const Quat& qa, const Vec3& ub, const Quat& qb) {
  const auto vec = [](const Vec3& x) { return scalar::Vec3<double>{x.x(), x.y(), x.z()}; };
  const auto quat = [](const Quat& q) { return scalar::Quat<double>{q.x(), q.y(), q.z(), q.w()}; };
  const auto from = [](const scalar::Vec3<double>& x) { return Vec3(x.x, x.y, x.z); };
  const auto of = scalar::block_motion(vec(ua), quat(qa), vec(ub), quat(qb), vec(joint.arm_a), vec(joint.arm_b));
  const scalar::Mat3<double> mean = rotation_of(of.sum, of.two);
  JointPose p;
  for (int i = 0; i < 3; ++i) p.frame.row(i) = from(mean.row[i]).transpose() * joint.type->frame;
  p.apart = (joint.arm_a - joint.arm_b) + (ub - ua);
  p.sum = from(of.arm_a + of.arm_b);
  const Vec3 d = p.frame.transpose() * from(of.gap);
  const Vec3 r = p.frame.transpose() * (of.far ? rotation_vector(qb * qa.conjugate()) : from(of.rotation));
  for (int i = 0; i < 3; ++i) p.gap[i] = d[i], p.gap[3 + i] = r[i];
  return p;
}

inline JointPose joint_pose(const Model& m, const State& s, int j) {
  const Joint& joint = m.joint[std::size_t(j)];
  const std::size_t a = std::size_t(joint.a), b = std::size_t(joint.b);
  return pose_of(joint, s.pose.u[a], s.pose.q[a], s.pose.u[b], s.pose.q[b]);
}

// tan(angle) of the rotation from `base` to q, about its axis, to fourth order; the form that pose rows have.
Vec3 rotation_since(const Quat& q, const Quat& base);
// Makes the present pose of block b its reference pose.
void set_reference(State& state, int b);
// Set `KernelCache::pose_row` and `KernelCache::increment` of block b, from its pose or to `row`.
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
