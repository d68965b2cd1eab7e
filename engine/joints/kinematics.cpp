#include "engine/joints/kinematics.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/joints/kernels.h"
#include "engine/model/joint_packs.h"

namespace erbs {
namespace {

// Sets the addresses of the data of joint j, for lane l.
void set_source(const Model& m, const State& s, int j, int l, PosePack& p) {
  const Joint& joint = m.joint[z(j)];
  for (int end = 0; end < 2; ++end) {
    const int b = end == 0 ? joint.a : joint.b;
    (end == 0 ? p.ua : p.ub)[l] = &s.cache.ref_u.data()[b / pack_size].x[0][b % pack_size];
    (end == 0 ? p.qa : p.qb)[l] = &s.cache.ref_q.data()[b / pack_size].x[0][b % pack_size];
  }
  p.arm_a[l] = joint.arm_a.data(), p.arm_b[l] = joint.arm_b.data(), p.rest[l] = joint.type->frame.data();  // columns
}

}  // namespace

void set_reference(State& s, int b) {
  s.cache.ref_u[z(b)] = s.pose.u[z(b)];
  s.cache.ref_q[z(b)] = s.pose.q[z(b)];
  constexpr double none[6] = {};
  put_pose_row(s, b, none);
}

Vec3 rotation_since(const Quat& q, const Quat& base) {
  const Quat relative = q * base.conjugate();
  const Vec3 t = (relative.w() < 0 ? -2 : 2) * relative.vec();
  return (1 + 0.375 * t.squaredNorm()) * t;
}

void set_pose_row(State& s, int b) {
  const Vec3 du = s.pose.u[z(b)] - s.cache.ref_u[z(b)], theta = rotation_since(s.pose.q[z(b)], s.cache.ref_q[z(b)]);
  const double row[6] = {du.x(), du.y(), du.z(), theta.x(), theta.y(), theta.z()};
  put_pose_row(s, b, row);
}

void put_pose_row(State& s, int b, const double row[6]) {
  for (int i = 0; i < 6; ++i) s.cache.increment[z(b / pack_size)].x[i][b % pack_size] = s.cache.pose_row[z(8 * b + i)] = row[i];
}

// Always eight lanes, even for one joint, so that a joint's geometry depends neither on the time of its update nor on its neighbours. Empty
// lanes have the frame of another joint and zero arms.
void set_geometry(const Model& m, const State& s, const int* joints, JointPack& pack) {
  const int* first = std::find_if(joints, joints + pack_size, [](int j) { return j >= 0; });
  if (first == joints + pack_size) return;
  PosePack p;
  for (int l = 0; l < pack_size; ++l) set_source(m, s, joints[l] >= 0 ? joints[l] : *first, l, p);
  step_kernels().pose(p, pack);
  for (int l = 0; l < pack_size; ++l) {
    if (joints[l] < 0) {
      for (auto* field : {pack.arm_a, pack.arm_b, pack.gap, pack.rotation})
        for (int i = 0; i < 3; ++i) field[i][l] = 0;
    } else if (p.far[l] > 0) {
      const Joint& joint = m.joint[z(joints[l])];
      const Vec3 rho = rotation_vector(s.cache.ref_q[z(joint.b)] * s.cache.ref_q[z(joint.a)].conjugate());
      for (int i = 0; i < 3; ++i) pack.rotation[i][l] = rho[i];
    }
  }
}

void set_lane(const Model& m, const State& s, int j, JointPack& pack, int lane) {
  set_constants(m, j, pack, lane);
  JointPack own;
  int joints[pack_size] = {-1, -1, -1, -1, -1, -1, -1, -1};
  joints[0] = j;
  set_geometry(m, s, joints, own);
  for (int i = 0; i < 9; ++i) pack.frame[i][lane] = own.frame[i][0];
  for (int i = 0; i < 3; ++i) {
    pack.arm_a[i][lane] = own.arm_a[i][0], pack.arm_b[i][lane] = own.arm_b[i][0];
    pack.gap[i][lane] = own.gap[i][0], pack.rotation[i][lane] = own.rotation[i][0];
  }
}

JointPack pack_of(const Model& m, const State& s, const int* joints) {
  JointPack pack{};
  for (int l = 0; l < pack_size; ++l)
    if (joints[l] >= 0) set_constants(m, joints[l], pack, l);
    else clear_lane(m, pack, l);
  set_geometry(m, s, joints, pack);
  return pack;
}

JointPack intact_pack(const Model& m, const State& s, int k) {
  int joints[pack_size];
  for (int l = 0; l < pack_size; ++l) {
    const int j = k * pack_size + l;
    joints[l] = j < m.njoint && s.joints.slot[z(j)] == j ? j : -1;
  }
  JointPack pack = pack_of(m, s, joints);
  for (int l = 0; l < pack_size; ++l)
    if (joints[l] < 0) pack.wrench_row_a[l] = pack.wrench_row_b[l] = spare_row_of_intact(m, k);
  return pack;
}

void update_all_references(const Model& m, State& s) {
  for (int b = 0; b < m.nblock; ++b) set_reference(s, b);
}

void joint_gap(const Model& m, const State& s, int j, double gap[6]) {
  const JointPose p = joint_pose(m, s, j);
  for (int i = 0; i < 6; ++i) gap[i] = p.gap[i];
}

}  // namespace erbs
