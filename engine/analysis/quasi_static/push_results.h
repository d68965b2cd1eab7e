// What a push has come to: its capacity, its performance point, and the line that tells a user how far it is.
#pragma once
#include <optional>
#include <string>

#include "engine/analysis/quasi_static/push_state.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/record/results/metrics.h"
#include "engine/scene/performance.h"
#include "engine/scene/push.h"

namespace erbs::analysis {

bool by_displacement(const PushSettings& push);
// Under the load of its last state the structure falls.
bool past_peak(const PushSettings& push, const PushState& so_far);

// As far as the states tell.
Capacity capacity_of(const PushSettings& push, const PushState& so_far);

// How far to trust a push, with its worst energy residual. Shares of steps and the step over its limit belong to a time history: NaN.
Metrics::Diagnostics push_diagnostics(double residual, const Model& model, const State& state);

// `multiplier`: of the present load. `fall`: how far the fall after the last step has come; empty before it.
std::string progress_line(const PushSettings& push, const PushState& so_far, double multiplier, const std::string& fall);

// Writes the displaced shape of a pushover, and finds the performance point for the spectrum of the scene, if it has one. Where there is no
// such point, the answer names the trouble.
std::optional<Performance> assess_pushover(const std::string& dir, const PerformanceDemand& demand, const PushShape& shape);

}  // namespace erbs::analysis
