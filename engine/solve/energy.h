// The energy ledger, a discrete identity of leapfrog. T_n = v- m v+ / 2; the work of a force over a step is the mean of its two end values
// times the mid velocity. For linear springs the sum closes to round-off, so that a residual is an error.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Closes the ledger of `state.energy` at a sample (all terms filled): residual, its relative size, its largest jump.
//   residual = [T + Ug + Ue] - start + all dissipation - all work; relative to
//   max(1e-12 weight * height, 1e-8 of the elastic energy at the start,
//       largest (T + |dUe|) + Int |work| + dissipation + half the flux of height energy).
void settle(Energy& energy, double floor, double t, int worst_joint);

double dissipated(const Energy& energy);
double worked(const Energy& energy);

}  // namespace erbs
