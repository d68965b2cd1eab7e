// What the sequential sweep of Gu and Miao feeds motion by (sequential.h).
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// The largest eigenvalue of M^-1 (D - K), 1/s2, D being the 6 x 6 blocks of K on its diagonal: in the mean over orders a sweep feeds
// by dt / 2 times it at most, and so much mass damping c / m makes it neutral. A lattice of equal blocks has that of M^-1 D here: rigid
// motion.
double sweep_feed(const Model& model, const State& state);

}  // namespace erbs
