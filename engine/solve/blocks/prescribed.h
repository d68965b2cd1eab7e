// Where the prescribed motions of a block put it.
#pragma once
#include "engine/model/model.h"

namespace erbs {

struct PrescribedPose {
  Vec3 u = Vec3::Zero();  // m from rest
  Quat q = Quat::Identity();
};

// At time t (s). `attitude`: of a block that is not prescribed to rotate.
PrescribedPose prescribed_pose(const Model& model, int block, double t, const Quat& attitude);

}  // namespace erbs
