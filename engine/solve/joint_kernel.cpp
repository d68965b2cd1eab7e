#include "engine/solve/joint_kernel.h"

#include <cmath>
#include <vector>

#include "engine/solve/lanes.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// q of lane l one step ago, for the joint that cracks now: the same pass with the rows of its blocks taken back by dt.
void before(const State& s, const JointBatch& B, int l, double q[6], double f[6]) {
  JointBatch one = B;
  alignas(64) double rows[2 * 8];
  for (int end = 0; end < 2; ++end) {
    const int b = end == 0 ? B.a[l] : B.b[l];
    for (int i = 0; i < 3; ++i) {
      rows[8 * end + i] = s.row[z(b) * 8 + z(i)] - s.last_dt * s.v[z(b)][i];
      rows[8 * end + 3 + i] = s.row[z(b) * 8 + 3 + z(i)] - s.last_dt * s.w[z(b)][i];
    }
  }
  for (int k = 0; k < lanes; ++k) one.a[k] = 0, one.b[k] = 1;
  JointLanes o;
  lane_kernels().elastic(one, rows, o);
  for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], f[i] = o.f[i][l];
}

// What a joint loses as it passes from its six sound springs to its points, at the pose before the step: the points store another
// energy (their compression is integrated over the polygon, their tension summed, so that a bent joint differs even where the rule
// is exact), and the step's trapezoid begins with another force. Springs along the joint are the same in both.
double parting(const Model& m, int j, const JointMemory& before, const double q[6]) {
  std::vector<PointHistory> fresh(z(m.joint[z(j)].points));
  double f[6];
  JointEnergy same;
  respond(m, j, false, before.q, before.q, fresh.data(), f, same);
  double lost = before.elastic - same.elastic - same.friction - same.fracture - same.crushing;
  for (int i = 2; i < 5; ++i) lost += 0.5 * (before.f[i] - f[i]) * (q[i] - before.q[i]);
  return lost;
}

}  // namespace

void joint_by_points(const Model& m, State& s, int j, const double q[6], double f[6], JointSums& sums) {
  const bool sound = s.tier[z(j)] == Tier::intact;
  JointMemory& memory = s.memory[z(j)];
  if (sound) {
    before(s, s.batch[z(j / lanes)], j % lanes, memory.q, memory.f);
    memory.elastic = 0;
    for (int i = 0; i < 6; ++i) memory.elastic += 0.5 * memory.f[i] * memory.q[i];
  }
  JointEnergy e;
  const bool still = respond(m, j, sound, memory.q, q, &s.history[z(m.joint[z(j)].first_point)], f, e);
  if (sound && still) return;
  if (sound) {
    e.fracture += parting(m, j, memory, q);
    s.tier[z(j)] = Tier::cracked;
    s.slow[z(j / lanes)] = std::uint8_t(s.slow[z(j / lanes)] | 1u << (j % lanes));
    ++sums.cracked_now;
  }
  double work = 0;
  for (int i = 0; i < 6; ++i) work += 0.5 * (memory.f[i] + f[i]) * (q[i] - memory.q[i]);
  const double error = std::fabs(work - (e.elastic - memory.elastic) - e.friction - e.fracture - e.crushing);
  if (error > sums.largest_error) sums.largest_error = error, sums.worst_joint = j;
  for (int i = 0; i < 6; ++i) memory.q[i] = q[i], memory.f[i] = f[i];
  memory.elastic = e.elastic;
  sums.energy.friction += e.friction;
  sums.energy.fracture += e.fracture;
  sums.energy.crushing += e.crushing;
}

void joint_forces(const Model& m, State& s, int first, int last, bool sample, JointSums& sums) {
  JointLanes o;
  const LaneKernels& kernels = lane_kernels();
  if (sample) sums.energy.elastic = 0;
  for (int k = first; k < last; ++k) {
    const JointBatch& B = s.batch[z(k)];
    kernels.elastic(B, s.row.data(), o);
    unsigned slow = s.slow[z(k)];
    for (int l = 0; l < lanes; ++l) slow |= unsigned(o.near[l] > 0) << l;
    if (slow != 0) {
      for (int l = 0; l < lanes; ++l) {
        const int j = k * lanes + l;
        if ((slow >> l & 1u) == 0 || j >= m.njoint || s.tier[z(j)] == Tier::open) continue;
        double q[6], f[6];
        for (int i = 0; i < 6; ++i) q[i] = o.q[i][l];
        joint_by_points(m, s, j, q, f, sums);
        for (int i = 0; i < 6; ++i) o.f[i][l] = f[i];
      }
    }
    kernels.wrenches(B, o, s.wrench.data());
    if (!sample) continue;
    for (int l = 0; l < lanes && k * lanes + l < m.njoint; ++l) {
      const int j = k * lanes + l;
      if (s.tier[z(j)] == Tier::cracked) sums.energy.elastic += s.memory[z(j)].elastic;
      if (s.tier[z(j)] != Tier::intact) continue;
      for (int i = 0; i < 6; ++i) sums.energy.elastic += 0.5 * o.f[i][l] * o.q[i][l];
    }
  }
}

}  // namespace erbs
