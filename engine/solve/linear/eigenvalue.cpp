#include "engine/solve/linear/eigenvalue.h"

#include <algorithm>
#include <cmath>

namespace erbs {

// Greatest Ritz value of the first k + 1 Lanczos vectors, and the bound of its error.
struct Ritz {
  double value, residual;
};
static Ritz ritz_of(const VecX& alpha, const VecX& beta, int k) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(alpha.head(k + 1), beta.segment(1, k));
  return {ritz.eigenvalues()[k], std::fabs(beta[k + 1] * ritz.eigenvectors()(k, k))};
}

double largest_eigenvalue(int n, const std::function<void(const VecX&, VecX&)>& times) {
  // Ritz values cost more than products, so they are tested every few steps; the first good value among these steps is then found.
  constexpr int test_every = 8;
  if (n == 0) return 0;
  const int most = std::min(n, 120);
  VecX alpha = VecX::Zero(most), beta = VecX::Zero(most + 1), before = VecX::Zero(n), now(n), next(n);
  for (int i = 0; i < n; ++i) now[i] = 1 + 0.5 * std::sin(1.7 * i);  // fixed start, no symmetry
  now.normalize();
  for (int k = 0;; ++k) {
    times(now, next);
    next -= beta[k] * before;
    alpha[k] = next.dot(now);
    next -= alpha[k] * now;
    beta[k + 1] = next.norm();
    const auto good = [&](const Ritz& r, int at) { return r.residual < 1e-6 * r.value || beta[at + 1] < 1e-14 * r.value; };
    const bool last = k + 1 == most || !(beta[k + 1] > 0);
    if (last || k % test_every == test_every - 1) {
      const Ritz end = ritz_of(alpha, beta, k);
      for (int i = k - k % test_every; i < k && (last || good(end, k)); ++i)
        if (const Ritz r = ritz_of(alpha, beta, i); good(r, i)) return r.value + r.residual;
      if (last || good(end, k)) return end.value + end.residual;
    }
    before.swap(now);
    now = next / beta[k + 1];
  }
}

double largest_eigenvalue(const Sparse& a) {
  return largest_eigenvalue(int(a.rows()), [&](const VecX& x, VecX& y) { y = a * x; });
}

}  // namespace erbs
