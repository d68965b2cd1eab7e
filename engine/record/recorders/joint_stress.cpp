#include "engine/record/recorders/joint_stress.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/kinematics.h"
#include "engine/joints/response.h"

namespace erbs {
namespace {

std::array<double, 6> intact_gap(const Model& m, const BlockPoses& pose, int j) {
  const Joint& joint = m.joint[z(j)];
  const std::size_t a = z(joint.a), b = z(joint.b);
  const JointPose of = pose_of(joint, pose.u[a], pose.q[a], pose.u[b], pose.q[b]);
  std::array<double, 6> gap;
  std::copy_n(of.gap, 6, gap.begin());
  return gap;
}

// A joint as its law sees it.
struct Seen {
  const Model& model;
  const Joint& joint;
  std::array<double, 6> gap;
  double kn, ks;               // Pa/m, now
  const PointHistory* point;   // [points]; null while intact
  const CrushedFace* crushed;  // null unless crushed

  double opening(double s, double t) const { return gap[2] + gap[3] * t - gap[4] * s; }
  // Normal stress at (s, t), where a bond pulls with the stiffness `pull` (Pa/m).
  double normal(double s, double t, double pull) const {
    const double g = opening(s, t);
    if (g > 0) return pull * g;
    if (crushed == nullptr) return kn * g;
    const double plane[3] = {gap[2], -gap[4], gap[3]};
    return -kn * pressed_depth(compression_face(model, joint, kn), *crushed, plane, s, t);
  }
  double shear(int i) const {
    const Point& p = model.point[z(joint.type->first_cell + i)];
    const double s = gap[0] - gap[5] * p.t - (point != nullptr ? point[i].slip_s : 0),
                 t = gap[1] + gap[5] * p.s - (point != nullptr ? point[i].slip_t : 0);
    return ks * std::hypot(s, t);
  }
};

}  // namespace

std::array<double, 6> joint_resultant(const Model& m, const JointState& joints, const BlockPoses& pose, int j) {
  std::array<double, 6> f{};
  if (joints.stage[z(j)] == JointStage::cracked) std::copy_n(joints.memory[z(j)].resultant, 6, f.begin());
  if (joints.stage[z(j)] == JointStage::intact) {
    f = intact_gap(m, pose, j);
    for (std::size_t i = 0; i < 6; ++i) f[i] *= m.joint[z(j)].type->stiffness[i];
  }
  return f;
}

JointThrust joint_thrust(const Model& m, const JointState& joints, const BlockPoses& pose, int j) {
  const Joint& joint = m.joint[z(j)];
  const std::size_t a = z(joint.a), b = z(joint.b);
  const JointPose of = pose_of(joint, pose.u[a], pose.q[a], pose.u[b], pose.q[b]);
  const std::array<double, 6> f = joint_resultant(m, joints, pose, j);
  JointThrust thrust{of.frame * Vec3(f[0], f[1], f[2]), m.rest[a] + pose.u[a] + 0.5 * (of.sum + of.apart)};
  // The moment of a normal force at (s, t) about the centre is (t, -s) times the force.
  if (f[2] != 0) thrust.at += of.frame * Vec3(-f[4] / f[2], f[3] / f[2], 0);
  return thrust;
}

JointStress joint_stress(const Model& m, const JointState& joints, const BlockPoses& pose, int j) {
  JointStress stress;
  const Joint& joint = m.joint[z(j)];
  const JointType& type = *joint.type;
  if (joints.stage[z(j)] == JointStage::contact || !(type.area > 0)) return stress;
  const bool intact = joints.stage[z(j)] == JointStage::intact;
  const PointLaw& law = m.laws[z(type.law)];
  const StiffnessShare share = joints.share.empty() ? StiffnessShare{} : joints.share[z(j)];
  const CrushedFace* crushed = !intact && law.crushes() && joints.crushed[z(j)].planes > 0 ? &joints.crushed[z(j)] : nullptr;
  Seen seen{m, joint, {}, law.kn * share.n, law.ks * share.s, intact ? nullptr : &joints.history[z(joint.first_point)], crushed};
  if (intact) seen.gap = intact_gap(m, pose, j);
  else std::copy_n(joints.memory[z(j)].gap, 6, seen.gap.begin());
  const std::array<double, 6> force = joint_resultant(m, joints, pose, j);
  stress.normal = force[2] / type.area;
  stress.shear = std::hypot(force[0], force[1]) / type.area;
  stress.least = unbounded, stress.greatest = -unbounded;
  const auto take = [&](const Eigen::Vector2d& at, double pull) {
    const double sigma = seen.normal(at.x(), at.y(), pull);
    stress.least = std::min(stress.least, sigma), stress.greatest = std::max(stress.greatest, sigma);
  };
  for (int i = type.first_corner; i < type.first_corner + type.corners; ++i) take(m.overlap_corner[z(i)], intact ? law.kn : 0);
  for (int i = 0; i < type.points; ++i) {
    stress.greatest_shear = std::max(stress.greatest_shear, seen.shear(i));
    if (intact) continue;
    const PointHistory& h = seen.point[i];
    const double pull = law.has_bond() && h.damage < 1 ? (h.damage > 0 ? h.secant : seen.kn) : 0;
    const Cell& cell = m.cell[z(type.first_cell + i)];
    for (int k = cell.first; k < cell.first + cell.corners; ++k) take(m.cell_loop[z(k)], pull);
  }
  return stress;
}

double joint_crushing(const Model& m, const JointState& joints, int j) {
  const Joint& joint = m.joint[z(j)];
  const PointLaw& law = m.laws[z(joint.type->law)];
  if (!law.crushes_softly()) return 0;
  return lost_strength(compression_face(m, joint, law.kn), joints.crushed[z(j)]);
}

}  // namespace erbs
