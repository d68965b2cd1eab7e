#include "engine/solve/eigenvalue.h"

#include <algorithm>
#include <cmath>

namespace erbs {

double largest_eigenvalue(int n, const std::function<void(const VecX&, VecX&)>& times) {
  const int most = std::min(n, 120);
  VecX alpha = VecX::Zero(most), beta = VecX::Zero(most + 1), before = VecX::Zero(n), now(n), next(n);
  for (int i = 0; i < n; ++i) now[i] = 1 + 0.5 * std::sin(1.7 * i);  // fixed start, no symmetry
  now.normalize();
  double bound = 0;
  for (int k = 0; k < most; ++k) {
    times(now, next);
    next -= beta[k] * before;
    alpha[k] = next.dot(now);
    next -= alpha[k] * now;
    beta[k + 1] = next.norm();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(alpha.head(k + 1), beta.segment(1, k));
    const double value = ritz.eigenvalues()[k], residual = std::fabs(beta[k + 1] * ritz.eigenvectors()(k, k));
    bound = value + residual;
    if (residual < 1e-6 * value || beta[k + 1] < 1e-14 * value) break;
    before.swap(now);
    now = next / beta[k + 1];
  }
  return bound;
}

double largest_eigenvalue(const Sparse& a) {
  return largest_eigenvalue(int(a.rows()), [&](const VecX& x, VecX& y) { y = a * x; });
}

}  // namespace erbs
