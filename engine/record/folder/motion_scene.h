// The constant part of motion.h5: shapes, blocks, joints.
#pragma once
#include "engine/record/folder/motion_file.h"
#include "engine/record/format/h5.h"

namespace erbs {

void put_scene(const h5::File& store, const MotionScene& scene);
MotionScene get_scene(const h5::File& store);

}  // namespace erbs
