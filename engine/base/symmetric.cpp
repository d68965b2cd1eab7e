#include "engine/base/symmetric.h"

namespace erbs {

double largest_eigenvalue(const Mat6& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Mat6>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[5];
}

}  // namespace erbs
