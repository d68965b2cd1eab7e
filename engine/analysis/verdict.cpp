#include "engine/analysis/verdict.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace erbs::analysis {
namespace {

constexpr long wrong_steps = 512;        // allowed duration of a ledger that misses half of the energy passed
constexpr long negative_steps = 160000;  // allowed duration of negative kinetic energy, typical of modes at the stability limit
// Kinetic energy over all other energy below which it is round-off: a block at rest trembles by the last bits of its place, about 1e-32.
constexpr double round_off = 1e-20;
constexpr double given_share = 0.1;  // of all energy in motion, that losses may give

// J, that has come in from outside.
double passed(const Energy& e) { return e.absolute_work + 0.5 * e.height_flux + std::fabs(e.start); }

// Friction, cracks, crushing and dampers only take energy. Past the limit of the step they may give some, over which the ledger closes.
bool losses_give(const Energy& e) {
  double given = 0;  // J
  for (const double loss : {e.friction, e.fracture, e.crushing, e.damping, e.contact_damping}) given += std::max(0.0, -loss);
  return given > given_share * std::max(e.reference, passed(e));
}

// True if the ledger cannot be that of a motion.
bool impossible(const RunSoFar& r, bool lost) {
  const Energy& e = r.run.state.energy;
  // Beyond its stability limit, explicit damping feeds the motion while the ledger closes. Velocities then change sign in every step, so
  // that T = v- m v+ / 2 is negative.
  const double noise = round_off * (passed(e) + std::fabs(e.elastic) + std::fabs(e.gravity));
  return lost || e.kinetic < -noise;
}

// True if less than half of the energy is accounted for, or losses have given some.
bool energy_lost(const RunSoFar& r) {
  const Energy& e = r.run.state.energy;
  return e.residual_relative > std::max(0.5, r.scene.analysis.energy_tolerance) || losses_give(e);
}

bool exploded(const Energy& e) { return std::fabs(e.kinetic) > 1e3 * passed(e); }

// Rounded down to one digit.
std::string step_of(double wanted) {
  const double x = std::min(0.9, wanted), digit = std::pow(10, std::floor(std::log10(x)));
  return fmt::format("--dt-fraction {:.1g}", digit * std::floor(x / digit + 1e-9));
}

std::string where(const RunSoFar& r) {
  const int j = r.run.state.energy.largest_jump_joint;
  return j >= 0 ? "in joint " + r.run.model.joint_name(j) : "in no single joint";
}

}  // namespace

double energy_tolerance(const RunSoFar& r) {
  if (r.scene.analysis.energy_tolerance > 0) return r.scene.analysis.energy_tolerance;
  const State& s = r.run.state;
  if (r.collapse.fallen_fraction > 0 || r.collapse.collapsed || r.released > 0 || s.observed.max_penetration_relative > 0) return 1e-2;
  const bool elastic = s.contacts.list.pair.empty() &&
                       std::all_of(s.joints.stage.begin(), s.joints.stage.end(), [](JointStage t) { return t == JointStage::intact; });
  return elastic ? 1e-6 : 1e-3;
}

bool growth_allowed(const Scene& scene) { return scene.analysis.solver == "sequential" && scene.analysis.unstable; }

bool diverges(const RunSoFar& r, long& right) {
  const State& s = r.run.state;
  const Energy& e = s.energy;
  if (!std::isfinite(e.residual)) return true;
  // The ledger of the sequential scheme does not close. Even so, kinetic energy cannot exceed the energy supplied plus the potential energy
  // of all heights, if there are any.
  if (growth_allowed(r.scene)) return r.height_energy > 0 && e.kinetic > 2 * (passed(e) + r.height_energy);
  const bool lost = energy_lost(r), wrong = impossible(r, lost);
  if (!wrong) right = s.time.step;
  // If only a few light blocks exceed their limit, their joints crack and stop the growth. The duration of the error then ends the run.
  return wrong && ((exploded(e) && s.time.step > 64) || s.time.step - right > (lost ? wrong_steps : negative_steps));
}

bool diverged_at_end(const RunSoFar& r) {
  const Energy& e = r.run.state.energy;
  return !growth_allowed(r.scene) && (losses_give(e) || (exploded(e) && impossible(r, energy_lost(r))));
}

std::string trouble_of(const RunSoFar& r, const std::string& status) {
  const Energy& e = r.run.state.energy;
  const Model& model = r.run.model;
  const double tolerance = energy_tolerance(r), fraction = r.dt_at_start / r.run.bounds.critical;
  const double share = std::isfinite(fraction) && fraction > 0 ? fraction : 1;
  if (status == "diverged") {
    const double now = r.run.state.time.dt;
    const std::string changed = std::fabs(now / r.dt_at_start - 1) < 1e-6 ? "" : fmt::format(" at the start and {:.4g} s there", now);
    return fmt::format("the run diverged at t = {:.6g} s (dt = {:.4g} s{}, limit {:.4g} s); results after that time are invalid; take {}",
                       r.run.state.time.t, r.dt_at_start, changed, r.run.bounds.critical, step_of(share > 1 ? 0.9 : share / 3));
  }
  if (e.residual_worst > tolerance && !growth_allowed(r.scene)) {
    // The residual of smooth motion falls with the square of the step. Fluttering friction and chattering joints need dashpots instead.
    const double smooth = 0.8 * std::sqrt(tolerance / e.residual_worst);
    const bool undamped = std::any_of(model.laws.begin(), model.laws.end(), [](const PointLaw& l) { return l.damping < 0.1; });
    return fmt::format(
        "the energy residual {:.3g}, relative to the energy that passed through, exceeds its tolerance {:.0e}; its largest jump was {:.3g} "
        "J at "
        "t = {:.6g} s, {}; take {}{}{}",
        e.residual_worst, tolerance, e.largest_jump, e.largest_jump_time, where(r), step_of(share * std::clamp(smooth, 0.1, 0.5)),
        undamped && model.njoint > 0 ? " or damping = 0.1 in the law of its joints" : "",
        e.residual_worst < 0.05
            ? fmt::format(", or set analysis{{ energy_gate = {:.1g} }} if that is accurate enough", 2 * e.residual_worst)
            : "");
  }
  const bool asked = r.scene.analysis.unstable || r.allow_unstable;
  if (asked || !stepped_too_far(r.diagnostics, r.run.state)) return "";
  return fmt::format(
      "the time step exceeded the limit of the touching blocks in {:.2g} % of the steps, by a factor of {:.3g} at most; take {}",
      100 * double(r.diagnostics.past_step.count[0]) / double(r.run.state.time.step), r.diagnostics.past_step.worst,
      step_of(0.9 * share / r.diagnostics.past_step.worst));
}

std::string ledger_line(const RunSoFar& r) {
  const Energy& e = r.run.state.energy;
  return fmt::format("energy residual {:.3g} (tolerance {:.0e}), largest jump {:.3g} J at t = {:.6g} s, {}", e.residual_worst,
                     energy_tolerance(r), e.largest_jump, e.largest_jump_time, where(r));
}

}  // namespace erbs::analysis
