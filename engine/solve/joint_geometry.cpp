#include "engine/solve/joint_geometry.h"

#include <numeric>

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

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
