// What of a model is drawn.
#pragma once
#include "render/draw/draw.h"

namespace erbs::render {

inline Eigen::Quaternionf turn_of(const MotionFrame& f, std::size_t block) {
  const float* p = &f.poses[7 * block];
  return {p[3], p[4], p[5], p[6]};
}
inline Eigen::Vector3f place_of(const MotionFrame& f, std::size_t block) {  // m
  return Eigen::Map<const Eigen::Vector3f>(&f.poses[7 * block]);
}

// Poses with the displacement of each block, and its rotation times its radius, rounded to at most a fiftieth of a pixel where it stands.
// Pictures between which nothing moves by a visible distance then have equal texels, and are drawn once. `pixel`: m, at a distance of 1 m;
// 0: as they are.
std::vector<float> rounded_poses(const Show& show, const MotionFrame& frame, const Vec3& eye, double pixel);

// Selects the triangles that may be seen; `t` knows how far joints have parted. Around a joint that has visibly parted, everything is
// drawn, but for mortar behind the band of its crack.
void choose_triangles(const Show& show, const MotionFrame& frame, Coloring coloring, const Vec3& eye, const Fineness& fineness,
                      FrameTexels& t);

}  // namespace erbs::render
