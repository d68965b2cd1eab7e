#include "engine/joints/reference.h"

#include <cmath>

#include "engine/joints/dashpots.h"
#include "engine/joints/kinematics.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Elastic tractions of all points of an intact joint, summed about the joint's centre; false as soon as one is beyond a limit.
bool intact_resultant(const Model& m, const Joint& joint, const JointPose& pose, Vec3& force, Vec3& moment) {
  const PointLaw& law = m.laws[z(joint.type->law)];
  const double* gap = pose.gap;
  for (int i = 0; law.fc > 0 && i < joint.type->corners; ++i) {
    const auto& x = m.overlap_corner[z(joint.type->first_corner + i)];
    if (-law.kn * (gap[2] + gap[3] * x.y() - gap[4] * x.x()) > law.fc) return false;
  }
  double fs = 0, ft = 0, fn = 0, ms = 0, mt = 0, mn = 0;
  for (int i = 0; i < joint.type->points; ++i) {
    const Point& p = m.point[z(joint.type->first_cell + i)];
    const double shear_s = law.ks * (gap[0] - gap[5] * p.t), shear_t = law.ks * (gap[1] + gap[5] * p.s);  // Pa
    const double sigma = law.kn * (gap[2] + gap[3] * p.t - gap[4] * p.s);
    if (sigma > law.ft || (law.dry && sigma > 0)) return false;
    const double most = bond_shear(law, std::max(0.0, sigma), 0) + law.mu * std::max(0.0, -sigma);
    if (shear_s * shear_s + shear_t * shear_t > most * most) return false;
    fs += p.weight * shear_s, ft += p.weight * shear_t, fn += p.weight * sigma;
    ms += p.weight * p.t * sigma, mt -= p.weight * p.s * sigma, mn += p.weight * (p.s * shear_t - p.t * shear_s);
  }
  force = Vec3(fs, ft, fn);
  moment = Vec3(ms, mt, mn);
  return true;
}

double stored(const Model& m, const State& s, int j, const JointPose& pose) {
  if (s.stage[z(j)] == JointStage::cracked) return s.memory[z(j)].elastic;
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
    const bool in_contact = s.stage[z(j)] == JointStage::contact;
    if (!in_contact && (s.stage[z(j)] != JointStage::intact || !intact_resultant(m, joint, pose, force, moment))) {
      double resultant[6];
      joint_by_points(m, s, j, pose.gap, resultant, sums);
      force = Vec3(resultant[0], resultant[1], resultant[2]);
      moment = Vec3(resultant[3], resultant[4], resultant[5]);
    }
    if (sample && !in_contact) sums.energy.elastic += stored(m, s, j, pose);
    const Vec3 arm_a = 0.5 * (pose.sum + pose.apart), arm_b = 0.5 * (pose.sum - pose.apart);
    if (m.dashpots && s.stage[z(j)] == JointStage::intact) {
      double resultant[6] = {force.x(), force.y(), force.z(), moment.x(), moment.y(), moment.z()};
      add_dashpots(m, s, j, pose.frame, arm_a, arm_b, resultant, sums);
      force = Vec3(resultant[0], resultant[1], resultant[2]);
      moment = Vec3(resultant[3], resultant[4], resultant[5]);
    }
    force = pose.frame * force;
    moment = pose.frame * moment;
    add(s.wrench, m.wrench_row_a[z(j)], force, arm_a.cross(force) + moment);
    add(s.wrench, m.wrench_row_b[z(j)], -force, -(arm_b.cross(force) + moment));
  }
}

}  // namespace erbs
