// A push of a scene: equilibrium under gravity, then states of equilibrium at growing loads, until there is none. A run folder as that of
// a time history, with curve.csv beside it.
#pragma once
#include "engine/analysis/dynamic.h"

namespace erbs::analysis {

// As run_dynamic(). Times in the run folder number the states: each state in equilibrium takes one `frame_dt`, and the fall its own time.
RunOutcome run_push(Scene scene, const std::string& script, const RunOptions& options);

}  // namespace erbs::analysis
