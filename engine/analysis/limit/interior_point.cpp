#include "engine/analysis/limit/interior_point.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/limit/contact_matrix.h"

namespace erbs::analysis {
namespace {

constexpr int most_iterations = 100;
constexpr double kept_gap = 50;  // gap of the iterate kept for a warm start, over the tolerance

}  // namespace

struct InteriorPoint::Matrix : ContactMatrix {
  using ContactMatrix::ContactMatrix;
};

// A point of the method, with its residuals. The last cone bounds lambda: most - lambda >= 0.
struct InteriorPoint::Iterate {
  std::vector<Vec3> f;  // forces
  double lambda = 0;
  VecX y;  // velocities
  std::vector<ConeValue> s, z;
  double s_most = 1, z_most = 1;
  // residuals
  std::vector<Vec3> r_f;
  std::vector<ConeValue> r_s;
  VecX r_p;
  double r_lambda = 0, r_most = 0;
  double gap = 0, statical = 0, kinematic = 0;  // gap: s' z
};

struct InteriorPoint::Steps {
  std::vector<Vec3> f;
  double lambda = 0;
  VecX y;
  std::vector<ConeValue> s, z;
  double s_most = 0, z_most = 0;
};

InteriorPoint::InteriorPoint(const LimitProblem& problem) : problem_(problem), matrix_(std::make_unique<Matrix>(problem)) {}
InteriorPoint::~InteriorPoint() = default;

void InteriorPoint::set_cones(const std::vector<Strength>& strength) {
  cone_.assign(strength.size(), {});
  degree_ = 1;
  for (std::size_t i = 0; i < strength.size(); ++i) {
    const Strength& one = strength[i];
    ContactCone& cone = cone_[i];
    cone.rubs = one.slope > 0 || one.cohesion > 0;
    const auto add = [&](const Vec3& row, double constant) {
      cone.g[cone.lines] = row;
      cone.h[cone.lines++] = constant;
    };
    // The friction cone alone keeps n above its apex.
    const bool cut = !cone.rubs || one.tension < one.cohesion / std::max(one.slope, 1e-300) * (1 - 1e-9);
    if (cut) add(Vec3::UnitX(), one.tension);
    if (cone.rubs && problem_.columns == 2) add(Vec3(one.slope, 1, 0), one.cohesion), add(Vec3(one.slope, -1, 0), one.cohesion);
    if (cone.rubs && problem_.columns == 3) cone.round = true, cone.slope = one.slope, cone.head = one.cohesion;
    degree_ += cone.degree();
  }
}

void InteriorPoint::residuals(Iterate& at) const {
  at.r_p = constant_ + at.lambda * push_;
  at.r_lambda = push_.dot(at.y) + at.z_most - 1;
  at.r_most = at.s_most + at.lambda - most_;
  at.gap = at.s_most * at.z_most;
  double constants = at.z_most * most_;
  for (std::size_t i = 0; i < cone_.size(); ++i) {
    const ContactPoint& c = problem_.contacts[i];
    add_force(problem_, c, at.f[i], at.r_p);
    at.r_f[i] = relative_velocity(problem_, c, at.y) - cone_[i].transposed(at.z[i]);
    if (!cone_[i].rubs) at.r_f[i].y() = at.r_f[i].z() = 0;
    const ConeValue slack = cone_[i].slack(at.f[i], true);
    for (int k = 0; k < 3; ++k) at.r_s[i].line[k] = at.s[i].line[k] - slack.line[k];
    at.r_s[i].round = at.s[i].round - slack.round;
    at.gap += cone_[i].dot(at.s[i], at.z[i]);
    constants += cone_[i].constant_part(at.z[i]);
  }
  at.statical = at.lambda;
  at.kinematic = constants - constant_.dot(at.y);
}

bool InteriorPoint::factorize() {
  matrix_->clear();
  flexibility_.resize(cone_.size());
  for (std::size_t i = 0; i < cone_.size(); ++i) {
    flexibility_[i] = cone_[i].flexibility();
    if (!flexibility_[i].allFinite()) return false;
    matrix_->add(problem_.contacts[i], flexibility_[i]);
  }
  if (!matrix_->factorize()) return false;
  along_push_ = matrix_->solve(push_);
  return along_push_.allFinite();
}

// Solves the linear equations of a step towards complementarity `target`, with the second-order terms of a predictor if there is one.
void InteriorPoint::newton(const Iterate& at, double target, const Steps* predictor, Steps& out) const {
  const std::size_t n = cone_.size();
  const double w2 = at.s_most / at.z_most;
  std::vector<ConeValue> q(n);
  std::vector<Vec3> t(n);
  VecX right = at.r_p;
  for (std::size_t i = 0; i < n; ++i) {
    const ContactCone& cone = cone_[i];
    const ConeValue none;
    if (target >= 0)
      q[i] = cone.complementarity(target, predictor ? cone.unscale(predictor->s[i]) : none, predictor ? cone.scale(predictor->z[i]) : none);
    const ConeValue unscaled = cone.unscale(q[i]), twice = cone.unscale(cone.unscale(at.r_s[i]));
    t[i] = cone.transposed(unscaled) + cone.transposed(twice) - at.r_f[i];
    add_force(problem_, problem_.contacts[i], flexibility_[i] * t[i], right);
  }
  const double second = predictor ? predictor->s_most * predictor->z_most : 0;
  const double q_most = target >= 0 ? (target - second - at.s_most * at.z_most) / at.s_most : 0;  // w^-1 q
  const double t_lambda = -at.r_lambda - q_most - at.r_most / w2;
  const VecX base = matrix_->solve(right);
  out.lambda = (t_lambda - push_.dot(base)) / (push_.dot(along_push_) + 1 / w2);
  out.y = base + out.lambda * along_push_;
  out.s_most = -out.lambda - at.r_most;
  out.z_most = q_most - out.s_most / w2;
  out.f.resize(n), out.s.resize(n), out.z.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const ContactCone& cone = cone_[i];
    out.f[i] = flexibility_[i] * (t[i] - relative_velocity(problem_, problem_.contacts[i], out.y));
    out.s[i] = cone.slack(out.f[i], false);
    for (int k = 0; k < 3; ++k) out.s[i].line[k] -= at.r_s[i].line[k];
    out.s[i].round -= at.r_s[i].round;
    const ConeValue unscaled = cone.unscale(q[i]), twice = cone.unscale(cone.unscale(out.s[i]));
    for (int k = 0; k < 3; ++k) out.z[i].line[k] = unscaled.line[k] - twice.line[k];
    out.z[i].round = unscaled.round - twice.round;
  }
}

// The least-squares solutions of both problems, shifted into the cones.
bool InteriorPoint::start(Iterate& at) {
  const std::size_t n = cone_.size();
  at.f.assign(n, Vec3::Zero()), at.s.assign(n, {}), at.z.assign(n, {});
  at.r_f.assign(n, Vec3::Zero()), at.r_s.assign(n, {});
  at.y = VecX::Zero(push_.size());
  at.lambda = at.s_most = at.z_most = 0;
  for (ContactCone& cone : cone_) cone.set_unit_scaling();
  residuals(at);
  at.s_most = at.z_most = 1;  // their ratio is the scaling
  if (!factorize()) return false;
  Steps first;
  newton(at, -1, nullptr, first);
  at.f = first.f, at.lambda = first.lambda, at.y = first.y, at.s = first.s, at.z = first.z;
  at.s_most = first.s_most, at.z_most = first.z_most;
  double s_out = -at.s_most, z_out = -at.z_most;
  for (std::size_t i = 0; i < n; ++i)
    s_out = std::max(s_out, cone_[i].outside(at.s[i])), z_out = std::max(z_out, cone_[i].outside(at.z[i]));
  const double s_shift = s_out > -1e-3 ? 1 + s_out : 0, z_shift = z_out > -1e-3 ? 1 + z_out : 0;
  for (std::size_t i = 0; i < n; ++i) cone_[i].shift(at.s[i], s_shift), cone_[i].shift(at.z[i], z_shift);
  at.s_most += s_shift, at.z_most += z_shift;
  return true;
}

// The kept iterate, with the slack of the new strengths where that lies well inside its cones.
bool InteriorPoint::start_warm(Iterate& at) {
  if (!kept_ || kept_->f.size() != cone_.size()) return false;
  at = *kept_;
  const double centre = at.gap / degree_;
  for (std::size_t i = 0; i < cone_.size(); ++i) {
    at.s[i] = cone_[i].slack(at.f[i], true);
    const double s_short = cone_[i].outside(at.s[i]) + std::sqrt(centre) * 0.1;
    if (s_short > 0) cone_[i].shift(at.s[i], s_short);
    const double z_short = cone_[i].outside(at.z[i]) + std::sqrt(centre) * 0.1;
    if (z_short > 0) cone_[i].shift(at.z[i], z_short);
  }
  return true;
}

// The longest steps along `way` that stay in the cones of slack and of multipliers, at most 1, shortened by `share`.
std::pair<double, double> InteriorPoint::longest(const Iterate& at, const Steps& way, double share) const {
  double s = way.s_most < 0 ? -at.s_most / way.s_most : 1e3, z = way.z_most < 0 ? -at.z_most / way.z_most : 1e3;
  for (std::size_t i = 0; i < cone_.size(); ++i) {
    s = cone_[i].longest_step(at.s[i], way.s[i], s);
    z = cone_[i].longest_step(at.z[i], way.z[i], z);
  }
  return {std::min(1.0, share * s), std::min(1.0, share * z)};
}

// s' z after steps of these lengths.
double InteriorPoint::coming_gap(const Iterate& at, const Steps& way, double s_step, double z_step) const {
  double sum = (at.s_most + s_step * way.s_most) * (at.z_most + z_step * way.z_most);
  for (std::size_t i = 0; i < cone_.size(); ++i) {
    const ContactCone& c = cone_[i];
    sum += c.dot(at.s[i], at.z[i]) + s_step * c.dot(way.s[i], at.z[i]) + z_step * c.dot(at.s[i], way.z[i]) +
           s_step * z_step * c.dot(way.s[i], way.z[i]);
  }
  return sum;
}

// One iteration; false where it gets no further.
bool InteriorPoint::advance(Iterate& at) {
  for (std::size_t i = 0; i < cone_.size(); ++i) cone_[i].set_scaling(at.s[i], at.z[i]);
  if (!factorize()) return false;
  Steps predictor, step;
  newton(at, 0, nullptr, predictor);
  const auto [s_most, z_most] = longest(at, predictor, 1);
  const double share = std::clamp(coming_gap(at, predictor, s_most, z_most) / at.gap, 1e-6, 1.0);
  newton(at, share * share * share * at.gap / degree_, &predictor, step);
  const auto [s_step, z_step] = longest(at, step, 0.98);
  for (std::size_t i = 0; i < cone_.size(); ++i) {
    at.f[i] += s_step * step.f[i];
    for (int k = 0; k < 3; ++k) at.s[i].line[k] += s_step * step.s[i].line[k], at.z[i].line[k] += z_step * step.z[i].line[k];
    at.s[i].round += s_step * step.s[i].round, at.z[i].round += z_step * step.z[i].round;
  }
  at.lambda += s_step * step.lambda, at.s_most += s_step * step.s_most;
  at.y += z_step * step.y, at.z_most += z_step * step.z_most;
  return std::max(s_step, z_step) > 1e-7;
}

LimitSolution InteriorPoint::solve(const VecX& constant, const VecX& push, const std::vector<Strength>& strength, double most,
                                   double tolerance, bool warm) {
  constant_ = constant, push_ = push, most_ = most;
  set_cones(strength);
  Iterate at;
  LimitSolution out;
  if (!(warm && start_warm(at)) && !start(at)) return out;
  kept_.reset();
  double best = 1e300;
  for (; out.iterations < most_iterations; ++out.iterations) {
    residuals(at);
    const double primal = at.r_p.lpNorm<Eigen::Infinity>();
    double dual = std::fabs(at.r_lambda);
    for (const Vec3& r : at.r_f) dual = std::max(dual, r.lpNorm<Eigen::Infinity>() / (1 + at.y.lpNorm<Eigen::Infinity>()));
    if (!std::isfinite(primal + dual + at.gap)) break;
    const double difference = std::max(at.gap, std::fabs(at.kinematic - at.statical)) / (1 + std::fabs(at.statical));
    if (!kept_ && difference < kept_gap * tolerance) kept_ = std::make_unique<Iterate>(at);
    const double wrong = std::max({primal, dual, difference});
    if (wrong > 10 * best && best < 100 * tolerance) break;  // round-off has taken over
    if (wrong < best) {
      best = wrong;
      out.out_of_balance = primal, out.statical = at.statical, out.kinematic = at.kinematic, out.force = at.f, out.rates = at.y;
    }
    out.converged = best < tolerance;
    if (out.converged || !advance(at)) break;
  }
  return out;
}

}  // namespace erbs::analysis
