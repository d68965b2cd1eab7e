#include "engine/analysis/start/at_rest.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>

#include "engine/analysis/start/resting.h"
#include "engine/base/count.h"
#include "engine/base/random.h"
#include "engine/joints/kinematics.h"

namespace erbs::analysis {
namespace {

std::vector<double> constant_loads(const Model& m, const State& s) {
  std::vector<double> loads(6 * z(m.nblock) + 6, 0.0);
  for (const auto& p : m.force_loads) {
    const Vec3 f = value(p.wave, 0) * p.direction;
    for (int i = 0; i < 3; ++i) loads[6 * z(p.block) + z(p.moment ? 3 + i : i)] += f[i];
    const Vec3 moment = p.moment ? Vec3(Vec3::Zero()) : Vec3((s.pose.q[z(p.block)] * p.arm).cross(f));
    for (int i = 0; i < 3; ++i) loads[6 * z(p.block) + 3 + z(i)] += moment[i];
  }
  return loads;
}

// Warns of what does not stand where it was built.
void take_note(const Unsteady& of, Prepared& p) {
  p.fallers = of.falls;
  if (!of.falls.empty())
    p.warnings.push_back(fmt::format("not at rest under {}: {}", weight_at_start(p.model), names_of(p.model, of.falls)));
  std::vector<int> rests;
  std::ranges::set_difference(of.moved, of.falls, std::back_inserter(rests));
  if (!rests.empty())
    p.warnings.push_back(fmt::format("slides or leans under {} until it rests: {}", weight_at_start(p.model), names_of(p.model, rests)));
}

// Islands without equilibrium, and what loose blocks prop, load or tie to them: all of it as it was built at first. The others stay still:
// those in equilibrium, and those that no joint connects to the ground. What has got its weight here does not count as resting any more.
void ramp_the_rest(const Scene& scene, Prepared& p, Resting& resting, const std::optional<State>& built, int threads,
                   const StartTold& told) {
  std::vector<std::uint8_t> still = p.equilibrium.found;
  const std::vector<std::uint8_t> tied = resting.tied_to_unfound(p.equilibrium.found);
  std::vector<int> loose;
  for (int b = 0; b < p.model.nblock; ++b) {
    const bool grounded = p.state.topology.grounded[z(b)] != 0;
    still[z(b)] = (still[z(b)] != 0 || !grounded) && tied[z(b)] == 0;
    if (tied[z(b)] != 0 && !grounded) loose.push_back(b);
  }
  if (built) Held{tied, *built}.give_back(p.model, p.state);
  take_note(ramp_gravity(scene, p, still, threads, !loose.empty(), told), p);
  resting.drop(loose);
}

// Lowers what lies on the structure onto it. What slides or topples off does so in the run, and a structure that gives way under it falls
// there: their weight comes at once.
void lower_onto_structure(const Scene& scene, Prepared& p, Resting resting, int threads, const StartTold& told) {
  constexpr int most_rounds = 4;
  resting.carry(p.model, p.state);
  const State before = p.state;
  const std::vector<int> all = resting.blocks();
  for (int round = 1; resting.any(); ++round) {
    const std::vector<int> left = lower_blocks(scene, p, resting, threads, told);
    if (left.empty()) break;
    p.state = before;
    resting.drop(round < most_rounds ? left : resting.blocks());
  }
  std::vector<int> sudden;
  std::ranges::set_difference(all, resting.blocks(), std::back_inserter(sudden));
  if (resting.any()) p.notes.push_back("at rest on the structure without a joint: " + names_of(p.model, resting.blocks()));
  if (!sudden.empty())
    p.warnings.push_back(
        "what lies on the structure without a joint does not come to rest on it and starts as it is built, its weight at once: " +
        names_of(p.model, sudden));
}

}  // namespace

std::string weight_at_start(const Model& m) {
  const auto acts = [](const auto& load) { return value(load.wave, 0) != 0; };
  const bool loaded = std::ranges::any_of(m.force_loads, acts) || std::ranges::any_of(m.tilts, acts);
  return loaded ? "its own weight and the loads that act from the start" : "its own weight";
}

Metrics::Equilibrium equilibrium_metrics(const Prepared& p) {
  return {p.equilibrium.iterations, p.equilibrium.given_up, p.equilibrium.unbalanced, p.equilibrium_wall};
}

void start_at_rest(const Scene& scene, Prepared& p, int threads, const StartTold& told) {
  const auto began = std::chrono::steady_clock::now();
  const Vec3 upright = p.model.gravity;  // a table may be tilted from the start
  for (const auto& tilt : p.model.tilts) p.model.gravity = rotation(value(tilt.wave, 0) * tilt.axis) * p.model.gravity;
  if (scene.analysis.start == "equilibrium" && starts_loaded(p.model) && p.model.njoint > 0) {
    Resting resting(p.model, p.state);
    std::optional<State> built;
    if (resting.touches_structure()) built = p.state;
    for (int iteration = 0; iteration < 3; ++iteration) {  // arms of the loads rotate with their blocks
      p.equilibrium = settle(p.model, p.state, constant_loads(p.model, p.state));
      if (p.model.force_loads.empty()) break;
    }
    if (!p.equilibrium.converged) {
      p.warnings.push_back("no equilibrium under gravity: " + p.equilibrium.why + "; there gravity is applied as a damped ramp instead");
      ramp_the_rest(scene, p, resting, built, threads, told);
    }
    if (resting.any()) lower_onto_structure(scene, p, resting, threads, told);
  } else if (scene.analysis.start == "ramp" && p.model.njoint > 0) {
    take_note(ramp_gravity(scene, p, {}, threads, false, told), p);
  }
  p.model.gravity = upright;
  p.equilibrium_wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  update_all_references(p.model, p.state);
  return_free_memory();
}

double falling_share(const Prepared& p) {
  double all = 0, falls = 0;
  for (int b = 0; b < p.model.nblock; ++b)
    if (p.model.kind[z(b)] == Kind::moving) all += p.model.mass[z(b)];
  for (const int b : p.fallers) falls += p.model.mass[z(b)];
  return all > 0 ? falls / all : 0;
}

void add_noise(Prepared& run, double reach, unsigned seed) {
  if (reach == 0) return;
  Random random{seed};
  for (int b = 0; b < run.model.nblock; ++b) {
    if (run.model.kind[z(b)] != Kind::moving) continue;
    Vec3 shift, theta;
    for (int i = 0; i < 3; ++i) shift[i] = random.within(reach);
    for (int i = 0; i < 3; ++i) theta[i] = random.within(reach);
    run.state.pose.u[z(b)] += shift;
    run.state.pose.q[z(b)] = rotation(theta) * run.state.pose.q[z(b)];
  }
  update_all_references(run.model, run.state);
}

}  // namespace erbs::analysis
