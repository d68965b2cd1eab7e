#include "engine/analysis/start/prepare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/analysis/start/load_warnings.h"
#include "engine/analysis/start/resting.h"
#include "engine/base/count.h"
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

// s, the longest step that follows the loads. A step takes their mean over its length, so that one as long as a period sees another load.
double step_of_loads(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  if (!scene.push.quasi_static())
    for (const Load& load : scene.loads) least = std::min(least, following_step(load.wave));
  return least * std::min(1.0, scene.analysis.dt_fraction / Analysis{}.dt_fraction);  // a smaller fraction asks for a smaller step
}

// Refuses a step with which nothing, or nonsense, would be computed.
void check_dt(const Scene& scene, Prepared& p, double dt, bool allow_unstable) {
  const Analysis& a = scene.analysis;
  const StepBounds& b = p.bounds;
  const bool jointed = std::isfinite(b.critical);
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
  constexpr double finest = 1.0 / 64;  // of the structure's step: it hardly feels a load that is faster still
  const bool by_limit = a.dt == 0 && a.dt_rule == Analysis{}.dt_rule;
  const double by_loads = by_limit ? std::max(step_of_loads(scene), finest * dt) : std::numeric_limits<double>::infinity();
  if (by_loads < dt) {
    dt = by_loads;
    p.dt_rule = "a twentieth of the shortest period of the loads, or an interval of the points that give one";
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
  check_dt(scene, p, dt, allow_unstable);
  p.state.time.dt = p.range.longest = dt;
  // A step derived from joints may grow once they are gone, as far as contacts allow (`ContactBound`), at most to that of a block on one
  // whole face: `debris_bound` counts the face four times.
  if (a.dt == 0 && jointed && a.solver != "sequential" && a.dt_rule == Analysis{}.dt_rule)
    p.range.longest = std::max(dt, std::min(by_loads, 2 * a.dt_fraction * debris_bound(p.model)));
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

// motion.h5 keeps poses as floats, whose steps grow with the distance from the origin. The run itself does not depend on it.
void warn_of_far_blocks(const Scene& scene, std::vector<std::string>& warnings) {
  double worst = 0.01, far = 0;
  const Block* which = nullptr;
  for (const Block& block : scene.blocks) {
    Eigen::AlignedBox3d box;
    for (const Polyhedron& part : block.parts)
      for (const Vec3& v : part.vertices) box.extend(v);
    if (block.fixed || box.isEmpty()) continue;
    const double away = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    const double share = std::numeric_limits<float>::epsilon() * away / box.sizes().minCoeff();
    if (share > worst) worst = share, far = away, which = &block;
  }
  if (which != nullptr)
    warnings.push_back(fmt::format(
        "block '{}' lies {:.3g} m from the origin, where the poses that pictures and exports are made of have steps of up to {:.2g} mm; "
        "build the scene nearer to the origin",
        which->name, far, 1e3 * std::numeric_limits<float>::epsilon() * far));
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
  Prepared p{std::move(built.model), std::move(built.state), {}, {}, {}, {}, 0, {}, {}, std::move(built.warnings), std::move(built.notes)};
  if (scene.push.quasi_static()) p.model.analysis.levels = 1;
  check_shapes(scene, p.model);
  find_islands(p.model, p.state);
  refuse_lost_poses(scene, p);
  warn_of_far_blocks(scene, p.warnings);
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

}  // namespace erbs::analysis
