#include "engine/analysis/trust.h"

#include <algorithm>
#include <cmath>

namespace erbs {

void look(TrustWatch& watch, const State& s, double allowed, double gate, LongSteps past) {
  const double residual = s.energy.residual_relative;
  if (residual > watch.residual) {
    watch.residual = residual;
    watch.residual_time = s.t - s.last_dt;
    watch.residual_joint = s.energy.largest_jump_joint;
  }
  const bool sinking = s.max_penetration_relative > std::max(0.01, watch.deepest);
  watch.deepest = s.max_penetration_relative;
  const long steps = s.step - watch.looked;
  if (residual > gate) watch.past_gate += steps;
  if (past.count[0] == 0) past.add(s.last_dt / allowed, steps);
  const long late = past.count[0];
  for (std::size_t i = 0; i < past.count.size(); ++i) watch.past_step.count[i] += past.count[i];
  watch.past_step.worst = std::max(watch.past_step.worst, past.worst);
  if (sinking) watch.sinking += steps;
  watch.warned += residual > gate || sinking ? steps : late;
  watch.looked = s.step;
}

bool stepped_too_far(const TrustWatch& watch, const State& s) {
  for (std::size_t i = 0; i < steps_too_long.size(); ++i)
    if (double(watch.past_step.count[i]) > steps_too_long[i].share * double(s.step)) return true;
  return false;
}

Metrics::Trust trust_of(const TrustWatch& watch, const Model& model, const State& s) {
  Metrics::Trust trust;
  trust.energy_residual = watch.residual;
  trust.energy_residual_time = watch.residual_time;
  if (watch.residual_joint >= 0) trust.energy_residual_where = model.joint_name(watch.residual_joint);
  trust.penetration = s.max_penetration_relative;
  trust.dt_margin = watch.past_step.worst;
  const auto share = [&](long steps) { return s.step > 0 ? double(steps) / double(s.step) : 0; };
  trust.warned_share = share(watch.warned);
  trust.past_gate_share = share(watch.past_gate);
  trust.past_step_share = share(watch.past_step.count[0]);
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
  add(t.past_gate_share, "energy residual above its tolerance");
  add(t.past_step_share, "dt above its limit");
  add(t.sinking_share, "deepening penetration");
  return text.empty() ? "no warning in any step" : "steps with a warning: " + text;
}

}  // namespace

std::string trust_line(const Metrics::Trust& t) {
  std::string line = fmt::format("trust: largest energy residual {:.1e}", t.energy_residual);
  if (t.energy_residual > 0)
    line +=
        fmt::format(" at {:.4g} s{}", t.energy_residual_time, t.energy_residual_where.empty() ? "" : " (" + t.energy_residual_where + ")");
  line += fmt::format(", energy reset {:.1e}, penetration {:.1e}, dt at most {:.2f} of its limit, {}, momentum residual {:.0e}",
                      t.reset_share, t.penetration, t.dt_margin, warned_text(t), t.momentum_residual);
  if (t.twin) line += t.chaos_horizon ? fmt::format(", chaos horizon {:.3g} s", *t.chaos_horizon) : ", no chaos within the run";
  return line;
}

}  // namespace erbs
