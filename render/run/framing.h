// Places cameras so that what they should show fills the picture.
#pragma once
#include <optional>
#include <vector>

#include "render/run/stage.h"

namespace erbs::render {

// Collects the points that a camera should show. It keeps those that are outermost for the direction of view and the fov, so that the
// corners of all blocks in all frames of a film may be added.
class Framing {
 public:
  // `direction`: towards the camera; an `up` along it is replaced. `aspect`: width over height of what the camera sees. `spare`: share of
  // the smaller side of the picture that is left free on each side.
  Framing(const Camera& camera, const Vec3& direction, const Stage& stage, double aspect, double spare);
  void add(const Vec3& p);
  // The nearest camera of this direction that sees all points. Along the side where this leaves room they are in the middle. They fill
  // the picture or, if they would reach the legend at its upper right, the part beside it. The target is as far as the point `target`;
  // without one, as the middle of the points. Without points the camera stays as it is.
  Camera camera(const std::optional<Vec3>& target = std::nullopt) const;

 private:
  Vec3 eye_of(const Eigen::AlignedBox2d& window) const;
  std::vector<Eigen::Vector2d> places(const Vec3& eye) const;
  void keep_outermost();

  Camera camera_;
  Mat3 axes_;             // rows: right, up, back
  Eigen::Vector2d half_;  // of the picture, at a distance of 1
  // Parts of the picture, -1..1, to be filled: all of it, or beside the legend, with room for the axes at the left. Corner of the legend.
  Eigen::AlignedBox2d whole_, beside_;
  Eigen::Vector2d legend_;
  std::vector<Vec3> points_;  // right, up, back
};

// Corners of the blocks of `drawn` that are visible in this frame. Those that have been thrown far from the building, or have fallen past
// the ground, are left out; a picture that holds them would show the building too small.
std::vector<Vec3> visible_corners(const MotionScene& drawn, const Stage& stage, const MotionFrame& frame);

// Two cameras, each from one corner, and from in front of a table that turns. They show the whole building and its final heap, in a picture
// of this width/height.
std::vector<Camera> choose_cameras(const Stage& stage, double aspect);

// Elevations and a plan, from_-x ... from_+y and from_above: seen from very far, so that they are nearly parallel projections.
std::vector<Camera> elevations(const Stage& stage, double aspect);

}  // namespace erbs::render
