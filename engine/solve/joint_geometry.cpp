#include "engine/solve/joint_geometry.h"

#include <numeric>

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// (R - I) a without losing digits where the rotation is tiny: 2 w (v x a) + 2 v x (v x a) for q = (w, v).
Vec3 turn_minus(const Quat& q, const Vec3& a) {
  const Vec3 v = q.vec(), va = v.cross(a);
  return 2 * q.w() * va + 2 * v.cross(va);
}

void set_row(State& s, int b) {
  const Vec3 du = s.u[z(b)] - s.base_u[z(b)];
  const Vec3 th = rotation_vector(s.q[z(b)] * s.base_q[z(b)].conjugate());
  double* row = &s.row[z(b) * 8];
  for (int i = 0; i < 3; ++i) row[i] = du[i], row[3 + i] = th[i];
}

// Rotation vector of a quaternion (v, w): 2 asin(|v|) / |v| v, by its series where the next term is below round-off.
Vec3 small_rotation_vector(const Quat& q) {
  const double x = q.vec().squaredNorm();
  if (x > 4e-3) return rotation_vector(q);
  constexpr double c[] = {1.0 / 6, 3.0 / 40, 15.0 / 336, 105.0 / 3456, 945.0 / 42240, 10395.0 / 599040};
  const double series = 1 + x * (c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))));
  return (q.w() < 0 ? -2 : 2) * series * q.vec();
}

JointPose pose_of(const Joint& joint, const Vec3& ua, const Quat& qa, const Vec3& ub, const Quat& qb) {
  const Vec3 rho = small_rotation_vector(qb * qa.conjugate());  // world
  // half way between two unit quaternions of one sign is their sum
  const Quat mean = Quat(qa.coeffs() + (qa.dot(qb) < 0 ? -1 : 1) * qb.coeffs()).normalized();
  JointPose p;
  p.frame = mean.toRotationMatrix() * joint.frame;
  const Vec3 turned_a = turn_minus(qa, joint.arm_a), turned_b = turn_minus(qb, joint.arm_b);
  const Vec3 du = ub - ua;
  p.apart = (joint.arm_a - joint.arm_b) + du;
  p.sum = joint.arm_a + joint.arm_b + turned_a + turned_b;
  const Vec3 d = p.frame.transpose() * (du + turned_b - turned_a);
  const Vec3 r = p.frame.transpose() * rho;
  for (int i = 0; i < 3; ++i) p.q[i] = d[i], p.q[3 + i] = r[i];
  return p;
}

}  // namespace

JointPose joint_pose(const Model& m, const State& s, int j) {
  const std::size_t a = z(m.joint[z(j)].a), b = z(m.joint[z(j)].b);
  return pose_of(m.joint[z(j)], s.u[a], s.q[a], s.u[b], s.q[b]);
}

void refresh(const Model& m, State& s, const std::vector<int>& blocks, const std::vector<int>& joints) {
  for (const int b : blocks) {
    s.base_u[z(b)] = s.u[z(b)];
    s.base_q[z(b)] = s.q[z(b)];
    set_row(s, b);
  }
  for (const int j : joints) {
    if (s.place[z(j)] < 0) continue;
    const std::size_t a = z(m.joint[z(j)].a), b = z(m.joint[z(j)].b);
    const JointPose p = pose_of(m.joint[z(j)], s.base_u[a], s.base_q[a], s.base_u[b], s.base_q[b]);
    JointBatch& batch = s.batch[z(s.place[z(j)] / lanes)];
    const int l = s.place[z(j)] % lanes;
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i) batch.frame[axis * 3 + i][l] = p.frame(i, axis);
    for (int i = 0; i < 3; ++i) batch.sum[i][l] = p.sum[i], batch.apart[i][l] = p.apart[i];
    for (int i = 0; i < 6; ++i) batch.q[i][l] = p.q[i];
  }
}

void refresh_all(const Model& m, State& s) {
  std::vector<int> blocks(z(m.nblock)), joints(z(m.njoint));
  std::iota(blocks.begin(), blocks.end(), 0);
  std::iota(joints.begin(), joints.end(), 0);
  refresh(m, s, blocks, joints);
}

void joint_q(const Model& m, const State& s, int j, double q[6]) {
  const JointPose p = joint_pose(m, s, j);
  for (int i = 0; i < 6; ++i) q[i] = p.q[i];
}

}  // namespace erbs
