// Report of blocks that have left the scene.
#pragma once
#include <string>

#include "engine/model/state.h"

namespace erbs::analysis {

// Message on blocks that fell past the ground and will fall for ever; "" if there are none.
std::string lost_blocks(const Model& m, const State& s);

}  // namespace erbs::analysis
