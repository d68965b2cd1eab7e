#include "engine/analysis/quasi_static/push_results.h"

#include <cmath>

#include "engine/analysis/diagnostics.h"
#include "engine/base/error.h"
#include "engine/record/performance/performance_folder.h"

namespace erbs::analysis {

bool by_displacement(const PushSettings& push) { return push.control == "displacement"; }

bool past_peak(const PushSettings& push, const PushState& so_far) {
  return by_displacement(push) && so_far.multiplier < so_far.peak.multiplier;
}

Capacity capacity_of(const PushSettings& push, const PushState& so_far) {
  Capacity c;
  c.kind = push.kind;
  c.peak = so_far.peak;
  c.past_peak = past_peak(push, so_far);
  if (so_far.path.above && !c.past_peak) c.above = shown_multiplier(push, *so_far.path.above);
  c.states = int(so_far.states), c.attempts = int(so_far.attempts);
  c.relaxation_steps = so_far.steps;
  c.worst_unbalanced = so_far.worst_unbalanced;
  return c;
}

Metrics::Diagnostics push_diagnostics(double residual, const Model& model, const State& state) {
  RunDiagnostics seen;
  seen.residual = residual;
  seen.residual_joint = state.energy.largest_jump_joint;
  Metrics::Diagnostics d = diagnostics_of(seen, model, state);
  d.energy_residual_time = d.dt_margin = d.warned_share = d.past_tolerance_share = d.past_step_share = d.sinking_share = NAN;
  return d;
}

std::string progress_line(const PushSettings& push, const PushState& so_far, double multiplier, const std::string& fall) {
  const std::string none = so_far.path.above ? fmt::format(", none at {:.5g}", shown_multiplier(push, *so_far.path.above)) : "";
  if (!fall.empty()) return fmt::format("capacity {:.5g}{}; {}", so_far.peak.multiplier, none, fall);
  return fmt::format("multiplier {:.5g}, highest in equilibrium {:.5g}{}; {} states", shown_multiplier(push, multiplier),
                     so_far.peak.multiplier, none, so_far.states);
}

std::optional<Performance> assess_pushover(const std::string& dir, const PerformanceDemand& demand, const PushShape& shape) {
  write_shape(dir, shape);
  if (!demand.given()) return std::nullopt;
  try {
    return evaluate_performance(dir, demand, own_performance(dir));
  } catch (const Error& error) {
    Performance none;
    none.spectrum = spectrum_name(demand.spectrum);
    none.trouble = error.what();
    return none;
  }
}

}  // namespace erbs::analysis
