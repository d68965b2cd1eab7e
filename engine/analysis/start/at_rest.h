// The start of a run: the structure at rest under gravity and constant loads, with what lies on it.
#pragma once
#include "engine/analysis/start/ramp.h"
#include "engine/record/results/metrics.h"

namespace erbs::analysis {

// Applies gravity, on the table as it stands at first, and constant loads as `Analysis::start` says. Islands without an equilibrium by
// Newton's method get a damped ramp instead; others do not. What lies on the structure without a joint is lowered onto it (resting.h).
// Velocities stay as the scene gives them.
void start_at_rest(const Scene& scene, Prepared& run, int threads, const StartTold& told = {});

// The start in metrics.json and manifest.json.
Metrics::Equilibrium equilibrium_metrics(const Prepared& run);

// What the structure is at rest under, in words: its own weight, and loads that act from t = 0 as constant ones do.
std::string weight_at_start(const Model& model);

// Share of the moving mass that did not come to rest under its own weight.
double falling_share(const Prepared& run);

// Perturbs every movable block by up to `reach`: m along each axis and rad about each, from a seed. The perturbation reveals behaviour that
// exact symmetry would hide.
void add_noise(Prepared& run, double reach, unsigned seed);

}  // namespace erbs::analysis
