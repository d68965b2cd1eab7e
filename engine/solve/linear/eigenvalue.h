// Largest eigenvalues of M^-1/2 A M^-1/2, for the bounds on the time step.
#pragma once
#include <functional>

#include "engine/base/sparse.h"

namespace erbs {

// Largest eigenvalue of a symmetric operator of size n, times(x, y) giving y = A x, by Lanczos' recurrence of three vectors. No basis is
// stored. So orthogonality is lost, but only along Ritz vectors that have converged; copies of these then appear. The largest Ritz value
// and its residual stay right to round-off (Paige 1980, Linear Algebra Appl. 34, theorem 3.1 and section 4). The residual is added, since
// the Ritz value errs from below.
double largest_eigenvalue(int n, const std::function<void(const VecX& x, VecX& y)>& times);
double largest_eigenvalue(const Sparse& a);

}  // namespace erbs
