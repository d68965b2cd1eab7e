// The curve of a push: a row of curve.csv for each state of equilibrium.
#pragma once
#include <string>
#include <vector>

#include "engine/analysis/quasi_static/relaxation.h"
#include "engine/record/results/capacity.h"

namespace erbs::analysis {

// A multiplier as the curve shows it: of a tilt the tangent of its angle, the acceleration over g.
double shown_multiplier(const PushSettings& push, double multiplier);

// All of a point but what the relaxation says of itself; the solver is at a sample of `state`. `model` has the true masses.
CurvePoint curve_point(const Model& model, const State& state, const Relaxation& relaxation, const Solver& solver,
                       const PushSettings& push);

std::vector<std::string> curve_columns(const PushSettings& push);
std::vector<double> curve_row(const CurvePoint& point);

}  // namespace erbs::analysis
