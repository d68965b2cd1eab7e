#include "engine/analysis/prepare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "engine/analysis/load_warnings.h"
#include "engine/analysis/resting.h"
#include "engine/base/random.h"
#include "engine/base/units.h"
#include "engine/contact/overlap/shape.h"
#include "engine/joints/kinematics.h"
#include "engine/model/build/add_joints.h"
#include "engine/model/columns.h"
#include "engine/solve/blocks/islands.h"
#include "engine/solve/step.h"

namespace erbs::analysis {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Time-step bound for blocks that meet only in contact: the block on the contact spring of one face, sqrt(2 m / K) as for joints. A factor
// 4 on K covers rocking: 1 + 3 for a thin brick on its face.
double debris_bound(const Model& m, int b) {
  if (m.kind[z(b)] != Kind::moving) return std::numeric_limits<double>::infinity();
  const double volume = m.mass[z(b)] / m.materials[z(m.material[z(b)])].density;
  const double k = m.materials[z(m.material[z(b)])].kn * volume / m.smallest_edge[z(b)];
  return std::sqrt(2 * m.mass[z(b)] / (4 * k));
}
double debris_bound(const Model& m) {
  double bound = std::numeric_limits<double>::infinity();
  for (int b = 0; b < m.nblock; ++b) bound = std::min(bound, debris_bound(m, b));
  return bound;
}

bool any_moves(const Model& m) { return std::find(m.kind.begin(), m.kind.end(), Kind::moving) != m.kind.end(); }

std::string said(const char* rule, double dt, double fraction) { return fmt::format("{} ({:.4g} s x {:.3g})", rule, dt, fraction); }

// Largest stable time step. In zig-zag modes the neighbours of a block move against it and double omega^2. The literal sequential sweep
// holds neighbours fixed, so its limit is 2 / omega of the stiffest block alone: sqrt(2) times the block bound.
double stability_limit(const Analysis& a, const StepBounds& b) {
  return a.solver == "sequential" && a.variant == "literal" ? std::max(b.critical, std::sqrt(2.0) * b.block) : b.critical;
}

void choose_dt(const Scene& scene, Prepared& p, bool allow_unstable) {
  const Analysis& a = scene.analysis;
  const StepBounds& b = p.bounds;
  double limit = b.critical;
  const bool jointed = std::isfinite(limit);
  double dt = 0;
  if (a.dt > 0) {
    dt = a.dt;
    p.dt_rule = "given by the scene";
  } else if (!any_moves(p.model)) {
    dt = std::min(a.output_dt, a.duration) / 10;
    p.dt_rule = "a tenth of output_dt: all blocks are driven or fixed";
  } else if (!jointed) {
    limit = debris_bound(p.model);
    dt = a.dt_fraction * limit;
    p.dt_rule = said("bound of debris contacts", limit, a.dt_fraction);
  } else if (a.dt_rule == "period_tenth") {
    dt = b.element_period / 10;
    p.dt_rule = said("T_min / 10, Gu and Miao eq. (3)", b.element_period, 0.1);
  } else if (a.dt_rule == "hart") {
    dt = a.dt_fraction * b.element_period / pi;
    p.dt_rule = said("2 / max omega_i, Hart et al. 1988, eq. (4)", b.element_period / pi, a.dt_fraction);
  } else if (a.dt_rule == "hakuno" || a.dt_rule == "hakuno_half") {
    const double part = a.dt_rule == "hakuno" ? 1 : 0.5;
    dt = part * b.wave_passage;
    p.dt_rule = said("D_min / v_p, Hakuno and Meguro 1993, eq. (5)", b.wave_passage, part);
  } else {
    dt = a.dt_fraction * limit;
    p.dt_rule = said("2 / omega_max of the joined structure", limit, a.dt_fraction);
    const double share = std::max(0.9, a.dt_fraction);
    constexpr double near = 0.95;  // fraction of the cracked limit; small dashpots of cracked mortar leave the step unchanged
    if (b.cracked < b.critical && dt <= b.critical && dt > std::max(share, near) * b.cracked) {
      dt = share * b.cracked;
      p.dt_rule = said("2 / omega_max once joints have cracked, stiffer in bending than their points or damped", b.cracked, share);
    }
  }
  if ((!(dt > 0) || !std::isfinite(dt)) &&
      std::none_of(p.model.kind.begin(), p.model.kind.end(), [](Kind kind) { return kind == Kind::moving; }))
    throw Error("every block is fixed, so that nothing moves; leave fixed = true out of those that shall", a.place);
  if (!(dt > 0) || !std::isfinite(dt))
    throw Error(
        fmt::format("no time step can be derived by dt_rule = \"{}\"; say analysis{{ dt = 1e-4 }}, or dt_rule = \"limit\"", a.dt_rule),
        a.place);
  if (a.solver == "sequential" && a.iterations > 1) {
    dt /= a.iterations;
    p.dt_rule += fmt::format(", in {} sweeps", a.iterations);
  }
  if (dt > a.duration && !scene.push.quasi_static())
    throw Error(
        fmt::format("analysis: the time step {:.4g} s ({}) is longer than the duration {:g} s: nothing would be computed; say a longer "
                    "duration or a shorter dt",
                    dt, p.dt_rule, a.duration),
        a.place);
  const double allowed = stability_limit(a, b);
  if (jointed && dt > allowed && !a.unstable && !allow_unstable)
    throw Error(
        fmt::format("analysis: dt = {:.4g} s is {:.3f} times the limit {} = {:.4g} s of this structure{}; take at most {:.3g} s, or let it "
                    "diverge with dt = {{ {:.4g}, unstable = true }} or --allow-unstable",
                    dt, dt / allowed, allowed == b.critical ? "2 / omega_max" : "2 / omega_block of the sequential sweep", allowed,
                    b.stiffest_block < 0 ? "" : fmt::format(", set by the joints of block \"{}\"", p.model.block_name[z(b.stiffest_block)]),
                    0.9 * allowed, dt),
        a.place);
  if (jointed && dt <= b.critical && dt > b.cracked)
    p.warnings.push_back(fmt::format(
        "dt = {:.4g} s is below the limit {:.4g} s of the intact structure but above {:.4g} s, the limit after joints have cracked "
        "(cracked joints are stiffer in bending than their points, or damped); take at most {:.3g} s",
        dt, b.critical, b.cracked, 0.9 * b.cracked));
  p.state.time.dt = p.range.longest = dt;
  // A step derived from joints may grow once they are gone, as far as contacts allow (`ContactBound`), at most to that of a block on one
  // whole face: `debris_bound` counts the face four times.
  if (a.dt == 0 && jointed && a.solver != "sequential" && a.dt_rule == Analysis{}.dt_rule)
    p.range.longest = std::max(dt, 2 * a.dt_fraction * debris_bound(p.model));
}

// Enforces the scene's own limit of use: a run beyond it is refused with the scene's reason.
void hold_use_limit(const Scene& scene, const Prepared& p) {
  const UseLimit& use = scene.use_limit;
  if (use.reason.empty()) return;  // the scene states none
  const double limit = std::isfinite(p.bounds.critical) ? p.bounds.critical : debris_bound(p.model);
  if (p.state.time.dt > (1 + 1e-9) * use.dt_fraction * limit)
    throw Error(fmt::format("use_limit: dt = {:.4g} s is {:.3f} of the limit {:.4g} s, and this scene is good up to {:g} of it ({}); say "
                            "analysis{{ dt_fraction "
                            "= {:g} }}",
                            p.state.time.dt, p.state.time.dt / limit, limit, use.dt_fraction, use.reason, use.dt_fraction),
                use.place);
  for (int j = 0; j < p.model.njoint; ++j)
    if (p.model.joint[z(j)].type->points < use.points)
      throw Error(
          fmt::format("use_limit: joint {} has {} contact points, and this scene is good from {} on ({}); ask for more in its joint rule",
                      p.model.joint_name(j), p.model.joint[z(j)].type->points, use.points, use.reason),
          use.place);
}

bool starts_loaded(const Model& m) { return m.gravity.norm() > 0 || !m.force_loads.empty(); }

// Refuses initial poses that the equilibrium of joined blocks would undo.
void refuse_lost_poses(const Scene& scene, const Prepared& p) {
  const Model& m = p.model;
  if (scene.analysis.start == "rest" || !starts_loaded(m)) return;
  for (int b = 0; b < m.nblock; ++b) {
    const Block& block = scene.blocks[z(b)];
    const Initial& initial = block.initial();
    const bool placed = !initial.position.isZero(0) || !initial.rotation.isZero(0);
    if (!placed || m.kind[z(b)] != Kind::moving || !p.state.topology.grounded[z(b)]) continue;
    throw Error(fmt::format("block \"{}\" starts beside its place (initial position or rotation), and start = \"{}\" would move it back to "
                            "where its joints bear it; say analysis{{ start = \"rest\" }}",
                            block.name, scene.analysis.start),
                block.place);
  }
}

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

// Refuses parts that exceed the limits of contact shapes. The check is here, not at the start of a run, so that `check` refuses the same
// scenes as `run`.
void check_shapes(const Scene& scene, const Model& m) {
  const auto large = [](const Polyhedron& part) { return part.vertices.size() > most_vertices / 2 || part.faces.size() > most_faces / 2; };
  const bool any =
      std::any_of(m.parts.begin(), m.parts.end(), [&](const Parts& parts) { return std::any_of(parts.begin(), parts.end(), large); });
  if (!any || !scene.analysis.debris) return;
  std::vector<std::string> errors;
  each_contact_part(m, [&](int b, const Polyhedron& part) {
    if (!large(part)) return;
    const Block& block = scene.blocks[z(b)];
    try {
      contact_shape(part);
    } catch (const Error& error) { errors.push_back(fmt::format("{}: block '{}': {}", block.place.text(), block.name, error.what())); }
  });
  if (!errors.empty()) throw Errors(errors);
}

}  // namespace

Prepared prepare(const Scene& scene, bool allow_unstable) {
  Built built = build(scene);
  Prepared p{std::move(built.model), std::move(built.state), {}, {}, {}, {}, 0, {}, std::move(built.warnings), std::move(built.notes)};
  if (scene.push.quasi_static()) p.model.analysis.levels = 1;
  check_shapes(scene, p.model);
  find_islands(p.model, p.state);
  refuse_lost_poses(scene, p);
  if (!scene.push.quasi_static())
    for (std::string& warning : warnings_of_loads(scene, p.model)) p.warnings.push_back(std::move(warning));
  update_all_references(p.model, p.state);
  p.bounds = step_bounds(p.model, p.state);
  p.range.critical = p.bounds.cracked;
  std::vector<double> bounds = p.bounds.of_block;
  for (int b = 0; b < p.model.nblock; ++b)
    if (!std::isfinite(bounds[z(b)])) bounds[z(b)] = debris_bound(p.model, b);
  p.model.settles = settlements(p.model, bounds);
  set_hops(p.model, p.state);
  choose_dt(scene, p, allow_unstable);
  if (!allow_unstable) hold_use_limit(scene, p);
  return p;
}

namespace {

constexpr double ramp_seconds = 0.2, ramp_limit = 25;  // s, default duration of the ramp; ramps until a moving block counts as falling
// Limit of rest: kinetic energy of a block over the work of its weight along the structure's height. A block under 1.001 times its friction
// slides at 5e-4 m/s against the ramp's damping of 100 1/s. A structure of 1 m is at rest below 4e-4 m/s. A slower block falls by less than
// a tenth of a millimetre during a shock.
constexpr double rest_energy = 1e-8;

// Blocks that still move, and blocks that fall: lower than at the start by half their thinnest extent, the criterion of `Collapse`.
class Unrest {
 public:
  Unrest(const Model& m, const State& s) : model_(m), state_(s), start_(s.pose.u), down_(m.gravity.normalized()) {
    double low = 1e300, high = -1e300;
    for (int b = 0; b < m.nblock; ++b) {
      if (m.kind[z(b)] != Kind::moving) continue;
      const double at = down_.dot(m.rest[z(b)]), edge = m.smallest_edge[z(b)];
      low = std::min(low, at - edge / 2), high = std::max(high, at + edge / 2);
    }
    const double g = m.gravity.norm() > 0 ? m.gravity.norm() : standard_g;  // for loads without gravity, its usual value
    square_ = 2 * rest_energy * g * std::max(0.0, high - low);
  }
  bool falls(int b) const { return down_.dot(state_.pose.u[z(b)] - start_[z(b)]) > 0.5 * model_.thickness[z(b)]; }
  bool moves(int b) const {
    const double rotation_energy = state_.motion.w[z(b)].dot(state_.motion.spin_momentum[z(b)]) / model_.mass[z(b)];
    return state_.motion.v[z(b)].squaredNorm() + rotation_energy > square_;
  }
  // True if every block that does not fall is at rest.
  bool ended() const {
    for (int b = 0; b < model_.nblock; ++b)
      if (model_.kind[z(b)] == Kind::moving && moves(b) && !falls(b)) return false;
    return true;
  }

 private:
  const Model& model_;
  const State& state_;
  const BlockVec3 start_;
  const Vec3 down_;
  double square_ = 0;  // m2/s2, square of the speed below which a block is at rest
};

// State that the ramp must not change: blocks already in equilibrium, and joints among such blocks and fixed ones only.
struct Held {
  std::vector<std::uint8_t> block;  // [nblock], empty for none
  State state;

  void give_back(const Model& m, State& s) const {
    const auto holds = [&](int b) { return block[z(b)] || m.kind[z(b)] != Kind::moving; };
    for (int b = 0; b < m.nblock; ++b)
      if (block[z(b)]) s.pose.u[z(b)] = state.pose.u[z(b)], s.pose.q[z(b)] = state.pose.q[z(b)];
    for (int j = 0; j < m.njoint; ++j) {
      const Joint& joint = m.joint[z(j)];
      if (!holds(joint.a) || !holds(joint.b)) continue;
      s.joints.memory[z(j)] = state.joints.memory[z(j)];
      for (int i = joint.first_point; i < joint.first_point + joint.type->points; ++i) s.joints.history[z(i)] = state.joints.history[z(i)];
      if (!s.joints.crushed.empty()) s.joints.crushed[z(j)] = state.joints.crushed[z(j)];
    }
  }
};

// Ramps gravity and constant loads, then holds them until every block that does not fall is at rest. The blocks are damped at about the
// critical value of the lowest mode, which Rayleigh's quotient of the sagging structure gives. The ramp acts as a downward ground
// acceleration that decreases from g to zero. Blocks of `held` stay in place.
void ramp(const Scene& scene, Prepared& p, const std::vector<std::uint8_t>& found, int threads) {
  Model slow = p.model;
  const double time = scene.analysis.ramp_time > 0 ? scene.analysis.ramp_time : ramp_seconds;
  slow.grounds = {{make_table({0, time}, {1, 0}, true), p.model.gravity}};
  slow.tilts.clear();
  slow.prescribed_motions.clear();
  for (auto& force_load : slow.force_loads) force_load.wave = make_table({0, time}, {0, value(force_load.wave, 0)}, true);
  slow.damping.mass = 20 / time;
  slow.damping_all = false;
  slow.damping_explicit = false;
  slow.analysis.levels = 1;
  const BlockVec3 v = p.state.motion.v, L = p.state.motion.spin_momentum;
  const double dt = p.state.time.dt;
  p.state.motion.v.assign(v.size(), Vec3::Zero());
  p.state.motion.spin_momentum.assign(v.size(), Vec3::Zero());
  std::optional<Held> held;
  if (!found.empty()) {
    held.emplace(Held{found, p.state});
    for (int b = 0; b < slow.nblock; ++b)
      if (found[z(b)]) slow.kind[z(b)] = Kind::fixed;
  }
  find_islands(slow, p.state);
  const Unrest unrest(slow, p.state);
  Solver solver(slow, p.state, p.range, threads);
  solver.advance_until([&] { return p.state.time.t >= time && (unrest.ended() || p.state.time.t >= ramp_limit * time); });
  for (int b = 0; b < slow.nblock; ++b)
    if (slow.kind[z(b)] == Kind::moving && (unrest.moves(b) || unrest.falls(b))) p.fallers.push_back(b);
  if (held) held->give_back(p.model, p.state);
  p.state.motion.v = v;
  p.state.motion.spin_momentum = L;
  p.state.motion.w.assign(p.state.motion.w.size(), Vec3::Zero());
  find_islands(p.model, p.state);
  const double target = p.state.time.dt_target;
  p.state.time = TimeStep{};
  p.state.time.dt = dt;
  p.state.time.dt_target = target;
  p.state.energy = Energy{};
}

// Blocks to hold during the ramp of the others: those in equilibrium, and those that no joint connects to the ground.
std::vector<std::uint8_t> kept_still(const Prepared& p) {
  std::vector<std::uint8_t> still = p.equilibrium.found;
  for (int b = 0; b < p.model.nblock; ++b) still[z(b)] = still[z(b)] || !p.state.topology.grounded[z(b)];
  return still;
}

void warn_of_fallers(Prepared& p) {
  if (!p.fallers.empty()) p.warnings.push_back("not at rest under its own weight: " + names_of(p.model, p.fallers));
}

}  // namespace

Metrics::Equilibrium equilibrium_metrics(const Prepared& p) {
  return {p.equilibrium.iterations, p.equilibrium.given_up, p.equilibrium.unbalanced, p.equilibrium_wall};
}

void start_at_rest(const Scene& scene, Prepared& p, int threads) {
  const auto began = std::chrono::steady_clock::now();
  if (scene.analysis.start == "equilibrium" && starts_loaded(p.model) && p.model.njoint > 0) {
    if (const std::string warning = warning_of_resting(p.model, p.state); !warning.empty()) p.warnings.push_back(warning);
    for (int iteration = 0; iteration < 3; ++iteration) {  // arms of the loads rotate with their blocks
      p.equilibrium = settle(p.model, p.state, constant_loads(p.model, p.state));
      if (p.model.force_loads.empty()) break;
    }
    if (!p.equilibrium.converged) {
      p.warnings.push_back("no equilibrium under gravity: " + p.equilibrium.why + "; there gravity is applied as a damped ramp instead");
      ramp(scene, p, kept_still(p), threads);
    }
  } else if (scene.analysis.start == "ramp" && p.model.njoint > 0) {
    ramp(scene, p, {}, threads);
  }
  p.equilibrium_wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  warn_of_fallers(p);
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
