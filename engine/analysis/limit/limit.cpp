#include "engine/analysis/limit/limit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "engine/analysis/limit/facets.h"
#include "engine/analysis/limit/interior_point.h"
#include "engine/base/count.h"

namespace erbs::analysis {
namespace {

// Contact points up to which a plane problem is solved by the simplex method, whose mechanism is a single one.
constexpr std::size_t simplex_points = 1500;
constexpr double gap = 1e-5;  // of the two multipliers, relative
// Of the non-associated iteration: dilatant share of mu, gap of a round, change of the multiplier at which it has settled, share of all
// shear above the friction limit that is tolerated.
constexpr double dilatant = 0.01, round_gap = 2e-5, settled = 1e-4, bearable = 0.02;
constexpr int most_rounds = 60, most_tilts = 30;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The limits of the associated problem.
std::vector<Strength> strengths_of(const LimitProblem& p) {
  std::vector<Strength> out;
  for (const ContactPoint& c : p.contacts) out.push_back({c.tension, c.cohesion, c.mu});
  return out;
}

// Whether the two multipliers of a solution bound each other.
bool is_bracket(const LimitSolution& s) {
  return !s.force.empty() && (s.converged || std::fabs(s.kinematic - s.statical) <= 1e-3 * (1 + std::fabs(s.statical)));
}

bool upright(const Model& m, const ContactPoint& c) {
  constexpr double tilted = 0.5;  // sine
  return std::fabs(m.joint[z(c.joint)].type->frame.col(2).dot(m.gravity)) < tilted * m.gravity.norm();
}

class Analysis {
 public:
  Analysis(const Model& model, const LimitLoad& load, const LimitOptions& options, double factor) : model_(model), options_(options) {
    result_.problem = limit_problem(model, load, {options.no_tension, factor});
    for (ContactPoint& c : result_.problem.contacts)
      if (options.smooth_uprights && upright(model, c)) c.mu = 0;
    using Solver = LimitOptions::Solver;
    simplex_ = options.facets > 0 || options.solver == Solver::simplex ||
               (options.solver == Solver::automatic && p().plane && p().contacts.size() <= simplex_points);
    result_.method = !simplex_ ? "interior point, round cones" : p().plane ? "linear program, plane" : "linear programs, cones with facets";
    if (!simplex_) interior_ = std::make_unique<InteriorPoint>(p());
  }

  // `standing`: it is known to stand.
  LimitResult run(bool standing) {
    const auto start = std::chrono::steady_clock::now();
    if (standing) result_.stands = true, result_.standing_share = 1;
    if (standing || stand()) {
      associated();
      if (!result_.unbounded && !options_.associated_only) nonassociated();
    }
    result_.seconds = seconds_since(start);
    return std::move(result_);
  }

 private:
  const LimitProblem& p() const { return result_.problem; }

  LimitSolution solved(const VecX& constant, const VecX& push, const std::vector<Strength>& strength, double most, bool circumscribed) {
    LimitSolution out = simplex_ ? FacetedProblem(p(), constant, push, strength, facets(), circumscribed, bonded(), most).solve(strength)
                                 : interior_->solve(constant, push, strength, most, gap);
    if (!is_bracket(out))
      throw NumbersError(
          fmt::format("limit analysis found no solution: after {} iterations the multiplier lies between {:g} and {:g}, out "
                      "of balance by {:.2g} weights; try --facets 8",
                      out.iterations, out.statical, out.kinematic, out.out_of_balance));
    return out;
  }
  bool bonded() const {
    return std::any_of(p().contacts.begin(), p().contacts.end(), [](const ContactPoint& c) { return c.cohesion > 0; });
  }
  int facets() const { return options_.facets > 0 ? options_.facets : 2; }

  bool stand() {
    const double size = p().constant.lpNorm<Eigen::Infinity>();
    if (size == 0) return result_.stands = true, result_.standing_share = 1, true;
    const LimitSolution found = solved(VecX::Zero(p().constant.size()), p().constant, strengths_of(p()), 1, false);
    result_.standing_share = std::clamp(found.statical, 0.0, 1.0);
    result_.stands = found.statical > 1 - 10 * gap;
    if (!result_.stands) keep(found);
    return result_.stands;
  }

  void associated() {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Strength> strength = strengths_of(p());
    // The interior point method begins in the middle of its cones: a bound near the multiplier saves it iterations.
    for (double most = simplex_ ? options_.most : std::min(10.0, options_.most);; most = std::min(100 * most, options_.most)) {
      last_ = solved(p().constant, p().push, strength, most, false);
      if (last_.statical < 0.5 * most || most >= options_.most) break;
    }
    Multiplier& out = result_.associated;
    out = {last_.statical, last_.kinematic, last_.converged, last_.iterations, 0};
    if (simplex_ && !p().plane) {
      const LimitSolution above = solved(p().constant, p().push, strength, options_.most, true);
      out.upper = above.kinematic, out.iterations += above.iterations;
    }
    out.seconds = seconds_since(start);
    result_.unbounded = out.lower > options_.most * (1 - 1e-6);
    keep(last_);
  }

  // Gilbert, Casapulla and Ahmed replace Coulomb's cone by |s| <= (1 - a) mu N + a mu n, with N the normal force of the last round, so that
  // sliding lifts the faces by the small share a of mu; N follows n with a weight. We do this at each contact point instead of each joint,
  // and keep the cohesion of a bond beside it. It ends when two rounds in a row have settled.
  void nonassociated() {
    const auto start = std::chrono::steady_clock::now();
    std::vector<double> normal;
    for (const Vec3& f : last_.force) normal.push_back(f.x());
    std::unique_ptr<FacetedProblem> linear;
    Multiplier& out = result_.nonassociated;
    double weight = 0.5;
    int steady = 0;
    for (result_.rounds = 0; result_.rounds < most_rounds && !(steady >= 2 && excess() < bearable); ++result_.rounds) {
      if (result_.rounds > 0)
        for (std::size_t i = 0; i < normal.size(); ++i) normal[i] += weight * (last_.force[i].x() - normal[i]);
      weight = 0.5 * std::min(1.0, 6.0 / (result_.rounds + 1));  // less and less, against cycles
      const LimitSolution found = round(normal, linear);
      out.iterations += found.iterations;
      if (!is_bracket(found)) break;  // the answer is that of the round before, and has not converged
      const double change = std::fabs(found.statical - last_.statical);
      steady = change < settled * std::max(std::fabs(found.statical), 1e-3) ? steady + 1 : 0;
      last_ = found;
    }
    out.lower = last_.statical, out.upper = last_.kinematic, out.converged = steady >= 2 && excess() < bearable;
    out.seconds = seconds_since(start);
    result_.has_nonassociated = result_.rounds > 0;
    result_.friction_excess = excess();
    keep(last_);
  }

  LimitSolution round(const std::vector<double>& normal, std::unique_ptr<FacetedProblem>& linear) {
    std::vector<Strength> strength;
    for (std::size_t i = 0; i < normal.size(); ++i) {
      const ContactPoint& c = p().contacts[i];
      strength.push_back({c.tension, std::max(0.0, c.cohesion + (1 - dilatant) * c.mu * normal[i]), dilatant * c.mu});
    }
    if (!simplex_) {
      const double most = 2 * std::fabs(result_.associated.upper) + 1;
      LimitSolution out = interior_->solve(p().constant, p().push, strength, most, round_gap, result_.rounds > 0);
      if (result_.rounds > 0 && !is_bracket(out)) out = interior_->solve(p().constant, p().push, strength, most, round_gap);
      return out;
    }
    if (!linear) linear = std::make_unique<FacetedProblem>(p(), p().constant, p().push, strength, facets(), false, true, options_.most);
    return linear->solve(strength);
  }

  // Share of the shear forces of the last solution that lies above cohesion + mu n.
  double excess() const {
    double above = 0, all = 1e-300;
    for (std::size_t i = 0; i < p().contacts.size(); ++i) {
      const ContactPoint& c = p().contacts[i];
      const Vec3& f = last_.force[i];
      const double shear = std::hypot(f.y(), f.z());
      above += std::max(0.0, shear - c.cohesion - c.mu * f.x());
      all += shear;
    }
    return above / all;
  }

  void keep(const LimitSolution& found) {
    result_.force = found.force;
    for (Vec3& f : result_.force) f *= p().force;
    result_.velocity.assign(z(model_.nblock), {});
    double fastest = 0;
    for (int i = 0; i < p().nbody; ++i) {
      const int b = p().block_of[z(i)];
      const Twist v = result_.velocity[z(b)] = velocity_of(p(), found.rates, i);
      fastest = std::max(fastest, v.linear.norm() + v.angular.norm() * 0.5 * model_.smallest_edge[z(b)]);
    }
    for (Twist& v : result_.velocity)
      if (fastest > 0) v.linear /= fastest, v.angular /= fastest;
  }

  const Model& model_;
  const LimitOptions options_;
  LimitResult result_;
  bool simplex_ = false;
  std::unique_ptr<InteriorPoint> interior_;
  LimitSolution last_;
};

// The lambda at which the answer for forces and bonds times sqrt(1 + lambda^2) is lambda: Illinois' variant of regula falsi. The answer is
// a concave function of the factor, as the optimum of a convex program in its right-hand side, so that there is one such lambda at most.
class Tilt {
 public:
  Tilt(const Model& model, const LimitLoad& load, const LimitOptions& options) : model_(model), load_(load), options_(options) {}

  LimitResult run() {
    LimitResult out = Analysis(model_, load_, options_, 1).run(false);
    const bool alone = model_.force_loads.empty() &&
                       std::ranges::all_of(out.problem.contacts, [](const ContactPoint& c) { return c.tension <= 0 && c.cohesion <= 0; });
    if (alone || !out.stands || out.unbounded) return out;
    LimitOptions associated = options_;
    associated.associated_only = true;
    const double seconds = out.seconds;
    const LimitResult above = agreed(out.associated.middle(), associated);
    if (above.unbounded || !out.has_nonassociated) {
      out = above;
    } else {
      out = agreed(out.nonassociated.middle(), options_);
      out.associated = above.associated;
    }
    out.seconds = seconds + seconds_;
    return out;
  }

 private:
  LimitResult at(double lambda, const LimitOptions& options) {
    LimitResult out = Analysis(model_, load_, options, std::hypot(1.0, lambda)).run(true);
    seconds_ += out.seconds;
    return out;
  }

  // `first`: the answer for the factor 1.
  LimitResult agreed(double first, const LimitOptions& options) {
    const double near = options.associated_only ? gap : settled;
    double low = 0, over = first, high = unbounded, under = 0;  // over, under: answer minus lambda, at low and at high
    double lambda = first;
    int side = 0;
    for (int round = 0;; ++round) {
      LimitResult out = at(lambda, options);
      const double off = out.last().middle() - lambda;
      const bool found = std::fabs(off) <= near * (1 + lambda);
      out.unbounded = out.unbounded || (!found && lambda > options.most);
      if (found || out.unbounded) return out;
      if (round == most_tilts) return out.associated.converged = out.nonassociated.converged = false, out;
      double next = over > off ? lambda + off * (lambda - low) / (over - off) : 2 * lambda + 1;  // beyond it, as the answer is concave
      if (off > 0 && side > 0) under *= 0.5;
      if (off <= 0 && side < 0) over *= 0.5;
      if (off > 0) low = lambda, over = off, side = 1;
      else high = lambda, under = off, side = -1;
      if (high < unbounded) next = (high * over - low * under) / (over - under);
      lambda = next;
    }
  }

  const Model& model_;
  const LimitLoad& load_;
  const LimitOptions& options_;
  double seconds_ = 0;
};

}  // namespace

std::optional<double> smooth_multiplier(const Model& model, const LimitLoad& load, const LimitOptions& options, const LimitResult& with) {
  const auto rubs = [&](const ContactPoint& c) { return c.mu > 0 && upright(model, c); };
  if (!with.stands || std::ranges::none_of(with.problem.contacts, rubs)) return std::nullopt;
  LimitOptions smooth = options;
  smooth.smooth_uprights = true;
  try {
    const LimitResult r = limit_analysis(model, load, smooth);
    return r.stands && !r.unbounded ? std::optional(r.last().middle()) : std::nullopt;
  } catch (const NumbersError&) {  // the answer stands without it
    return std::nullopt;
  }
}

LimitResult limit_analysis(const Model& model, const LimitLoad& load, const LimitOptions& options) {
  LimitResult out = load.tilt ? Tilt(model, load, options).run() : Analysis(model, load, options, 1).run(false);
  for (Multiplier* m : {&out.associated, &out.nonassociated})
    if (m->lower > m->upper) std::swap(m->lower, m->upper);  // of rounds that approximate the law, within their gap
  // A solution may stall within round-off of its gap.
  Multiplier& bounds = out.associated;
  bounds.converged = bounds.converged || bounds.upper - bounds.lower <= gap * (1 + bounds.upper);
  return out;
}

}  // namespace erbs::analysis
