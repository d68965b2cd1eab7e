// Where things are: the building, the ground it stands on, and good places to look from.
#pragma once
#include <vector>

#include "engine/record/motion_file.h"
#include "engine/scene/scene.h"

namespace erbs::render {

struct Stage {
  Eigen::AlignedBox3d building;                            // m, all blocks but the ground, at rest
  Eigen::AlignedBox3d reach;                               // m, what may be seen of it over the whole run (for the shadow)
  Eigen::AlignedBox3d heap;                                // m, where nearly all block centres are at the end
  double ground_z = 0;                                     // m
  std::vector<bool> hidden;                                // blocks that are the ground: drawn as a plane               [blocks]
  double size() const { return building.sizes().norm(); }  // m
};

Stage set_stage(const MotionScene& scene, const std::vector<MotionFrame>& some_frames);

// Two views that show the whole building, and what becomes of it, from a corner each, in a picture of this width/height.
std::vector<Camera> choose_cameras(const Stage& stage, double aspect);

// What a camera sees. The overlay keeps the uppermost and lowermost part of the picture: the camera's field of view and its
// target are those of the part between.
struct View {
  Eigen::Matrix4f projection, view;  // view: world to camera
  Eigen::Vector3f eye;
  float pixel = 0;            // m, size of a pixel at a distance of 1 m
  float target_distance = 0;  // m
};
View look(const Camera& camera, const Stage& stage, int width, int height, double top, double bottom);

// The sun stands over the left shoulder of the camera, so that every view is lit alike. Unit, towards the sun.
Eigen::Vector3f sun_of(const Camera& camera);

// World to shadow map (clip space) for this sun.
Eigen::Matrix4f shadow_view(const Stage& stage, const Eigen::Vector3f& sun);

}  // namespace erbs::render
