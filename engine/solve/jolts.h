// Blows that loads give at a known time: by a driven block that starts, stops or reverses at once, by a pulse of the ground or of a force
// that lasts a few steps. What rests on such a block touches it already, so that no approach foretells the blow.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Event rate (1/s, event_bound.h) of such blows within the next steps, of all contacts and of joints that may open.
// `budget`: J, of one event; `share`: of the energy of a blow (`blow_share`). 0: none is near.
double jolt_rate(const Model& model, const State& state, double budget, double share);

}  // namespace erbs
