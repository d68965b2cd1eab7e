#include "engine/record/recorders/joint.h"

#include "engine/record/recorders/joint_stress.h"

namespace erbs {

JointQuantity::JointQuantity(const RecorderRequest& request)
    : what(What(quantity_index(quantities(), request.recorder.quantity))),
      name(request.recorder.name),
      axis(request.recorder.axis),
      centre(Vec3::Zero()) {
  const auto in = [](const std::vector<int>& set, int b) { return set.empty() || std::find(set.begin(), set.end(), b) != set.end(); };
  double area = 0;
  for (int j = 0; j < request.model.njoint; ++j) {
    const Joint& joint = request.model.joint[std::size_t(j)];
    const bool forth = in(request.blocks, joint.a) && in(request.others, joint.b),
               back = in(request.blocks, joint.b) && in(request.others, joint.a);
    if (!forth && !back) continue;
    joints.push_back(j);
    sign.push_back(forth ? 1.0 : -1.0);
    centre += joint.type->area * (request.model.rest[std::size_t(joint.a)] + joint.arm_a);
    area += joint.type->area;
  }
  if (joints.empty())
    throw Error(fmt::format("recorder \"{}\": no joint between the blocks it names; check `blocks` and `between`", name),
                request.recorder.place);
  if (area > 0) centre /= area;
}

void JointQuantity::sample(const Snapshot& s, double* out) const {
  double largest = what == What::opening ? -unbounded : 0, normal = 0, damaged = 0, area = 0, broken = 0;
  double least_stress = unbounded, greatest_stress = -unbounded;
  Vec3 along = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const int j = joints[i];
    const Joint& joint = s.model.joint[std::size_t(j)];
    switch (what) {
      case What::opening:
        largest = std::max(largest, joint_condition(s.model, s.joints, s.pose, j).opening);
        break;
      case What::slip:
        largest = std::max(largest, joint_condition(s.model, s.joints, s.pose, j).slip);
        break;
      case What::damage:
        damaged += joint.type->area * joint_damage(s.model, s.joints, j);
        area += joint.type->area;
        break;
      case What::broken:
        broken += joint_broken(s.model, s.joints, j) ? 1 : 0;
        break;
      case What::crushing:
        damaged += joint.type->area * joint_crushing(s.model, s.joints, j);
        area += joint.type->area;
        break;
      case What::normal_stress:
      case What::shear_stress: {
        const JointStress stress = joint_stress(s.model, s.joints, s.pose, j);
        least_stress = std::min(least_stress, stress.least);
        greatest_stress = std::max(greatest_stress, what == What::normal_stress ? stress.greatest : stress.greatest_shear);
        area += joint.type->area;
        [[fallthrough]];
      }
      case What::normal_force:
      case What::shear_force:
      case What::joint_moment: {
        ERBS_ASSERT(s.joint_force.size() >= std::size_t(s.model.njoint));
        const auto& f = s.joint_force[std::size_t(j)];
        const Mat3 frame = joint_frame(s.model, s.pose, j);
        const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
        const Vec3 force = frame * Vec3(f[0], f[1], f[2]);
        // The force acts midway between the two material points that coincided at rest (kinematics.h).
        const Vec3 at =
            s.model.rest[a] + joint.arm_a +
            0.5 * (s.pose.u[a] + s.pose.u[b] + rotation_change(s.pose.q[a], joint.arm_a) + rotation_change(s.pose.q[b], joint.arm_b));
        normal += f[2];
        along += sign[i] * (force - frame.col(2) * f[2]);
        moment += sign[i] * (frame * Vec3(f[3], f[4], f[5]) + Vec3(at - centre).cross(force));
        break;
      }
    }
  }
  switch (what) {
    case What::opening:
    case What::slip:
      out[0] = largest;
      break;
    case What::normal_force:
      out[0] = normal;
      break;
    case What::shear_force:
      out[0] = along.norm();
      break;
    case What::joint_moment:
      put_axes(moment, axis, out);
      break;
    case What::damage:
    case What::crushing:
      out[0] = area > 0 ? damaged / area : 0;
      break;
    case What::broken:
      out[0] = broken;
      break;
    case What::normal_stress:
      out[0] = area > 0 ? normal / area : 0, out[1] = least_stress, out[2] = greatest_stress;
      break;
    case What::shear_stress:
      out[0] = area > 0 ? along.norm() / area : 0, out[1] = greatest_stress;
      break;
  }
}

}  // namespace erbs
