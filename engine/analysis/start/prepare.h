// From a scene to a model with its state as built: time step with its reason, and what the model alone shows to be wrong.
#pragma once
#include <optional>

#include "engine/analysis/start/equilibrium.h"
#include "engine/model/build/build.h"
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
  double equilibrium_wall = 0;       // s
  std::vector<int> fallers;          // blocks that a damped ramp of gravity does not bring to rest ...
  std::optional<BlockPoses> fallen;  // ... and where it has left all, if the run begins before that
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  // details of a summary warning, for log.txt
};

// Errors that only the model shows: overlaps, loose wall blocks, a dt beyond the stability limit. The last is accepted with
// `allow_unstable`, or if the scene says unstable = true.
Prepared prepare(const Scene& scene, bool allow_unstable);

// Gravity or constant loads act.
inline bool starts_loaded(const Model& m) { return m.gravity.norm() > 0 || !m.force_loads.empty(); }

}  // namespace erbs::analysis
