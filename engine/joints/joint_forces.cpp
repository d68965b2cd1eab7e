#include "engine/joints/joint_forces.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/dashpots.h"
#include "engine/joints/event_bound.h"
#include "engine/joints/kernels.h"
#include "engine/joints/kinematics.h"

namespace erbs {
namespace {

// q and f, one step ago, of joint j in lane l that cracks now: the elastic pass with the pose rows of its blocks moved back by dt.
void before(const State& s, const Joint& j, const JointPack& B, int l, double gap[6], double resultant[6]) {
  JointPack one = B;
  alignas(64) double rows[2 * 8];
  for (int end = 0; end < 2; ++end) {
    const int b = end == 0 ? j.a : j.b;
    const auto& increment = s.cache.increment[z(b / pack_size)].x;
    for (int i = 0; i < 3; ++i) {
      rows[8 * end + i] = increment[i][b % pack_size] - s.time.last_dt * s.motion.v[z(b)][i];
      rows[8 * end + 3 + i] = increment[3 + i][b % pack_size] - s.time.last_dt * s.motion.w[z(b)][i];
    }
  }
  for (int k = 0; k < pack_size; ++k) one.a[k] = 0, one.b[k] = 1;
  ElasticPack o;
  step_kernels().elastic(one, rows, o);
  for (int i = 0; i < 6; ++i) gap[i] = o.gap[i][l], resultant[i] = o.resultant[i][l];
}

}  // namespace

void joint_by_points(const Model& m, State& s, int j, const double faces[6], double resultant[6], JointSums& sums, const JointPack* pack,
                     int lane) {
  const bool intact = s.joints.stage[z(j)] == JointStage::intact;
  JointMemory& memory = s.joints.memory[z(j)];
  double gap[6];
  std::copy_n(faces, 6, gap);
  const double lift = intact ? 0 : lift_by_asperities(m, m.joint[z(j)], memory, gap);
  if (intact) {
    if (pack) before(s, m.joint[z(j)], *pack, lane, memory.gap, memory.resultant);
    else before(s, m.joint[z(j)], intact_pack(m, s, j / pack_size), j % pack_size, memory.gap, memory.resultant);
    memory.elastic = 0;
    for (int i = 0; i < 6; ++i) memory.elastic += 0.5 * memory.resultant[i] * memory.gap[i];
  } else sums.event_rate = std::max(sums.event_rate, foresee(m, m.joint[z(j)], memory.gap, gap, event_budget(m, s)));
  JointEnergy e;
  const Joint& joint = m.joint[z(j)];
  JointPast past = past_of(m, s, j);
  if (!intact && m.laws[z(joint.type->law)].interlock)
    past.interlock = scalar::interlock_of(interlock_step(m, s), joint.hop.time, joint.hop.loan);
  std::vector<PointHistory> before_it;
  const bool damped = joint.viscous_cracked > 0 && !intact;
  if (damped && s.time.last_dt > 0) past.rate = joint.viscous_cracked / s.time.last_dt;
  if (damped) before_it.assign(past.point, past.point + joint.type->points);
  std::vector<double> limit(damped ? z(joint.type->points) : 0);
  const bool still = respond(m, j, intact, memory.gap, gap, past, resultant, e, damped ? limit.data() : nullptr);
  if (intact && still) return;
  if (intact) {
    s.joints.stage[z(j)] = JointStage::cracked;
    ++sums.cracked_now;
  }
  double work = 0;
  for (int i = 0; i < 6; ++i) work += 0.5 * (memory.resultant[i] + resultant[i]) * (gap[i] - memory.gap[i]);
  const double error = std::fabs(work - (e.elastic - memory.elastic) - e.friction - e.fracture - e.crushing);
  if (error > sums.largest_error) sums.largest_error = error, sums.worst_joint = j;
  double dq[6], drag[6], across = 0.5 * (memory.resultant[2] + resultant[2]);
  for (int i = 0; i < 6; ++i) dq[i] = gap[i] - memory.gap[i], memory.resultant[i] = resultant[i];
  if (intact && m.dashpots) {
    const double none[6] = {};
    book_dashpots(s, j, none, dq, sums);  // their work since the last step
  }
  if (damped && s.time.last_dt > 0) {
    viscous_response(m, j, memory.gap, gap, before_it.data(), past, limit.data(), joint.viscous_cracked / s.time.last_dt, drag);
    across += 0.5 * (s.joints.viscous[6 * z(j) + 2] + drag[2]);
    book_dashpots(s, j, drag, dq, sums);
    for (int i = 0; i < 6; ++i) resultant[i] += drag[i];
  }
  e.friction += advance_asperities(m, joint, past.point, across, lift, memory);
  for (int i = 0; i < 6; ++i) memory.gap[i] = gap[i];
  memory.elastic = e.elastic;
  sums.energy.friction += e.friction;
  sums.energy.fracture += e.fracture;
  sums.energy.crushing += e.crushing;
}

// Elastic energy of the joints of pack k, before their resultants include dashpots.
static double stored(const Model& m, const State& s, int k, const ElasticPack& o) {
  double sum = 0;
  for (int l = 0; l < pack_size && k * pack_size + l < m.njoint; ++l) {
    const int j = k * pack_size + l;
    if (s.joints.slot[z(j)] != j) continue;
    if (s.joints.stage[z(j)] == JointStage::cracked) {  // cracked in this step
      sum += s.joints.memory[z(j)].elastic;
      continue;
    }
    for (int i = 0; i < 6; ++i) sum += 0.5 * o.resultant[i][l] * o.gap[i][l];
  }
  return sum;
}

void damped_joint_forces(const Model& m, State& s, const std::vector<JointPack>& pack, int first, int last, bool sample, JointSums& sums) {
  ElasticPack o;
  const StepKernels& kernels = step_kernels();
  if (sample) sums.energy.elastic = 0;
  for (int k = first; k < last; ++k) {
    const JointPack& B = pack[z(k)];
    if (std::all_of(B.wrench_row_a, B.wrench_row_a + pack_size, [&](int row) { return row >= m.spare_wrench_row(); }))
      continue;  // all have cracked
    kernels.elastic(B, s.cache.pose_row.data(), o);
    unsigned may_yield = 0;
    for (int l = 0; l < pack_size; ++l) may_yield |= unsigned(o.may_yield[l] > 0) << l;
    for (int l = 0; may_yield != 0 && l < pack_size; ++l) {
      if ((may_yield >> l & 1u) == 0) continue;
      double gap[6], resultant[6];
      for (int i = 0; i < 6; ++i) gap[i] = o.gap[i][l];
      joint_by_points(m, s, k * pack_size + l, gap, resultant, sums, &B, l);
      for (int i = 0; i < 6; ++i) o.resultant[i][l] = resultant[i];
    }
    if (sample) sums.energy.elastic += stored(m, s, k, o);
    if (m.dashpots) add_dashpots(m, s, k, B, o, sums);
    kernels.wrenches(B, o, s.cache.wrench.data());
  }
}

bool out_of_range(const Model& m, const Joint& joint, const double gap[6]) {
  const double side = std::min(joint.type->half_s, joint.type->half_t) * 2;
  const double least_gap = gap[2] - std::fabs(gap[3]) * joint.type->half_t - std::fabs(gap[4]) * joint.type->half_s;
  if (m.crushed_beds_remain && least_gap < 0 && m.laws[z(joint.type->law)].crushes()) return false;
  return std::sqrt(gap[0] * gap[0] + gap[1] * gap[1]) + std::fabs(gap[5]) * joint.type->radius > 0.01 * side ||
         gap[3] * gap[3] + gap[4] * gap[4] > 0.03 * 0.03 || least_gap > 0.002 * side;
}

bool joint_ready_for_contact(const Model& m, const State& s, int j) {
  if (s.joints.stage[z(j)] != JointStage::cracked) return false;
  const Joint& joint = m.joint[z(j)];
  const PointLaw& law = m.laws[z(joint.type->law)];
  if (!may_release(joint, law, s.joints.memory[z(j)])) return false;
  if (law.has_bond())
    for (int i = 0; i < joint.type->points; ++i)
      if (s.joints.history[z(joint.first_point + i)].damage < 1) return false;
  return out_of_range(m, joint, s.joints.memory[z(j)].gap);
}

}  // namespace erbs
