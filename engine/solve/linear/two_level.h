// Matrix-free solution of the joints' linear system: a preconditioner of a few hundred bytes per block, and two iterative methods.
#pragma once
#include <functional>
#include <vector>

#include "engine/solve/linear/joint_operator.h"
#include "engine/solve/linear/rigid_pieces.h"

namespace erbs {

// Preconditioner: approximates K^-1 as the sum of two answers. The first takes every block alone, all others fixed (its own 6 x 6 matrix).
// The second takes every group of about twenty neighbours as one rigid piece (Galerkin: R^T K R, R the rigid motions of the pieces,
// factored). The pieces carry the bending and sway of a tall structure as a whole. So the iterations grow with the size of the pieces, not
// of the structure (two-level additive Schwarz with aggregates: Toselli and Widlund 2005, Domain Decomposition Methods, 3.2; rigid motions
// as a coarse space for elasticity: Vanek, Mandel and Brezina 1996, Computing 56, 179).
class TwoLevel {
 public:
  using Form = RigidPieces::Form;
  // `more`: diagonal stiffness besides that of the joints [freedom.count], or empty.
  TwoLevel(const Model& model, const State& state, const Freedom& freedom, const Form& form, const VecX& more);
  bool definite() const { return definite_; }  // false: some piece or block is free to move
  VecX apply(const VecX& residual) const;

 private:
  RigidPieces pieces_;
  CoarseSystem coarse_;
  std::vector<Eigen::Matrix<float, 6, 6>> inverse_;  // of each free block, in order; accurate enough for a preconditioner
  bool definite_ = true;
};

using Times = std::function<VecX(const VecX&)>;

// Solves K x = b, K symmetric and positive definite (Hestenes and Stiefel 1952), until the energy of the error, as measured by the
// preconditioner, has fallen by tolerance^2. True if this takes at most `most` iterations.
bool conjugate_gradients(const Times& times, const TwoLevel& near, const VecX& b, double tolerance, int most, VecX& x);
// The same for any K: BiCGSTAB (van der Vorst 1992, SIAM J. Sci. Stat. Comput. 13, 631), until the residual has fallen by `tolerance`.
// `near` approximates K^-1.
bool stabilised_gradients(const Times& times, const Times& near, const VecX& b, double tolerance, int most, VecX& x);

}  // namespace erbs
