// Masses of a relaxation. What is at rest does not depend on them, so they may be chosen for speed.
#pragma once
#include "engine/base/sparse.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// Scales mass and inertia of each block so that all have one bound on the time step; the factors keep the total mass. Light and stiff
// blocks then no longer set the step of the others (Underwood 1983, Dynamic relaxation, section 5.3.2). Weights stay: `gravity_factor`.
void scale_inertia(Model& model, const State& state);

// The elastic structure under a force on each block.
struct ElasticPush {
  double frequency = 0;  // 1/s, Rayleigh's quotient of the motion; 0 if the structure is a mechanism
  VecX force, motion;    // N; m, of the blocks that joints connect to the ground
};
ElasticPush elastic_push(const Model& model, const State& state, const std::vector<Vec3>& force);  // N [nblock]

}  // namespace erbs::analysis
