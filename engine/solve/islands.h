// Which blocks are joined to which: for the refresh of joint geometry, for damping, and for what counts as loose.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Recomputes island, grounded and joined from the joints that are not open.
void find_islands(const Model& model, State& state);

// Once a block has turned past Analysis::lazy_rotation since its last refresh: its pose becomes its reference, and so do those of all that
// have turned half as far, lest every step find another one. True where there are such: 1 in `stale` [nblock + 1]; the geometry of their
// joints is to follow.
bool take_stale_poses(const Model& model, State& state, std::vector<std::uint8_t>& stale);

}  // namespace erbs
