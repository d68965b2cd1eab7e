#include "engine/record/recorders/joint_condition.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/joints/response.h"
#include "engine/laws/crushing.h"

namespace erbs {

Mat3 joint_frame(const Model& model, const BlockPoses& pose, int j) {
  const Joint& joint = model.joint[std::size_t(j)];
  const Quat &qa = pose.q[std::size_t(joint.a)], &qb = pose.q[std::size_t(joint.b)];
  const Quat mean = rotation(0.5 * rotation_vector(qb * qa.conjugate())) * qa;
  return mean.toRotationMatrix() * joint.type->frame;
}

JointCondition joint_condition(const Model& model, const JointState& joints, const BlockPoses& pose, int j) {
  const Joint& joint = model.joint[std::size_t(j)];
  const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
  const Mat3 frame = joint_frame(model, pose, j);
  JointCondition condition;
  condition.opening = -std::numeric_limits<double>::infinity();
  double farthest = 0;  // m2
  for (int i = joint.type->first_corner; i < joint.type->first_corner + joint.type->corners; ++i) {
    const Eigen::Vector2d& c = model.overlap_corner[std::size_t(i)];
    const Vec3 across = joint.type->frame.col(0) * c.x() + joint.type->frame.col(1) * c.y();
    const Vec3 gap = frame.transpose() * (pose.u[b] - pose.u[a] + rotation_change(pose.q[b], joint.arm_b + across) -
                                          rotation_change(pose.q[a], joint.arm_a + across));
    condition.opening = std::max(condition.opening, gap.z());
    farthest = std::max(farthest, gap.head<2>().squaredNorm());
  }
  condition.slip = std::sqrt(farthest);
  if (joint.type->corners == 0) condition.opening = 0;
  condition.damage = joint_damage(model, joints, j);
  return condition;
}

double joint_damage(const Model& model, const JointState& joints, int j) {
  if (joints.stage[std::size_t(j)] == JointStage::contact) return 1;
  const Joint& joint = model.joint[std::size_t(j)];
  const CrushedFace* crushed = model.laws[std::size_t(joint.type->law)].crushes_softly() ? &joints.crushed[std::size_t(j)] : nullptr;
  double damaged = 0, whole = 0;
  for (int i = 0; i < joint.type->points; ++i) {
    const Point& point = model.point[std::size_t(joint.type->first_cell + i)];
    whole += point.weight;
    if (joints.history[std::size_t(joint.first_point + i)].damage > 0 ||
        (crushed != nullptr && crushed->planes > 0 && crushed_depth(compression_face(model, joint, 1), *crushed, point.s, point.t) > 0))
      damaged += point.weight;
  }
  return whole > 0 ? damaged / whole : 0.0;
}

bool joint_broken(const Model& model, const JointState& joints, int j) {
  if (joints.stage[std::size_t(j)] == JointStage::contact) return true;
  const Joint& joint = model.joint[std::size_t(j)];
  if (joints.stage[std::size_t(j)] == JointStage::intact || joint.type->points == 0 || !model.laws[std::size_t(joint.type->law)].has_bond())
    return false;
  for (int i = joint.first_point; i < joint.first_point + joint.type->points; ++i)
    if (joints.history[std::size_t(i)].damage < 1) return false;
  return true;
}

}  // namespace erbs
