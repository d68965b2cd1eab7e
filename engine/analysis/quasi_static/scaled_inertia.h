// Masses of a relaxation. What is at rest does not depend on them, so they may be chosen for speed.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// Scales mass and inertia of each block so that all have one bound on the time step; the factors keep the total mass. Light and stiff
// blocks then no longer set the step of the others (Underwood 1983, Dynamic relaxation, section 5.3.2). Weights stay: `gravity_factor`.
void scale_inertia(Model& model, const State& state);

}  // namespace erbs::analysis
