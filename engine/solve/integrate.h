// Kick and drift of blocks: simultaneous leapfrog for translation, momentum- and energy-conserving midpoint for rotation.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// What acts on all blocks in this step: means over the kick's interval, exact in impulse.
struct Excitation {
  Vec3 ground = Vec3::Zero();   // m/s2, acceleration of the ground
  Vec3 gravity = Vec3::Zero();  // m/s2
  double kick = 0;              // s: half the last and half the next drift
};

// Sums over one fixed chunk of blocks; kept apart per chunk, so that totals do not depend on threads. The work of a step's forces
// is split at its positions: half the last drift with the old velocity (counted at once), half the next drift with the new one
// (`after`, counted when the next step is taken). Sums then close exactly at every position: energy.h.
struct BlockSums {
  double base_work = 0, external_work = 0, damping = 0, absolute_work = 0;  // J
  double base_after = 0, external_after = 0, damping_after = 0, absolute_after = 0;
  double kinetic = 0, height = 0;  // J, filled on request: T_n = v- m v+ / 2 and -sum m g.u
  double fastest = 0;              // m2/s2, largest squared speed of a block that moves
  bool stale = false;              // a joined block turned past the tolerance since its refresh
  bool broken = false;             // not a number
};

inline constexpr int block_grain = 32;

// Blocks [first, last): sum their wrench rows and pushes, kick by e.kick, drift by s.dt. Six doubles a block (force, moment):
// `push` from contacts, `load` from external loads (null where there are none), whose work is booked as external.
// Fills kinetic and height when `sample`.
void advance(const Model& model, State& state, const Excitation& e, const double* push, const double* load, int first, int last,
             bool sample, BlockSums& sums);

// Sum of the wrench rows of a block's joints: force, moment.
Vec6 joint_wrench(const Model& model, const State& state, int b);

}  // namespace erbs
