#include "engine/analysis/snapshot.h"

#include <algorithm>
#include <cstddef>

#include "engine/base/count.h"
#include "engine/record/recorders/joint_stress.h"
#include "engine/solve/blocks/prescribed.h"

namespace erbs::analysis {
namespace {

// A joint is broken if none of its points carries tension or cohesion any more. Dry joints have none to lose.
int broken_joints(const Model& model, const JointState& joints) {
  int broken = 0;
  for (int j = 0; j < model.njoint; ++j) {
    const Joint& joint = model.joint[z(j)];
    if (joints.stage[z(j)] == JointStage::intact || !model.laws[z(joint.type->law)].has_bond()) continue;
    const auto first = joints.history.begin() + joint.first_point;
    broken += std::all_of(first, first + joint.type->points, [](const PointHistory& h) { return h.damage >= 1; });
  }
  return broken;
}

// Of a block with prescribed motion: velocities are known half a step before and after t only. Where these two steps differ, as they do
// when levels of contacts change the step, their difference over the time between is the acceleration at another instant than t.
void differentiate(const Model& m, int b, const BlockPoses& pose, double t, double h, MovingBlock& o) {
  const Quat& attitude = pose.q[z(b)];
  const PrescribedPose before = prescribed_pose(m, b, t - h, attitude), now = prescribed_pose(m, b, t, attitude),
                       after = prescribed_pose(m, b, t + h, attitude);
  o.a = (after.u - 2 * now.u + before.u) / (h * h);
  o.alpha = (rotation_vector(after.q * now.q.conjugate()) - rotation_vector(now.q * before.q.conjugate())) / (h * h);
}

}  // namespace

Snapshot snapshot_of(const Model& m, const State& state, const Solver& solver, bool joint_forces) {
  const SampleState& now = solver.sample();
  const JointState& joints = state.joints;
  Snapshot s{.model = m, .pose = now.pose, .joints = joints, .energy = state.energy, .t = now.t};
  const double span =
      std::max(now.excitation.kick, state.time.dt_target);  // s, in which a prescribed motion changes by more than round-off
  s.motion = [&m, &now, &after = state.motion, kick = now.excitation.kick, span](std::size_t b) {
    const MotionState& before = now.before;
    MovingBlock o;
    o.a = (after.v[b] - before.v[b]) / kick;
    o.alpha = (after.w[b] - before.w[b]) / kick;
    Vec3 moment = (after.spin_momentum[b] - before.spin_momentum[b]) / kick;
    const bool levels = !now.kick_excess.empty();
    if (levels) {  // contacts with levels act by impulses for several steps
      const Mat3 r = now.pose.q[b].toRotationMatrix();
      o.a -= m.inverse_mass[b] * now.kick_excess[b].head<3>();
      o.alpha -= r * m.inverse_inertia[b] * r.transpose() * now.kick_excess[b].tail<3>();
      moment -= now.kick_excess[b].tail<3>();
    }
    if (m.kind[b] == Kind::driven && now.t >= span) differentiate(m, int(b), now.pose, now.t, span, o);
    const double half = 0.5 * (levels ? now.since[b] : now.last_dt);
    o.v = before.v[b] + half * o.a;
    o.w = before.w[b] + half * o.alpha;
    o.spin_momentum = before.spin_momentum[b] + half * moment;
    return o;
  };
  for (const auto& g : m.grounds) {
    s.ground_a += value(g.wave, now.t) * g.direction;
    s.ground_v += integral(g.wave, now.t) * g.direction;
    s.ground_u += second_integral(g.wave, now.t) * g.direction;
  }
  s.gravity = m.gravity;
  for (const auto& tilt : m.tilts) s.gravity = rotation(value(tilt.wave, now.t) * tilt.axis) * s.gravity;
  s.block_wrench = now.block_wrench, s.load_wrench = now.load_wrench;
  for (int j = 0; joint_forces && j < m.njoint; ++j) s.joint_force.push_back(joint_resultant(m, joints, now.pose, j));
  s.joints_broken = broken_joints(m, joints);
  for (int j = 0; j < m.njoint; ++j)
    if (joints.stage[z(j)] != JointStage::contact) s.contact_points += m.joint[z(j)].type->points;
  s.contact_points += solver.contacts().sums().touching();
  return s;
}

}  // namespace erbs::analysis
