// A run folder without an engine: a brick house that shakes, cracks and falls by a made-up motion. For tests of pictures.
#pragma once
#include <string>

#include "engine/record/motion_file.h"

namespace erbs {

struct BrickHouse {
  double length_x = 1.525, length_y = 1.83;  // m
  int courses = 40;                          // of 105 mm; three storeys with openings when at least 39
  double duration = 4;                       // s
  double frame_dt = 0.04;                    // s
};

MotionScene brick_house(const BrickHouse& house);
MotionFrame brick_house_frame(const MotionScene& scene, double t);
// manifest.json, histories.csv, energy.csv, motion.h5
void write_brick_house(const std::string& dir, const BrickHouse& house);

}  // namespace erbs
