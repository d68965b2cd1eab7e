// Which blocks are joined to which: for the refresh of joint geometry, for damping, and for what counts as loose.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Recomputes island, grounded and joined from the joints that are not open.
void find_islands(const Model& model, State& state);

// Refreshes the geometry of every island with a block turned past Analysis::lazy_rotation.
void refresh_stale(const Model& model, State& state);

}  // namespace erbs
