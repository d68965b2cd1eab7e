// How a joint looks now: for recorders and pictures, exact at any rotation of its blocks.
#pragma once
#include "engine/base/turn.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct JointLook {
  double opening = 0;  // m, largest over the corners of the joint (negative: closed all over)
  double slip = 0;     // m, largest over the corners
  double damage = 0;   // 0..1, share of the area whose points have any damage; 1 once handed over to contact
};

JointLook look_at_joint(const Model& model, const State& state, int j);
double joint_damage(const Model& model, const State& state, int j);  // JointLook::damage alone
bool joint_broken(const Model& model, const State& state, int j);  // every point has spent its bond
Mat3 joint_frame(const Model& model, const State& state, int j);   // columns s, t, n, turned with the mean of its blocks

}  // namespace erbs
