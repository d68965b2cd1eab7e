// Extents of the building and its ground, and good viewpoints.
#pragma once
#include <vector>

#include "engine/record/folder/motion_file.h"
#include "engine/scene/scene.h"

namespace erbs::render {

struct Stage {
  Eigen::AlignedBox3d building;                            // m, all blocks except the ground, at rest
  Eigen::AlignedBox3d reach;                               // m, its visible extent over the whole run (for the shadow)
  Eigen::AlignedBox3d heap;                                // m, extent of nearly all blocks at the end, each whole
  double ground_z = 0;                                     // m
  Eigen::AlignedBox3d table;                               // m, what turns in a tilting test: the ground under all that is visible
  Eigen::AlignedBox3d footing;                             // m, its part near the building, with which it rests on a floor
  bool on_ground = false;                                  // a ground block is drawn as a plane
  std::vector<Eigen::Isometry3d> positions;                // of the table over the run; empty: it stays
  bool floor = true;                                       // is drawn below a table that turns
  bool bounded = false;                                    // blocks fall past a level ground, which is drawn only as far as it reaches
  double legend_width = 0, legend_height = 0;              // shares of what a camera sees that a legend covers, at its upper right
  std::vector<bool> hidden;                                // ground blocks, drawn as a plane [blocks]
  double size() const { return building.sizes().norm(); }  // m
};

Stage set_stage(const MotionScene& scene, const std::vector<MotionFrame>& some_frames);

// Position of the table in the level world, from the scene: its footing rests on the lowest edge, on the floor.
Eigen::Isometry3d table_position(const Stage& stage, const Mat3& levelling);
// Sets the positions of the table in these frames, with the levelling of each, and whether there is a floor below it.
void turn_table(Stage& stage, const MotionScene& scene, const std::vector<MotionFrame>& some_frames, const std::vector<Mat3>& levelling);
// Sets `bounded` where a block ends below the ground, or below all that can be its support where the scene has no ground.
void bound_ground(Stage& stage, const MotionScene& scene, const std::vector<MotionFrame>& some_frames);
// The camera of the level world, as the scene sees it.
Camera in_scene(const Camera& camera, const Eigen::Isometry3d& position);

// View of a camera. The overlay covers the top and bottom of the picture; field of view and target of the camera refer to the part between.
struct View {
  Eigen::Matrix4f projection, view;  // view: world to camera
  Eigen::Vector3f eye;
  float pixel = 0;            // m, size of a pixel at a distance of 1 m
  float target_distance = 0;  // m
};
View look(const Camera& camera, const Stage& stage, int width, int height, double top, double bottom);

// The sun stands over the left shoulder of the camera, so that all views are lit alike. Unit vector towards the sun.
Eigen::Vector3f sun_of(const Camera& camera);

// Transform from world to the clip space of the shadow map, for this sun.
Eigen::Matrix4f shadow_view(const Stage& stage, const Eigen::Vector3f& sun);

}  // namespace erbs::render
