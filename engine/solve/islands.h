// Which blocks are joined to which: for the refresh of joint geometry, for damping, and for what counts as loose.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Recomputes island, grounded and joined from the joints that are not open.
void find_islands(const Model& model, State& state);

// Once a block has turned past Analysis::lazy_rotation since its last refresh: refreshes it and all that have turned half as far, so
// that not every step finds another one. Gives their joints.
std::vector<int> refresh_stale(const Model& model, State& state);

}  // namespace erbs
