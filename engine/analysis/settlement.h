// Settlement of a structure under its own weight: the scale of interlock (laws/interlock.h).
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// m, of the top of the pile of most courses, estimated. `block_bound`: s, the bound on the time step by blocks.
double settlement_of(const Model& model, const State& state, double block_bound);

}  // namespace erbs::analysis
