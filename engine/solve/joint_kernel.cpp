#include "engine/solve/joint_kernel.h"

#include <algorithm>
#include <cmath>

#include "engine/solve/dashpots.h"
#include "engine/solve/event_bound.h"
#include "engine/solve/joint_geometry.h"
#include "engine/solve/lanes.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// q and f, one step ago, of joint j in lane l that cracks now: the elastic pass with the pose rows of its blocks moved back by dt.
void before(const State& s, const Joint& j, const JointBatch& B, int l, double q[6], double f[6]) {
  JointBatch one = B;
  alignas(64) double rows[2 * 8];
  for (int end = 0; end < 2; ++end) {
    const int b = end == 0 ? j.a : j.b;
    const auto& shift = s.shift[z(b / lanes)].x;
    for (int i = 0; i < 3; ++i) {
      rows[8 * end + i] = shift[i][b % lanes] - s.last_dt * s.v[z(b)][i];
      rows[8 * end + 3 + i] = shift[3 + i][b % lanes] - s.last_dt * s.w[z(b)][i];
    }
  }
  for (int k = 0; k < lanes; ++k) one.a[k] = 0, one.b[k] = 1;
  JointLanes o;
  lane_kernels().elastic(one, rows, o);
  for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], f[i] = o.f[i][l];
}

}  // namespace

void joint_by_points(const Model& m, State& s, int j, const double q[6], double f[6], JointSums& sums, const JointBatch* batch, int lane) {
  const bool sound = s.tier[z(j)] == Tier::intact;
  JointMemory& memory = s.memory[z(j)];
  if (sound) {
    if (batch) before(s, m.joint[z(j)], *batch, lane, memory.q, memory.f);
    else before(s, m.joint[z(j)], sound_batch(m, s, j / lanes), j % lanes, memory.q, memory.f);
    memory.elastic = 0;
    for (int i = 0; i < 6; ++i) memory.elastic += 0.5 * memory.f[i] * memory.q[i];
  }
  else sums.haste = std::max(sums.haste, foresee(m, m.joint[z(j)], memory.q, q, event_budget(m, s)));
  JointEnergy e;
  const Joint& joint = m.joint[z(j)];
  JointPast past = past_of(m, s, j);
  if (!sound && m.laws[z(m.joint[z(j)].type->law)].interlock) past.interlock = interlock_now(m, s);
  std::vector<PointHistory> before_it;
  const bool damped = joint.viscous_cracked > 0 && !sound;
  if (damped) before_it.assign(past.point, past.point + joint.type->points);
  std::vector<double> limit(damped ? z(joint.type->points) : 0);
  const bool still = respond(m, j, sound, memory.q, q, past, f, e, damped ? limit.data() : nullptr);
  if (sound && still) return;
  if (sound) {
    s.tier[z(j)] = Tier::cracked;
    ++sums.cracked_now;
  }
  double work = 0;
  for (int i = 0; i < 6; ++i) work += 0.5 * (memory.f[i] + f[i]) * (q[i] - memory.q[i]);
  const double error = std::fabs(work - (e.elastic - memory.elastic) - e.friction - e.fracture - e.crushing);
  if (error > sums.largest_error) sums.largest_error = error, sums.worst_joint = j;
  double dq[6], drag[6];
  for (int i = 0; i < 6; ++i) dq[i] = q[i] - memory.q[i], memory.f[i] = f[i];
  if (sound && m.dashpots) {
    const double none[6] = {};
    book_dashpots(s, j, none, dq, sums);  // their work since the last step
  }
  if (damped && s.last_dt > 0) {
    viscous_response(m, j, memory.q, q, before_it.data(), past, limit.data(), joint.viscous_cracked / s.last_dt, drag);
    book_dashpots(s, j, drag, dq, sums);
    for (int i = 0; i < 6; ++i) f[i] += drag[i];
  }
  for (int i = 0; i < 6; ++i) memory.q[i] = q[i];
  memory.elastic = e.elastic;
  sums.energy.friction += e.friction;
  sums.energy.fracture += e.fracture;
  sums.energy.crushing += e.crushing;
}

// Elastic energy of the joints of pack k, before their resultants include dashpots.
static double stored(const Model& m, const State& s, int k, const JointLanes& o) {
  double sum = 0;
  for (int l = 0; l < lanes && k * lanes + l < m.njoint; ++l) {
    const int j = k * lanes + l;
    if (s.place[z(j)] != j) continue;
    if (s.tier[z(j)] == Tier::cracked) {  // cracked in this step
      sum += s.memory[z(j)].elastic;
      continue;
    }
    for (int i = 0; i < 6; ++i) sum += 0.5 * o.f[i][l] * o.q[i][l];
  }
  return sum;
}

void joint_forces(const Model& m, State& s, const std::vector<JointBatch>& batch, int first, int last, bool sample, JointSums& sums) {
  JointLanes o;
  const LaneKernels& kernels = lane_kernels();
  if (sample) sums.energy.elastic = 0;
  for (int k = first; k < last; ++k) {
    const JointBatch& B = batch[z(k)];
    if (std::all_of(B.row_a, B.row_a + lanes, [&](int row) { return row == m.spare_row(); })) continue;  // all have cracked
    kernels.elastic(B, s.row.data(), o);
    unsigned near = 0;
    for (int l = 0; l < lanes; ++l) near |= unsigned(o.near[l] > 0) << l;
    for (int l = 0; near != 0 && l < lanes; ++l) {
      if ((near >> l & 1u) == 0) continue;
      double q[6], f[6];
      for (int i = 0; i < 6; ++i) q[i] = o.q[i][l];
      joint_by_points(m, s, k * lanes + l, q, f, sums, &B, l);
      for (int i = 0; i < 6; ++i) o.f[i][l] = f[i];
    }
    if (sample) sums.energy.elastic += stored(m, s, k, o);
    if (m.dashpots) add_dashpots(m, s, k, B, o, sums);
    kernels.wrenches(B, o, s.wrench.data());
  }
}

bool beyond_its_faces(const Joint& joint, const double q[6]) {
  const double side = std::min(joint.type->half_s, joint.type->half_t) * 2;
  const double least_gap = q[2] - std::fabs(q[3]) * joint.type->half_t - std::fabs(q[4]) * joint.type->half_s;
  return std::sqrt(q[0] * q[0] + q[1] * q[1]) + std::fabs(q[5]) * joint.type->radius > 0.01 * side ||
         q[3] * q[3] + q[4] * q[4] > 0.03 * 0.03 || least_gap > 0.002 * side;
}

bool joint_spent(const Model& m, const State& s, int j) {
  if (s.tier[z(j)] != Tier::cracked) return false;
  const Joint& joint = m.joint[z(j)];
  if (!m.laws[z(joint.type->law)].dry)
    for (int i = 0; i < joint.type->points; ++i)
      if (s.history[z(joint.first_point + i)].damage < 1) return false;
  return beyond_its_faces(joint, s.memory[z(j)].q);
}

}  // namespace erbs
