#include "engine/solve/blocks/prescribed.h"

#include "engine/base/rotation.h"

namespace erbs {

PrescribedPose prescribed_pose(const Model& model, int block, double t, const Quat& attitude) {
  PrescribedPose pose;
  bool rotates = false;
  for (const auto& d : model.prescribed_motions) {
    if (d.block != block) continue;
    const double x = value(d.wave, t);
    if (!d.rotates) {
      pose.u += x * d.direction;
      continue;
    }
    const Quat angle = rotation(x * d.direction);
    pose.u += angle * d.arm - d.arm;
    pose.q = angle * pose.q;
    rotates = true;
  }
  if (!rotates) pose.q = attitude;
  return pose;
}

}  // namespace erbs
