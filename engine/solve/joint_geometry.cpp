#include "engine/solve/joint_geometry.h"

#include <numeric>
#include <utility>

#include "engine/model/batches.h"
#include "engine/solve/lanes.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// A joint, and the lane that its geometry goes to.
struct InLane {
  int joint, lane;
  JointBatch* batch;
};

// Eight at most. In lanes whatever their number, so that a joint's geometry does not depend on when and with which others it is made.
void set_geometry(const Model& m, const State& s, const InLane* to, int count) {
  PoseLanes p;
  for (int l = 0; l < lanes; ++l) {
    const Joint& joint = m.joint[z(to[l < count ? l : 0].joint)];
    for (int end = 0; end < 2; ++end) {
      const int b = end == 0 ? joint.a : joint.b;
      (end == 0 ? p.ua : p.ub)[l] = &s.base_u.data()[b / lanes].x[0][b % lanes];
      (end == 0 ? p.qa : p.qb)[l] = &s.base_q.data()[b / lanes].x[0][b % lanes];
    }
    p.arm_a[l] = joint.arm_a.data(), p.arm_b[l] = joint.arm_b.data(), p.rest[l] = joint.type->frame.data();  // columns
  }
  lane_kernels().pose(p);
  for (int l = 0; l < count; ++l) {
    JointBatch& batch = *to[l].batch;
    const int lane = to[l].lane;
    if (p.far[l] > 0) {
      const Joint& joint = m.joint[z(to[l].joint)];
      const Vec3 rho = rotation_vector(s.base_q[z(joint.b)] * s.base_q[z(joint.a)].conjugate());
      for (int i = 0; i < 3; ++i)
        p.q[3 + i][l] = p.frame[3 * i][l] * rho.x() + p.frame[3 * i + 1][l] * rho.y() + p.frame[3 * i + 2][l] * rho.z();
    }
    for (int i = 0; i < 9; ++i) batch.frame[i][lane] = p.frame[i][l];
    for (int i = 0; i < 3; ++i) batch.sum[i][lane] = p.sum[i][l], batch.apart[i][lane] = p.apart[i][l];
    for (int i = 0; i < 6; ++i) batch.q[i][lane] = p.q[i][l];
  }
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
  InLane to[lanes];
  int count = 0;
  for (const int j : joints) {
    const int at = s.place[z(j)] - sound * lanes;
    if (at < 0) continue;
    to[count++] = {j, at % lanes, &s.batch[z(at / lanes)]};
    if (count == lanes) set_geometry(m, s, to, std::exchange(count, 0));
  }
  if (count > 0) set_geometry(m, s, to, count);
}

void set_lane(const Model& m, const State& s, int j, JointBatch& batch, int l) {
  set_constants(m, j, batch, l);
  const InLane to{j, l, &batch};
  set_geometry(m, s, &to, 1);
}

void set_lanes(const Model& m, const State& s, const int* joints, int count, JointBatch& batch) {
  InLane to[lanes];
  for (int l = 0; l < count; ++l) {
    set_constants(m, joints[l], batch, l);
    to[l] = {joints[l], l, &batch};
  }
  set_geometry(m, s, to, count);
}

JointBatch batch_of(const Model& m, const State& s, const int* joints) {
  JointBatch batch{};
  InLane to[lanes];
  int count = 0;
  for (int l = 0; l < lanes; ++l) {
    if (joints[l] < 0) {
      clear_lane(m, batch, l);
      continue;
    }
    set_constants(m, joints[l], batch, l);
    to[count++] = {joints[l], l, &batch};
  }
  if (count > 0) set_geometry(m, s, to, count);
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
