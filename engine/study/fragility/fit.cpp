#include "engine/study/fragility/fit.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs::study {
namespace {

constexpr double confidence = 1.959963984540054;  // standard normal quantile of 97.5 %

double density(double x) { return std::isfinite(x) ? std::exp(-0.5 * x * x) / std::sqrt(2 * pi) : 0; }

// Phi(u) - Phi(v), u > v, without cancellation in the upper tail or over a short interval.
double between(double u, double v) {
  if (u - v < 1e-5) return density(0.5 * (u + v)) * (u - v);
  if (v > 0) return normal_cdf(-v) - normal_cdf(-u);
  return normal_cdf(u) - normal_cdf(v);
}

struct Likelihood {
  double value = 0, ga = 0, gb = 0, haa = 0, hab = 0, hbb = 0;  // with its gradient and second derivatives
};

// An infinite end has no share in the derivatives.
Likelihood likelihood(const std::vector<Interval>& data, double a, double b) {
  Likelihood out;
  for (const Interval& one : data) {
    const double x = std::log(one.hi), y = std::log(one.lo);
    const double u = std::isfinite(x) ? a + b * x : infinite, v = std::isfinite(y) ? a + b * y : -infinite;
    const double share = between(u, v);
    if (!(share > 0)) return {-infinite};
    out.value += std::log(share);
    const auto add = [&](double at, double g, double h) {
      out.ga += g, out.gb += at * g, out.haa += h, out.hab += at * h, out.hbb += at * at * h;
    };
    const double p = density(u) / share, q = density(v) / share;
    if (std::isfinite(u)) add(x, p, -u * p - p * p);
    if (std::isfinite(v)) add(y, -q, v * q - q * q);
    if (std::isfinite(u) && std::isfinite(v)) out.haa += 2 * p * q, out.hab += (x + y) * p * q, out.hbb += 2 * x * y * p * q;
  }
  return out;
}

// What the observations say before any number is sought.
FitEnd limit_case(const std::vector<Interval>& data, Fit& fit) {
  double least_hi = infinite, most_lo = 0;
  for (const Interval& one : data) least_hi = std::min(least_hi, one.hi), most_lo = std::max(most_lo, one.lo);
  fit.theta_lo = most_lo, fit.theta_hi = least_hi;
  if (data.empty()) return FitEnd::empty;
  if (fit.collapsed == 0) return FitEnd::none;
  if (most_lo == 0) return FitEnd::all;
  if (most_lo == least_hi) return FitEnd::level;
  return most_lo < least_hi ? FitEnd::separated : FitEnd::fitted;
}

// Newton's method with halved steps, from a fair guess.
void maximise(const std::vector<Interval>& data, double& a, double& b) {
  double low = infinite, high = -infinite;
  for (const Interval& one : data)
    for (const double end : {one.lo, one.hi})
      if (end > 0 && std::isfinite(end)) low = std::min(low, std::log(end)), high = std::max(high, std::log(end));
  b = 1 / std::max(0.3, 0.3 * (high - low));
  a = -b * 0.5 * (low + high);
  Likelihood now = likelihood(data, a, b);
  for (int i = 0; i < 200; ++i) {
    const double det = now.haa * now.hbb - now.hab * now.hab;
    if (!(det > 0)) return;
    const double da = -(now.hbb * now.ga - now.hab * now.gb) / det, db = -(now.haa * now.gb - now.hab * now.ga) / det;
    const double gain = now.ga * da + now.gb * db;
    double step = 1;
    Likelihood next = likelihood(data, a + da, b + db);
    while (!(next.value >= now.value + 0.1 * step * gain) && step > 1e-10)
      step *= 0.5, next = likelihood(data, a + step * da, b + step * db);
    if (gain < 1e-13 || step <= 1e-10) return;
    a += step * da, b += step * db, now = next;
  }
}

}  // namespace

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

double Fit::probability(double im) const { return im > 0 ? normal_cdf(a + b * std::log(im)) : 0; }

double Fit::band(double im, double sign) const {
  if (!(im > 0)) return 0;
  const double x = std::log(im);
  return normal_cdf(a + b * x + sign * confidence * std::sqrt(std::max(0.0, var_a + 2 * x * cov + x * x * var_b)));
}

Fit fit_fragility(const std::vector<Interval>& observations) {
  Fit fit;
  fit.observations = int(observations.size());
  for (const Interval& one : observations) fit.collapsed += std::isfinite(one.hi) ? 1 : 0;
  fit.end = limit_case(observations, fit);
  if (fit.end != FitEnd::fitted) return fit;
  maximise(observations, fit.a, fit.b);
  const Likelihood best = likelihood(observations, fit.a, fit.b);
  const double det = best.haa * best.hbb - best.hab * best.hab;
  if (!(fit.b > 1e-6) || !(det > 0)) {
    fit.end = FitEnd::falling;
    return fit;
  }
  fit.log_likelihood = best.value;
  fit.var_a = -best.hbb / det, fit.var_b = -best.haa / det, fit.cov = best.hab / det;
  fit.beta = 1 / fit.b, fit.theta = std::exp(-fit.a / fit.b);
  const double of_beta = confidence * std::sqrt(fit.var_b) / fit.b;
  // ln(theta) = -a / b, by its first derivatives.
  const double ra = -1 / fit.b, rb = fit.a / (fit.b * fit.b);
  const double of_theta = confidence * std::sqrt(std::max(0.0, ra * ra * fit.var_a + 2 * ra * rb * fit.cov + rb * rb * fit.var_b));
  fit.theta_lo = fit.theta * std::exp(-of_theta), fit.theta_hi = fit.theta * std::exp(of_theta);
  fit.beta_lo = fit.beta * std::exp(-of_beta), fit.beta_hi = fit.beta * std::exp(of_beta);
  return fit;
}

std::string words(const Fit& fit, const std::string& unit, double factor) {
  const auto im = [&](double x) { return fmt::format("{:.4g}{}{}", factor * x, unit.empty() ? "" : " ", unit); };
  switch (fit.end) {
    case FitEnd::fitted:
      return "";
    case FitEnd::empty:
      return "no run counts";
    case FitEnd::none:
      return fmt::format("none of {} collapses up to {}: the median lies above; raise the intensities", fit.observations, im(fit.theta_lo));
    case FitEnd::all:
      return fmt::format("all of {} collapse, from {} on: the median lies below; lower the intensities", fit.observations,
                         im(fit.theta_hi));
    case FitEnd::separated:
      return fmt::format(
          "all stand up to {} and all collapse from {} on: the median lies between, the dispersion is too small to be seen; take "
          "intensities between, or more cases",
          im(fit.theta_lo), im(fit.theta_hi));
    case FitEnd::level:
      return fmt::format("collapses and standing runs meet at {} alone, which says no dispersion; take more intensities", im(fit.theta_hi));
    case FitEnd::falling:
      return "collapses do not grow with the intensity; take more cases or a wider range of intensities";
  }
  return "";
}

}  // namespace erbs::study
