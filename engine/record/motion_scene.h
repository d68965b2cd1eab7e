// The constant part of motion.h5: shapes, blocks, joints.
#pragma once
#include "engine/record/h5.h"
#include "engine/record/motion_file.h"

namespace erbs {

void put_scene(const h5::File& store, const MotionScene& scene);
MotionScene get_scene(const h5::File& store);

}  // namespace erbs
