// From a scene to a run ready to start: model, time step with its reason, equilibrium under gravity.
#pragma once
#include "engine/analysis/equilibrium.h"
#include "engine/model/build/build.h"
#include "engine/record/results/metrics.h"
#include "engine/solve/contacts/time_step_bound.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs::analysis {

struct Prepared {
  Model model;
  State state;
  StepBounds bounds;
  StepRange range;
  std::string dt_rule;  // the rule that gave dt, in words
  Equilibrium equilibrium;
  double equilibrium_wall = 0;  // s
  std::vector<int> fallers;     // blocks still moving after a damped ramp of gravity
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  // details of a summary warning, for log.txt
};

// Errors that only the model shows: overlaps, loose wall blocks, a dt beyond the stability limit. The last is accepted with
// `allow_unstable`, or if the scene says unstable = true.
Prepared prepare(const Scene& scene, bool allow_unstable);

// Applies gravity and constant loads as `Analysis::start` says. Islands without an equilibrium by Newton's method get a damped ramp
// instead; others do not. Velocities stay as the scene gives them.
void start_at_rest(const Scene& scene, Prepared& run, int threads);

// The start in metrics.json and manifest.json.
Metrics::Equilibrium equilibrium_metrics(const Prepared& run);

// Share of the moving mass that did not come to rest under its own weight.
double falling_share(const Prepared& run);

// Perturbs every movable block by up to `reach`: m along each axis and rad about each, from a seed. The perturbation reveals behaviour that
// exact symmetry would hide.
void add_noise(Prepared& run, double reach, unsigned seed);

}  // namespace erbs::analysis
