// Energy that the sequential sweep of Gu and Miao feeds to motion (`sequential.h`).
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Largest eigenvalue of M^-1 (D - K), 1/s2; D has the 6 x 6 diagonal blocks of K. On average over orders a sweep feeds motion at a rate of
// at most dt / 2 times this value; mass damping c / m of the same size makes it neutral. For a lattice of equal blocks the value is that of
// M^-1 D: rigid motion.
double sweep_feed(const Model& model, const State& state);

}  // namespace erbs
