#include "engine/analysis/quasi_static/limit_beside.h"

#include <algorithm>

#include "engine/analysis/limit/limit.h"
#include "engine/analysis/limit/outcome.h"
#include "engine/base/count.h"
#include "engine/base/error.h"

namespace erbs::analysis {
namespace {

// Contact points up to which it takes seconds. Walls of 410 and 1,820 blocks in space (10,539 and 47,844 points) take .6 and 7 s; what
// slides much takes more rounds: a room of 639 blocks (7,256 points without bond) 28 s.
constexpr std::size_t quick = 12000;

// Capacity over the limit of rigid blocks below which more than the toes of soft beds is amiss.
constexpr double far_below = 0.95;

LimitBracket bracket_of(const LimitResult& r, const Model& model) {
  LimitBracket out;
  out.stands = r.stands;
  if (r.stands && !r.unbounded) {
    out.converged = r.has_nonassociated && r.nonassociated.converged;
    out.lower = r.last().lower, out.upper = r.last().upper;
    out.associated_lower = r.associated.lower, out.associated_upper = r.associated.upper;
  }
  out.unbounded = r.unbounded;
  out.mechanism = limit_mechanism(r, model).kind;
  return out;
}

// These blocks are fixed where they were built, and no joint leads to them.
Model without(Model m, const std::vector<std::uint8_t>& blocks) {
  for (int b = 0; b < m.nblock; ++b)
    if (blocks[z(b)] != 0) m.kind[z(b)] = Kind::fixed;
  std::erase_if(m.joint, [&](const Joint& j) { return blocks[z(j.a)] != 0 || blocks[z(j.b)] != 0; });
  m.njoint = int(m.joint.size());
  return m;
}

}  // namespace

std::optional<LimitBeside> limit_beside(const Scene& scene, const Model& whole, std::optional<double> borne,
                                        const std::vector<std::uint8_t>& fell, std::string& why) {
  if (scene.push.limit == "never") return std::nullopt;
  const Model model = without(whole, fell);
  try {
    const LimitLoad load = limit_load(scene, model);
    const LimitProblem problem = limit_problem(model, load, {});
    if (scene.push.limit == "auto" && problem.contacts.size() > quick) return std::nullopt;
    LimitBeside out;
    LimitOptions options;
    options.no_tension = true;
    const LimitResult dry = limit_analysis(model, load, options);
    out.dry = bracket_of(dry, model);
    if (borne > 0 && (dry.unbounded || borne < far_below * out.dry.lower)) out.dry.smooth = smooth_multiplier(model, load, options, dry);
    const bool bond = std::any_of(problem.contacts.begin(), problem.contacts.end(),
                                  [](const ContactPoint& c) { return c.tension > 0 || c.cohesion > 0; });
    options.no_tension = false;
    if (bond) out.bonded = bracket_of(limit_analysis(model, load, options), model);
    return out;
  } catch (const std::runtime_error& mistake) {  // the push stands without it
    why = mistake.what();
    return std::nullopt;
  }
}

}  // namespace erbs::analysis
