#include "engine/record/performance/performance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

// Rounds of halved steps, and of these and bisection.
constexpr int most_halved = 100, most_rounds = 200;
constexpr double same_displacement = 1e-6;  // relative, of two rounds

struct MassNode {
  double mass = 0, height = 0, moment = 0;  // kg; m; kg m: mass times displacement
};

// Blocks gathered into levels of equal height, or each by itself.
std::vector<MassNode> nodes_of(const std::vector<ShapeBlock>& blocks, const PerformanceDemand& demand) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  const std::set<std::string> named(demand.blocks.begin(), demand.blocks.end());
  const auto counts = [&](const ShapeBlock& b) {
    return (demand.group.empty() || b.group == demand.group) && (named.empty() || named.contains(b.name));
  };
  for (const ShapeBlock& b : blocks)
    if (counts(b)) low = std::min(low, b.height), high = std::max(high, b.height);
  std::map<int, MassNode> levels;
  int number = 0;
  for (const ShapeBlock& b : blocks) {
    if (!counts(b)) continue;
    const int level = demand.nodes == 0 ? number++
                      : high > low      ? std::min(demand.nodes - 1, int(demand.nodes * (b.height - low) / (high - low)))
                                        : 0;
    MassNode& node = levels[level];
    node.mass += b.mass, node.height += b.mass * b.height;
    node.moment += b.mass * (demand.shape == "elastic" ? b.elastic : b.peak);
  }
  std::vector<MassNode> nodes;
  for (auto& [level, node] : levels) node.height /= node.mass, nodes.push_back(node);
  return nodes;
}

// Value at `x` of a curve with growing X, between its points; x within it.
double value_at(const std::vector<double>& X, const std::vector<double>& Y, double x) {
  const std::size_t i = std::size_t(std::upper_bound(X.begin() + 1, X.end() - 1, x) - X.begin());
  return Y[i - 1] + (x - X[i - 1]) / (X[i] - X[i - 1]) * (Y[i] - Y[i - 1]);
}

// A push by displacement may leap over what a structure does as it weakens (`MachinePath::leaps`): no line across is a state.
void refuse_leap(const std::vector<double>& X, double x, const char* what) {
  const std::size_t i = std::size_t(std::upper_bound(X.begin() + 1, X.end() - 1, x) - X.begin());
  if (i > 1 && X[i] - X[i - 1] > x)
    throw Error(fmt::format("its {} of {:.3g} mm lies between states at {:.3g} and {:.3g} mm, far from either; push with shorter steps",
                            what, 1e3 * x, 1e3 * X[i - 1], 1e3 * X[i]));
}

// Draws bilinear curves until the target is the end of the curve, where that is asked for. Halved steps are tried first: a peak between
// both would make whole ones jump to and fro. They do so themselves where the target falls steeply; then bisection finds the end between
// two that lie on either side. There is one: the target, kept within the curve, is a continuous function of the end.
void draw_bilinear(PerformancePoint& p, const std::vector<double>& D, double end, const PerformanceDemand& demand) {
  double low = D[1], high = D.back();  // the target is beyond the end; before it
  for (p.rounds = 1;; ++p.rounds) {
    p.bilinear = bilinear_curve(D, p.A, end);
    p.oscillator = target_displacement(p.bilinear, demand.spectrum);
    const double next = std::clamp(p.oscillator.target, D[1], D.back());
    if (!demand.iterate || std::fabs(next - end) <= same_displacement * end) return;
    if (p.rounds == most_rounds)
      throw Error(fmt::format("the target jumps from one side of the curve's end to the other at {:.4g} mm; leave iterate out", 1e3 * end));
    (next > end ? low : high) = end;
    if (p.rounds == most_halved && low >= high) low = D[1], high = D.back();
    end = 0.5 * (p.rounds < most_halved ? end + next : low + high);
  }
}

// `mass`: of the oscillator; `divisor`: V_b over its acceleration (both kg).
PerformancePoint point_of(const BaseShearCurve& curve, const std::vector<double>& D, const Participation& nodes, double mass,
                          double divisor, const PerformanceDemand& demand) {
  PerformancePoint p;
  p.mass = mass;
  for (const double shear : curve.shear) p.A.push_back(shear / divisor);
  draw_bilinear(p, D, D[std::size_t(curve.peak)], demand);
  refuse_leap(curve.displacement, nodes.gamma * p.bilinear.yield_displacement, "yield displacement");  // it decides the period
  p.displacement = nodes.gamma * p.oscillator.target;
  p.top = nodes.phi_top * p.displacement;
  p.within_curve = p.oscillator.target <= D.back() * (1 + 1e-9);
  if (!p.within_curve) return p;
  const double u = std::min(p.displacement, curve.displacement.back());
  p.multiplier = value_at(curve.displacement, curve.multiplier, u);
  p.shear = value_at(curve.displacement, curve.shear, u);
  refuse_leap(curve.displacement, u, "target");
  p.time = value_at(curve.displacement, curve.time, u);
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < curve.displacement.size(); ++i)
    if (std::fabs(curve.displacement[i] - u) < std::fabs(curve.displacement[nearest] - u)) nearest = i;
  p.nearest = curve.displacement[nearest], p.nearest_time = curve.time[nearest];
  return p;
}

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const PerformancePoint& p, bool there) {
  const TargetDisplacement& o = p.oscillator;
  const auto number = [&](double value) { return there ? Json(value) : Json(); };
  return {{"verdict", !there           ? ""
                      : p.within_curve ? "within the curve"
                                       : "the demand exceeds the capacity"},
          {"within_curve", there ? Json(p.within_curve) : Json()},
          {"mass_kg", number(p.mass)},
          {"yield_force_N", number(p.mass * p.bilinear.yield_acceleration)},
          {"yield_acceleration_m_s2", number(p.bilinear.yield_acceleration)},
          {"yield_displacement_m", number(p.bilinear.yield_displacement)},
          {"end_displacement_m", number(p.bilinear.end)},
          {"energy_J_kg", number(p.bilinear.energy)},
          {"period_s", number(o.period)},
          {"demand_m_s2", number(o.demand)},
          {"q", number(o.q)},
          {"elastic_target_m", number(o.elastic)},
          {"target_m", number(o.target)},
          {"ductility", number(o.ductility)},
          {"rounds", there ? Json(p.rounds) : Json()},
          {"displacement_m", number(p.displacement)},
          {"top_displacement_m", number(p.top)},
          {"multiplier", optional(p.multiplier)},
          {"base_shear_N", optional(p.shear)},
          {"time_s", optional(p.time)},
          {"nearest_displacement_m", optional(p.nearest)},
          {"nearest_time_s", optional(p.nearest_time)}};
}

}  // namespace

Participation participation(const PushShape& shape, const PerformanceDemand& demand) {
  Participation out;
  for (const ShapeBlock& b : shape.blocks) out.mass += b.mass;
  const std::vector<MassNode> nodes = nodes_of(shape.blocks, demand);
  const double monitored = demand.shape == "elastic" ? shape.elastic : shape.peak;
  if (nodes.empty() && demand.group.empty()) throw Error("spectrum: none of its blocks moves; name others, or leave blocks out");
  if (nodes.empty()) throw Error(fmt::format("group \"{}\" has no blocks that move; name another, or leave group out", demand.group));
  if (!(std::fabs(monitored) > 0))
    throw Error("the monitored point does not move in this state, so that there is no shape; monitor another point of the structure");
  double all = 0, first = 0, second = 0;  // Sum m, Sum m phi, Sum m phi^2
  const MassNode* top = &nodes.front();
  for (const MassNode& node : nodes) {
    const double phi = node.moment / node.mass / monitored;
    all += node.mass, first += node.mass * phi, second += node.mass * phi * phi;
    if (node.height > top->height) top = &node;
  }
  if (!(first > 0))
    throw Error("the mass nodes do not move the way of the monitored point, so that there is no shape; choose another group or monitor");
  const double share = out.mass / all;
  out.nodes = int(nodes.size());
  out.gamma = first / second;
  out.phi_top = top->moment / top->mass / monitored;
  out.mass_star = share * first;
  out.effective_mass = share * first * first / second;
  return out;
}

double BilinearCurve::period() const { return 2 * pi * std::sqrt(yield_displacement / yield_acceleration); }

BilinearCurve bilinear_curve(const std::vector<double>& D, const std::vector<double>& A, double end) {
  BilinearCurve b;
  b.end = end;
  for (std::size_t i = 1; i < D.size() && D[i - 1] < end; ++i) {
    const double to = std::min(D[i], end), at = value_at(D, A, to);
    b.energy += 0.5 * (A[i - 1] + at) * (to - D[i - 1]);
    b.yield_acceleration = std::max({b.yield_acceleration, A[i - 1], at});
  }
  if (!(b.yield_acceleration > 0)) throw Error("the curve carries no load, so that there is nothing to compare with a spectrum");
  b.yield_displacement = std::min(end, 2 * (end - b.energy / b.yield_acceleration));  // EN 1998-1:2004 (B.6)
  return b;
}

TargetDisplacement target_displacement(const BilinearCurve& curve, const DesignSpectrum& spectrum) {
  TargetDisplacement t;
  t.period = curve.period();  // (B.7)
  if (t.period > last_period(spectrum))
    throw Error(fmt::format("the period T* = {:.4g} s lies beyond the last row of the spectrum, {:g} s; add rows to its table", t.period,
                            last_period(spectrum)));
  t.demand = spectral_acceleration(spectrum, t.period);
  t.elastic = spectral_displacement(spectrum, t.period);  // (B.8)
  t.q = t.demand / curve.yield_acceleration;
  t.target = t.elastic;
  const double corner = corner_periods(spectrum).end;
  if (t.period < corner && t.q > 1)  // (B.10), (B.11); at most three times the elastic one
    t.target = std::clamp(t.elastic / t.q * (1 + (t.q - 1) * corner / t.period), t.elastic, 3 * t.elastic);
  t.ductility = t.target / curve.yield_displacement;
  return t;
}

Performance performance_of(const BaseShearCurve& curve, const PushShape& shape, const PerformanceDemand& demand) {
  Performance out;
  out.spectrum = spectrum_name(demand.spectrum), out.shape = demand.shape;
  if (curve.peak == 0) throw Error("the curve has no state that is displaced and carries load along the push");
  out.nodes = participation(shape, demand);
  for (const double u : curve.displacement) out.D.push_back(u / out.nodes.gamma);
  const Participation& n = out.nodes;
  out.mpp = point_of(curve, out.D, n, n.mass, n.mass, demand);
  out.n2 = point_of(curve, out.D, n, n.mass_star, n.effective_mass, demand);
  return out;
}

Json to_json(const Performance& p) {
  const bool there = p.trouble.empty();
  const auto number = [&](double value) { return there ? Json(value) : Json(); };
  return {{"spectrum", p.spectrum},
          {"trouble", p.trouble},
          {"shape", p.shape},
          {"nodes", there ? Json(p.nodes.nodes) : Json()},
          {"gamma", number(p.nodes.gamma)},
          {"phi_top", number(p.nodes.phi_top)},
          {"gamma_phi_top", number(p.nodes.gamma * p.nodes.phi_top)},
          {"mass_kg", number(p.nodes.mass)},
          {"mass_star_kg", number(p.nodes.mass_star)},
          {"mpp", to_json(p.mpp, there)},
          {"n2", to_json(p.n2, there)}};
}

std::string performance_text(const Json& p) {
  std::string text = "performance point for " + p.value("spectrum", "");
  if (const std::string trouble = p.value("trouble", ""); !trouble.empty()) return text + ": none: " + trouble;
  const int nodes = p.value("nodes", 0);
  text += fmt::format("; Gamma {:.4g}, phi_top {:.4g} from the {} shape of {}", p["gamma"].get<double>(), p["phi_top"].get<double>(),
                      p.value("shape", ""), nodes == 1 ? "one mass node" : fmt::format("{} mass nodes", nodes));
  for (const auto& [key, name] : {std::pair{"n2", "N2 (EN 1998-1 annex B)"}, {"mpp", "mass-proportional pushover"}}) {
    const Json& v = p[key];
    const auto number = [&](const char* what) { return v[what].get<double>(); };
    text += fmt::format(
        "\n  {}: {}; monitored point at {:.4g} mm (top {:.4g} mm, oscillator {:.4g} mm; T* {:.3g} s, q {:.3g}, yields at {:.3g} g and "
        "{:.3g} mm)",
        name, v.value("verdict", ""), 1e3 * number("displacement_m"), 1e3 * number("top_displacement_m"), 1e3 * number("target_m"),
        number("period_s"), number("q"), number("yield_acceleration_m_s2") / standard_g, 1e3 * number("yield_displacement_m"));
    if (v["time_s"].is_number())
      text += fmt::format("\n    there: multiplier {:.4g}, t = {:.4g} s of the run folder; nearest state {:.4g} mm at t = {:.4g} s",
                          number("multiplier"), number("time_s"), 1e3 * number("nearest_displacement_m"), number("nearest_time_s"));
  }
  return text;
}

}  // namespace erbs
