// Largest eigenvalues of M^-1/2 A M^-1/2: what the bounds on time steps are made of.
#pragma once
#include "engine/base/sparse.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// M^-1/2 of a block at rest attitude; world axes.
Mat6 inverse_root_mass(const Model& model, const State& state, int block);

// Largest eigenvalue of a symmetric matrix by Lanczos with full reorthogonalisation (Paige 1972); its residual is added, since
// the Ritz value errs from below.
double largest_eigenvalue(const Sparse& a);

}  // namespace erbs
