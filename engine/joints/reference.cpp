#include "engine/joints/reference.h"

#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/dashpots.h"
#include "engine/joints/kinematics.h"

namespace erbs {
namespace {

// Elastic tractions of all points of an intact joint, summed about the joint's centre.
void intact_resultant(const Model& m, const Joint& joint, const double* gap, Vec3& force, Vec3& moment) {
  const PointLaw& law = m.laws[z(joint.type->law)];
  for (int i = 0; i < joint.type->points; ++i) {
    const Point& p = m.point[z(joint.type->first_cell + i)];
    const Vec3 arm(p.s, p.t, 0), traction(law.ks * (gap[0] - gap[5] * p.t), law.ks * (gap[1] + gap[5] * p.s),
                                          law.kn * (gap[2] + gap[3] * p.t - gap[4] * p.s));  // Pa
    force += p.weight * traction;
    moment += p.weight * arm.cross(traction);
  }
}

double stored(const Model& m, const State& s, int j, const JointPose& pose) {
  if (s.joints.stage[z(j)] == JointStage::cracked) return s.joints.memory[z(j)].elastic;
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += 0.5 * m.joint[z(j)].type->stiffness[i] * pose.gap[i] * pose.gap[i];
  return sum;
}

void add(Rows& rows, int row, const Vec3& force, const Vec3& moment) {
  for (int i = 0; i < 3; ++i) rows[z(row) * 8 + z(i)] = force[i], rows[z(row) * 8 + 3 + z(i)] = moment[i];
}

}  // namespace

void reference_forces(const Model& m, State& s, int first, int last, bool sample, JointSums& sums) {
  if (sample) sums.energy.elastic = 0;
  for (int j = first; j < last; ++j) {
    const Joint& joint = m.joint[z(j)];
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    const JointPose pose = joint_pose(m, s, j);
    const bool in_contact = s.joints.stage[z(j)] == JointStage::contact;
    if (s.joints.stage[z(j)] == JointStage::intact && stays_intact(m, joint, pose.gap)) {
      intact_resultant(m, joint, pose.gap, force, moment);
    } else if (!in_contact) {
      double resultant[6];
      joint_by_points(m, s, j, pose.gap, resultant, sums);
      force = Vec3(resultant[0], resultant[1], resultant[2]);
      moment = Vec3(resultant[3], resultant[4], resultant[5]);
    }
    if (sample && !in_contact) sums.energy.elastic += stored(m, s, j, pose);
    const Vec3 arm_a = 0.5 * (pose.sum + pose.apart), arm_b = 0.5 * (pose.sum - pose.apart);
    if (m.dashpots && s.joints.stage[z(j)] == JointStage::intact) {
      double resultant[6] = {force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z()};
      add_dashpots(m, s, j, pose.frame, arm_a, arm_b, resultant, sums);
      force = Vec3(resultant[0], resultant[1], resultant[2]);
      moment = Vec3(resultant[3], resultant[4], resultant[5]);
    }
    force = pose.frame * force;
    moment = pose.frame * moment;
    add(s.cache.wrench, m.wrench_row_a[z(j)], force, arm_a.cross(force) + moment);
    add(s.cache.wrench, m.wrench_row_b[z(j)], -force, -(arm_b.cross(force) + moment));
  }
}

}  // namespace erbs
