#include "engine/solve/joint_geometry.h"

#include <numeric>

#include "engine/model/batches.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

void set_geometry(const Model& m, const State& s, int j, JointBatch& batch, int l) {
  const Joint& joint = m.joint[z(j)];
  const std::size_t a = z(joint.a), b = z(joint.b);
  const JointPose p = pose_of(joint, s.base_u[a], s.base_q[a], s.base_u[b], s.base_q[b]);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 3; ++i) batch.frame[axis * 3 + i][l] = p.frame(i, axis);
  for (int i = 0; i < 3; ++i) batch.sum[i][l] = p.sum[i], batch.apart[i][l] = p.apart[i];
  for (int i = 0; i < 6; ++i) batch.q[i][l] = p.q[i];
}

}  // namespace

void set_row(State& s, int b) {
  const Vec3 du = s.u[z(b)] - s.base_u[z(b)];
  const Vec3 th = rotation_vector(s.q[z(b)] * s.base_q[z(b)].conjugate());
  double* row = &s.row[z(b) * 8];
  for (int i = 0; i < 3; ++i) row[i] = du[i], row[3 + i] = th[i];
}

void refresh(const Model& m, State& s, const std::vector<int>& blocks, const std::vector<int>& joints) {
  for (const int b : blocks) {
    s.base_u[z(b)] = s.u[z(b)];
    s.base_q[z(b)] = s.q[z(b)];
    set_row(s, b);
  }
  const int sound = sound_batches(m);
  for (const int j : joints)
    if (const int at = s.place[z(j)] - sound * lanes; at >= 0) set_geometry(m, s, j, s.batch[z(at / lanes)], at % lanes);
}

void set_lane(const Model& m, const State& s, int j, JointBatch& batch, int l) {
  set_constants(m, j, batch, l);
  set_geometry(m, s, j, batch, l);
}

JointBatch sound_batch(const Model& m, const State& s, int k) {
  JointBatch batch{};
  for (int l = 0; l < lanes; ++l) {
    const int j = k * lanes + l;
    if (j < m.njoint && s.place[z(j)] == j) set_lane(m, s, j, batch, l);
    else clear_lane(m, batch, l);
  }
  return batch;
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
