// Lognormal fragility by maximum likelihood: the probability that a structure has collapsed at the intensity im is
// Phi(ln(im / theta) / beta), as in Baker (2015).
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace erbs::study {

// The capacity, the intensity at which one case collapses, lies above `lo` and not above `hi`. A run that stands says (im, infinity), one
// that collapses (0, im], and incremental runs of one case the interval between their last standing and first collapsed run.
struct Interval {
  double lo = 0, hi = std::numeric_limits<double>::infinity();
};

enum class FitEnd {
  fitted,
  empty,      // no observation
  none,       // no collapse: theta lies above
  all,        // nothing stands: theta lies below
  separated,  // one intensity parts all that stand from all that collapse: beta has no lower bound
  level,      // collapses and standing runs overlap at one intensity alone, so that beta has no lower bound either
  falling,    // collapses do not grow with the intensity
};

struct Fit {
  FitEnd end = FitEnd::empty;
  double theta = 0, beta = 0;                                   // median capacity, in the unit of im, and dispersion of its logarithm
  double theta_lo = 0, theta_hi = 0, beta_lo = 0, beta_hi = 0;  // 95 % confidence; where not fitted, what bounds theta
  double log_likelihood = 0;
  double a = 0, b = 0, var_a = 0, var_b = 0, cov = 0;  // of Phi(a + b ln im)
  int observations = 0, collapsed = 0;
  double probability(double im) const;
  double band(double im, double sign) const;  // its lower (-1) and upper (+1) end of 95 % confidence
};

// Maximises sum ln(Phi(a + b ln hi) - Phi(a + b ln lo)), b = 1 / beta, a = -ln(theta) / beta: for single runs the binomial likelihood of
// Baker (2015), eq. (11); for incremental runs that of interval-censored capacities, where a case that never collapses counts by
// 1 - Phi, as in his eq. (8). It is concave in (a, b), so that Newton's method finds the one maximum. Confidence is that of the observed
// information, normal in ln(theta) and ln(beta).
Fit fit_fragility(const std::vector<Interval>& observations);

// What a fit that has not ended well means, and what to do; "" for a good one. `factor`: from SI to `unit`.
std::string words(const Fit& fit, const std::string& unit, double factor = 1);

double normal_cdf(double x);

}  // namespace erbs::study
