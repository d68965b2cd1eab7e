#include "engine/solve/eigenvalue.h"

#include <algorithm>
#include <cmath>

namespace erbs {

Mat6 inverse_root_mass(const Model& m, const State& s, int b) {
  const Mat3 r = s.q[std::size_t(b)].toRotationMatrix();
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(Mat3(r * m.inertia[std::size_t(b)] * r.transpose()));
  Mat6 root = Mat6::Zero();
  root.topLeftCorner<3, 3>() = Mat3::Identity() / std::sqrt(m.mass[std::size_t(b)]);
  root.bottomRightCorner<3, 3>() = eigen.operatorInverseSqrt();
  return root;
}

double largest_eigenvalue(const Sparse& a) {
  const int n = int(a.rows()), most = std::min(n, 120);
  Eigen::MatrixXd basis(n, most + 1);
  VecX alpha = VecX::Zero(most), beta = VecX::Zero(most + 1);
  for (int i = 0; i < n; ++i) basis(i, 0) = 1 + 0.5 * std::sin(1.7 * i);  // fixed start, no symmetry
  basis.col(0).normalize();
  double bound = 0;
  for (int k = 0; k < most; ++k) {
    VecX w = a * basis.col(k);
    alpha[k] = w.dot(basis.col(k));
    for (int pass = 0; pass < 2; ++pass) w -= basis.leftCols(k + 1) * (basis.leftCols(k + 1).transpose() * w);
    beta[k + 1] = w.norm();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(alpha.head(k + 1), beta.segment(1, k));
    const double value = ritz.eigenvalues()[k], residual = std::fabs(beta[k + 1] * ritz.eigenvectors()(k, k));
    bound = value + residual;
    if (residual < 1e-6 * value || beta[k + 1] < 1e-14 * value) break;
    basis.col(k + 1) = w / beta[k + 1];
  }
  return bound;
}

}  // namespace erbs
