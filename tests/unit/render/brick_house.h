// A run folder without the engine, for tests of pictures: a brick house that shakes, cracks and falls in an invented motion.
#pragma once
#include <string>

#include "engine/record/folder/motion_file.h"

namespace erbs {

struct BrickHouse {
  double length_x = 1.525, length_y = 1.83;  // m
  int courses = 40;                          // of 105 mm each; from 39 on, three storeys with openings
  double duration = 4;                       // s
  double frame_dt = 0.04;                    // s
};

MotionScene brick_house(const BrickHouse& house);
MotionFrame brick_house_frame(const MotionScene& scene, double t);
// Writes manifest.json, histories.csv, energy.csv, motion.h5.
void write_brick_house(const std::string& dir, const BrickHouse& house);

}  // namespace erbs
