// What recorders see at a sample: motion, forces and energies, all at its time.
#pragma once
#include "engine/record/recorders/recorders.h"
#include "engine/solve/step.h"

namespace erbs::analysis {

// Refers to the model, the state and the solver. `joint_forces`: with the force of each joint.
Snapshot snapshot_of(const Model& model, const State& state, const Solver& solver, bool joint_forces);

}  // namespace erbs::analysis
