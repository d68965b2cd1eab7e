#include "engine/analysis/trust.h"

#include <algorithm>
#include <cmath>

namespace erbs {

void look(TrustWatch& watch, const State& s, double allowed, double gate) {
  const double residual = s.energy.residual_relative;
  if (residual > watch.residual) {
    watch.residual = residual;
    watch.residual_time = s.t - s.last_dt;
    watch.residual_joint = s.energy.largest_jump_joint;
  }
  const double margin = s.last_dt / allowed;
  watch.dt_margin = std::max(watch.dt_margin, margin);
  const bool sinking = s.max_penetration_relative > std::max(0.01, watch.deepest);
  watch.deepest = s.max_penetration_relative;
  const long steps = s.step - watch.looked;
  if (residual > gate) watch.past_gate += steps;
  if (margin > step_slack) watch.past_step += steps;
  if (sinking) watch.sinking += steps;
  if (residual > gate || margin > step_slack || sinking) watch.warned += steps;
  watch.looked = s.step;
}

bool stepped_too_far(const TrustWatch& watch, const State& s) {
  return std::ranges::any_of(steps_too_long, [&](const StepTooLong& limit) {
    return watch.dt_margin > limit.ratio && double(watch.past_step) > limit.share * double(s.step);
  });
}

Metrics::Trust trust_of(const TrustWatch& watch, const Model& model, const State& s) {
  Metrics::Trust trust;
  trust.energy_residual = watch.residual;
  trust.energy_residual_time = watch.residual_time;
  if (watch.residual_joint >= 0) trust.energy_residual_where = model.joint_name(watch.residual_joint);
  trust.penetration = s.max_penetration_relative;
  trust.dt_margin = watch.dt_margin;
  const auto share = [&](long steps) { return s.step > 0 ? double(steps) / double(s.step) : 0; };
  trust.warned_share = share(watch.warned);
  trust.past_gate_share = share(watch.past_gate);
  trust.past_step_share = share(watch.past_step);
  trust.sinking_share = share(watch.sinking);
  trust.reset_share = s.energy.reference > 0 ? std::fabs(s.energy.reset) / s.energy.reference : 0;
  trust.momentum_residual = s.momentum_residual;
  return trust;
}

namespace {

std::string warned_text(const Metrics::Trust& t) {
  std::string text;
  const auto add = [&](double share, const char* of) {
    if (share > 0) text += fmt::format("{}{:.2g} % {}", text.empty() ? "" : ", ", 100 * share, of);
  };
  add(t.past_gate_share, "energy past its gate");
  add(t.past_step_share, "step past its limit");
  add(t.sinking_share, "blocks sinking");
  return text.empty() ? "no step with a warning" : "steps with a warning: " + text;
}

}  // namespace

std::string trust_line(const Metrics::Trust& t) {
  std::string line = fmt::format("trust: energy residual at most {:.1e}", t.energy_residual);
  if (t.energy_residual > 0)
    line +=
        fmt::format(" at {:.4g} s{}", t.energy_residual_time, t.energy_residual_where.empty() ? "" : " (" + t.energy_residual_where + ")");
  line += fmt::format(", reset {:.1e} of what passed, penetration {:.1e}, dt at most {:.2f} of its limit, {}, momentum {:.0e}", t.reset_share,
                      t.penetration, t.dt_margin, warned_text(t), t.momentum_residual);
  if (t.twin) line += t.chaos_horizon ? fmt::format(", chaos horizon {:.3g} s", *t.chaos_horizon) : ", no chaos within the run";
  return line;
}

}  // namespace erbs
