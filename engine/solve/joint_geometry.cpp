#include "engine/solve/joint_geometry.h"

#include <algorithm>

#include "engine/model/batches.h"
#include "engine/solve/lanes.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Sets the addresses of the data of joint j, for lane l.
void set_source(const Model& m, const State& s, int j, int l, PoseLanes& p) {
  const Joint& joint = m.joint[z(j)];
  for (int end = 0; end < 2; ++end) {
    const int b = end == 0 ? joint.a : joint.b;
    (end == 0 ? p.ua : p.ub)[l] = &s.base_u.data()[b / lanes].x[0][b % lanes];
    (end == 0 ? p.qa : p.qb)[l] = &s.base_q.data()[b / lanes].x[0][b % lanes];
  }
  p.arm_a[l] = joint.arm_a.data(), p.arm_b[l] = joint.arm_b.data(), p.rest[l] = joint.type->frame.data();  // columns
}

}  // namespace

void take_pose(State& s, int b) {
  s.base_u[z(b)] = s.u[z(b)];
  s.base_q[z(b)] = s.q[z(b)];
  constexpr double none[6] = {};
  put_row(s, b, none);
}

Vec3 rotation_since(const Quat& q, const Quat& base) {
  const Quat turn = q * base.conjugate();
  const Vec3 t = (turn.w() < 0 ? -2 : 2) * turn.vec();
  return (1 + 0.375 * t.squaredNorm()) * t;
}

void set_row(State& s, int b) {
  const Vec3 du = s.u[z(b)] - s.base_u[z(b)], th = rotation_since(s.q[z(b)], s.base_q[z(b)]);
  const double row[6] = {du.x(), du.y(), du.z(), th.x(), th.y(), th.z()};
  put_row(s, b, row);
}

void put_row(State& s, int b, const double row[6]) {
  for (int i = 0; i < 6; ++i) s.shift[z(b / lanes)].x[i][b % lanes] = s.row[z(8 * b + i)] = row[i];
}

// Always eight lanes, even for one joint, so that a joint's geometry depends neither on the time of its update nor on its neighbours. Empty
// lanes have the frame of another joint and zero arms.
void set_geometry(const Model& m, const State& s, const int* joints, JointBatch& batch) {
  const int* first = std::find_if(joints, joints + lanes, [](int j) { return j >= 0; });
  if (first == joints + lanes) return;
  PoseLanes p;
  for (int l = 0; l < lanes; ++l) set_source(m, s, joints[l] >= 0 ? joints[l] : *first, l, p);
  lane_kernels().pose(p, batch);
  for (int l = 0; l < lanes; ++l) {
    if (joints[l] < 0) {
      for (auto* field : {batch.arm_a, batch.arm_b, batch.gap, batch.turn})
        for (int i = 0; i < 3; ++i) field[i][l] = 0;
    } else if (p.far[l] > 0) {
      const Joint& joint = m.joint[z(joints[l])];
      const Vec3 rho = rotation_vector(s.base_q[z(joint.b)] * s.base_q[z(joint.a)].conjugate());
      for (int i = 0; i < 3; ++i) batch.turn[i][l] = rho[i];
    }
  }
}

void set_lane(const Model& m, const State& s, int j, JointBatch& batch, int lane) {
  set_constants(m, j, batch, lane);
  JointBatch own;
  int joints[lanes] = {-1, -1, -1, -1, -1, -1, -1, -1};
  joints[0] = j;
  set_geometry(m, s, joints, own);
  for (int i = 0; i < 9; ++i) batch.frame[i][lane] = own.frame[i][0];
  for (int i = 0; i < 3; ++i) {
    batch.arm_a[i][lane] = own.arm_a[i][0], batch.arm_b[i][lane] = own.arm_b[i][0];
    batch.gap[i][lane] = own.gap[i][0], batch.turn[i][lane] = own.turn[i][0];
  }
}

JointBatch batch_of(const Model& m, const State& s, const int* joints) {
  JointBatch batch{};
  for (int l = 0; l < lanes; ++l)
    if (joints[l] >= 0) set_constants(m, joints[l], batch, l);
    else clear_lane(m, batch, l);
  set_geometry(m, s, joints, batch);
  return batch;
}

JointBatch sound_batch(const Model& m, const State& s, int k) {
  int joints[lanes];
  for (int l = 0; l < lanes; ++l) {
    const int j = k * lanes + l;
    joints[l] = j < m.njoint && s.place[z(j)] == j ? j : -1;
  }
  return batch_of(m, s, joints);
}

void refresh_all(const Model& m, State& s) {
  for (int b = 0; b < m.nblock; ++b) take_pose(s, b);
}

void joint_q(const Model& m, const State& s, int j, double q[6]) {
  const JointPose p = joint_pose(m, s, j);
  for (int i = 0; i < 6; ++i) q[i] = p.q[i];
}

}  // namespace erbs
