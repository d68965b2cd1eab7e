#include "engine/loads/record/spline.h"

#include <cmath>
#include <utility>

#include "engine/base/sparse.h"
#include "engine/base/units.h"
#include "engine/loads/waves/polyline.h"

namespace erbs {

// Unknown are the second derivatives g at all points but the last, where it is zero. Continuity of s', and s' = 0 at the start, say
// Q' s = R g with tridiagonal R; Int s''^2 = g' R g. So s = y - lambda Q g and (R + lambda Q'Q) g = Q' y.
Differentiated differentiated(const std::vector<double>& times, std::vector<double> values, std::string_view quantity, double corner,
                              const Place& place) {
  const auto n = static_cast<int>(times.size());
  if (n < 4) throw Error(fmt::format("{} values are too few for a smoothing spline; give at least four", n), place);
  const double mean_step = (times.back() - times.front()) / (n - 1), nyquist = 0.5 / mean_step;
  if (corner >= nyquist)
    throw Error(fmt::format("smoothing = {:g} Hz does not lie below half the sampling rate, {:.6g} Hz; lower it", corner, nyquist), place);
  if (quantity == "velocity") values = make_polyline(times, std::move(values)).area;
  const auto h = [&](int i) { return times[static_cast<size_t>(i + 1)] - times[static_cast<size_t>(i)]; };
  Triplets q, r;
  for (int i = 0; i + 1 < n; ++i) {
    const double after = 1 / h(i), before = i > 0 ? 1 / h(i - 1) : 0;
    q.emplace_back(i + 1, i, after);
    q.emplace_back(i, i, -after - before);
    if (i > 0) q.emplace_back(i - 1, i, before);
    r.emplace_back(i, i, (h(i) + (i > 0 ? h(i - 1) : 0)) / 3);
    if (i + 2 < n) r.emplace_back(i, i + 1, h(i) / 6), r.emplace_back(i + 1, i, h(i) / 6);
  }
  Sparse Q(n, n - 1), R(n - 1, n - 1);
  Q.setFromTriplets(q.begin(), q.end());
  R.setFromTriplets(r.begin(), r.end());
  const double lambda = 1 / (mean_step * std::pow(2 * pi * corner, 4));
  const VecX y = Eigen::Map<const VecX>(values.data(), n);
  const Sparse matrix = R + lambda * Sparse(Q.transpose() * Q);
  const SparseLdlt factor(matrix);
  const VecX g = factor.solve(VecX(Q.transpose() * y));
  Differentiated out;
  out.acceleration.assign(g.data(), g.data() + g.size());
  out.acceleration.push_back(0);
  out.rms = lambda * (Q * g).norm() / std::sqrt(n);
  return out;
}

}  // namespace erbs
