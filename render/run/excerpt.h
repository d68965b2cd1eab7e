// The part of a run that is drawn: without hidden groups, and without what lies before a section.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/record/folder/motion_file.h"

namespace erbs::render {

// A plane normal to an axis. It cuts the blocks where they are at rest; each half then moves with its block.
struct Section {
  int axis = 0;     // 0, 1, 2: x, y, z
  double at = 0;    // m
  double keep = 0;  // +1: what lies above `at` is drawn; -1: below; 0: what lies behind the plane, seen from the first camera
};
// "x=1.2", "y<0.5" (draws what lies below 0.5 m) or "z>2"; Error if the text is none of these.
Section read_section(const std::string& text);

struct Excerpt {
  MotionScene scene;
  std::vector<std::size_t> blocks, joints;  // of the whole scene, in its order
  bool whole = true;
};

// For each block: is it in one of the groups? Error if a group has no block; `option` begins the message.
std::vector<bool> in_groups(const MotionScene& scene, const std::vector<std::string>& groups, const std::string& option);

// The scene without the blocks of these groups and without their joints. Error if no loose block is left.
Excerpt without_groups(const MotionScene& scene, const std::vector<std::string>& groups);
// The same part of a frame of the whole scene, without the stresses of its joints.
MotionFrame excerpt_of(const Excerpt& excerpt, MotionFrame frame);

// The parts of blocks and joints behind a section, with closed cut faces. Blocks and joints keep their places in the lists; what is
// cut away has no parts and no polygon. Blocks in `uncut` stay as they are. Error if the plane does not meet the other blocks.
MotionScene cut_scene(const MotionScene& scene, const Section& section, const std::vector<bool>& uncut);
// The convex part of a shape in which n.x >= d.
MotionShape cut_shape(const MotionShape& shape, const Vec3& n, double d);

}  // namespace erbs::render
