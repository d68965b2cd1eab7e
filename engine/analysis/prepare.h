// From a scene to a run that can start: model, time step with its reason, equilibrium under gravity.
#pragma once
#include "engine/analysis/equilibrium.h"
#include "engine/model/build.h"
#include "engine/solve/stiffness.h"

namespace erbs {

struct Prepared {
  Model model;
  State state;
  StepBounds bounds;
  std::string dt_rule;  // what set dt, in words
  Equilibrium equilibrium;
  std::vector<int> fallers;  // blocks that a damped ramp of gravity did not bring to rest
};

// Errors for what only the model shows (overlaps, loose wall blocks, a dt past the limit: refused unless `allow_unstable` or
// the scene says unstable = true).
Prepared prepare(const Scene& scene, bool allow_unstable);

// Brings gravity and constant loads on, as Analysis::start says. Islands that have no equilibrium by Newton's method, and only they, are
// brought on by a damped ramp. Leaves velocities as the scene gives them.
void start_at_rest(const Scene& scene, Prepared& run, int threads);

// Share of the moving mass that did not come to rest under its own weight.
double falling_share(const Prepared& run);

// Moves and turns every block that may move by up to `reach` (m about each axis, rad about each), from a seed: what exact symmetry
// would hide shows.
void add_noise(Prepared& run, double reach, unsigned seed);

}  // namespace erbs
