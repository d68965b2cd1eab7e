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
  if (residual > gate || margin > 1 || sinking) watch.warned += s.step - watch.looked;
  watch.looked = s.step;
}

Metrics::Trust trust_of(const TrustWatch& watch, const Model& model, const State& s) {
  Metrics::Trust trust;
  trust.energy_residual = watch.residual;
  trust.energy_residual_time = watch.residual_time;
  if (watch.residual_joint >= 0) trust.energy_residual_where = model.joint_name(watch.residual_joint);
  trust.penetration = s.max_penetration_relative;
  trust.dt_margin = watch.dt_margin;
  trust.warned_share = s.step > 0 ? double(watch.warned) / double(s.step) : 0;
  trust.momentum_residual = s.momentum_residual;
  return trust;
}

std::string trust_line(const Metrics::Trust& t) {
  std::string line = fmt::format("trust: energy residual at most {:.1e}", t.energy_residual);
  if (t.energy_residual > 0)
    line +=
        fmt::format(" at {:.4g} s{}", t.energy_residual_time, t.energy_residual_where.empty() ? "" : " (" + t.energy_residual_where + ")");
  line += fmt::format(", penetration {:.1e}, dt at most {:.2f} of its limit, {:.2g} % of the steps with a warning, momentum {:.0e}",
                      t.penetration, t.dt_margin, 100 * t.warned_share, t.momentum_residual);
  if (t.twin) line += t.chaos_horizon ? fmt::format(", chaos horizon {:.3g} s", *t.chaos_horizon) : ", no chaos within the run";
  return line;
}

}  // namespace erbs
