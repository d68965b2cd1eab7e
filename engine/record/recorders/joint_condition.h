// Current opening, slip and damage of a joint, for recorders and pictures; exact at any rotation of its blocks.
#pragma once
#include "engine/base/rotation.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct JointCondition {
  double opening = 0;  // m, largest over the corners of the joint; negative: closed everywhere
  double slip = 0;     // m, largest over the corners
  double damage = 0;   // 0..1, area share of points with any damage of bond or strength; 1 after release to contact
};

JointCondition joint_condition(const Model& model, const JointState& joints, const BlockPoses& pose, int j);
double joint_damage(const Model& model, const JointState& joints, int j);  // JointCondition::damage alone
bool joint_broken(const Model& model, const JointState& joints, int j);    // every point is debonded, or the joint is released to contact
Mat3 joint_frame(const Model& model, const BlockPoses& pose, int j);       // columns s, t, n, rotated by the mean rotation of its blocks

}  // namespace erbs
