// Columns of blocks that lie on each other: the scale of interlock (laws/interlock.h).
#pragma once
#include <span>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// s, `Hop` of the longest column through each block, which settles under its own weight [nblock]. `bounds`: s, time step that each block's
// own joints allow, without dashpots [nblock].
std::vector<Hop> hops_of(const Model& model, const State& state, std::span<const double> bounds);

}  // namespace erbs::analysis
