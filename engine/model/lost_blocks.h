// Blocks that have left the scene.
#pragma once
#include <string>
#include <vector>

#include "engine/model/state.h"

namespace erbs {

// Those that are below all fixed and moving blocks as built by more than the height of the structure.
std::vector<int> blocks_past_ground(const Model& m, const State& s);
// Message on blocks that fell past the ground and will fall for ever; "" if there are none.
std::string lost_blocks(const Model& m, const State& s);

}  // namespace erbs
