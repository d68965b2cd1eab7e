// Least squares over a box, for residuals that cost a run each and are noisy in their last digits: a scan, then Levenberg and Marquardt.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace erbs::study {

using Shares = std::vector<double>;                    // of the range of each param, 0 to 1
using Residuals = std::optional<std::vector<double>>;  // none: the run failed
// Evaluates all points, side by side; the answers keep their order.
using EvaluateAll = std::function<std::vector<Residuals>(const std::vector<Shares>&)>;

struct LeastSquares {
  double rel = 1e-3;  // smallest step, a share of a range
  int rounds = 20;    // at most, after the scan
};

struct Minimum {
  bool found = false;      // a point has residuals
  bool converged = false;  // the last step was below rel
  Shares best;
  std::vector<double> residuals;
  double sum = 0;  // of their squares
  // Standard deviation of each share, from the scatter of the residuals (linear theory). Infinite: it moves nothing; not a number: there
  // are no more residuals than params.
  std::vector<double> deviation;
};

double sum_of_squares(const std::vector<double>& residuals);

// Scan: nine values of one param, or a Latin hypercube of 8 n + 1 points; then steps of Marquardt 1963 (J. SIAM 11, 431) from the best one,
// with central differences whose step shrinks with the steps. A param at an end of its range that wants to leave it stays there.
Minimum least_squares(std::size_t n, const EvaluateAll& evaluate, const LeastSquares& how);

}  // namespace erbs::study
