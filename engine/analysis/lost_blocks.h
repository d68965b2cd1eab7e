// What a run tells of blocks that have left the scene.
#pragma once
#include <string>

#include "engine/model/state.h"

namespace erbs {

// What has come off beyond the ground and falls on for ever; "" where nothing has.
std::string lost_blocks(const Model& m, const State& s);

}  // namespace erbs
