#include "engine/analysis/diagnostics.h"

#include <algorithm>
#include <cmath>

namespace erbs::analysis {

void update_diagnostics(RunDiagnostics& watch, const State& s, double allowed, double tolerance, LongSteps past) {
  const double residual = s.energy.residual_relative;
  if (residual > watch.residual) {
    watch.residual = residual;
    watch.residual_time = s.time.t - s.time.last_dt;
    watch.residual_joint = s.energy.largest_jump_joint;
  }
  const bool sinking = s.observed.max_penetration_relative > std::max(0.01, watch.max_penetration);
  watch.max_penetration = s.observed.max_penetration_relative;
  const long steps = s.time.step - watch.last_update;
  if (residual > tolerance) watch.past_tolerance += steps;
  if (past.count[0] == 0) past.add(s.time.last_dt / allowed, steps);
  const long late = past.count[0];
  for (std::size_t i = 0; i < past.count.size(); ++i) watch.past_step.count[i] += past.count[i];
  watch.past_step.worst = std::max(watch.past_step.worst, past.worst);
  if (sinking) watch.sinking += steps;
  watch.warned += residual > tolerance || sinking ? steps : late;
  watch.last_update = s.time.step;
}

bool stepped_too_far(const RunDiagnostics& watch, const State& s) {
  for (std::size_t i = 0; i < steps_too_long.size(); ++i)
    if (double(watch.past_step.count[i]) > steps_too_long[i].share * double(s.time.step)) return true;
  return false;
}

Metrics::Diagnostics diagnostics_of(const RunDiagnostics& watch, const Model& model, const State& s) {
  Metrics::Diagnostics diagnostics;
  diagnostics.energy_residual = watch.residual;
  diagnostics.energy_residual_time = watch.residual_time;
  if (watch.residual_joint >= 0) diagnostics.energy_residual_where = model.joint_name(watch.residual_joint);
  diagnostics.penetration = s.observed.max_penetration_relative;
  diagnostics.dt_margin = watch.past_step.worst;
  const auto share = [&](long steps) { return s.time.step > 0 ? double(steps) / double(s.time.step) : 0; };
  diagnostics.warned_share = share(watch.warned);
  diagnostics.past_tolerance_share = share(watch.past_tolerance);
  diagnostics.past_step_share = share(watch.past_step.count[0]);
  diagnostics.sinking_share = share(watch.sinking);
  diagnostics.reset_share = s.energy.reference > 0 ? std::fabs(s.energy.reset) / s.energy.reference : 0;
  diagnostics.momentum_residual = s.observed.momentum_residual;
  return diagnostics;
}

namespace {

std::string warned_text(const Metrics::Diagnostics& t) {
  std::string text;
  const auto add = [&](double share, const char* of) {
    if (share > 0) text += fmt::format("{}{:.3g} % {}", text.empty() ? "" : ", ", 100 * share, of);
  };
  add(t.past_tolerance_share, "energy residual above its tolerance");
  add(t.past_step_share, "dt above its limit");
  add(t.sinking_share, "deepening penetration");
  return text.empty() ? "no warning in any step" : "steps with a warning: " + text;
}

}  // namespace

std::string diagnostics_line(const Metrics::Diagnostics& t) {
  std::string line = fmt::format("trust: largest energy residual {:.1e}", t.energy_residual);
  if (t.energy_residual > 0)
    line +=
        fmt::format(" at {:.4g} s{}", t.energy_residual_time, t.energy_residual_where.empty() ? "" : " (" + t.energy_residual_where + ")");
  line += fmt::format(", energy reset {:.1e}, penetration {:.2g} % of a block's edge, {}, {}, momentum residual {:.0e}", t.reset_share,
                      100 * t.penetration, t.dt_margin > 0 ? fmt::format("dt at most {:.2f} of its limit", t.dt_margin) : "no limit to dt",
                      warned_text(t), t.momentum_residual);
  if (t.twin) line += t.chaos_horizon ? fmt::format(", chaos horizon {:.3g} s", *t.chaos_horizon) : ", no chaos within the run";
  return line;
}

}  // namespace erbs::analysis
