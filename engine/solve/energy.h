// The energy ledger: physics.md's discrete identity. T_n = v- m v+ / 2, and every force works over a step by the mean of its two
// end values times the mid velocity; for linear springs the sum then closes to round-off, so that a residual is an error.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Settles the ledger of state.energy at a sample (all terms filled): residual, its relative size, its largest jump.
// residual = [T + Ug + Ue] - start + all dissipation - all work; relative to
// max(1e-12 weight * height, 1e-8 of the elastic energy at the start, largest (T + |dUe|) + Int |work| + dissipation + half the flux of height energy).
void settle(Energy& energy, double floor, double t, int worst_joint);

double dissipated(const Energy& energy);
double worked(const Energy& energy);

}  // namespace erbs
