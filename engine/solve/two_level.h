// Linear systems of joints without a matrix: a preconditioner of a few hundred bytes a block, and two methods that need no more.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "engine/solve/joint_operator.h"

namespace erbs {

// Approximates K^-1 as the sum of two answers: every block alone, all others held (its own 6 x 6), and every group of about twenty
// neighbours as one rigid piece (Galerkin: R^T K R, R the rigid motions of the pieces, factored). The pieces carry what bends or
// sways a tall structure as a whole, so that the iterations grow with the pieces' size and not with the structure's (two-level additive
// Schwarz with aggregates: Toselli and Widlund 2005, Domain Decomposition Methods, 3.2; rigid motions as a coarse space for elasticity:
// Vanek, Mandel and Brezina 1996, Computing 56, 179).
class TwoLevel {
 public:
  // Diagonal stiffness of joint j in its frame.
  using Form = std::function<std::array<double, 6>(int j)>;
  // `more`: stiffness on the diagonal beside that of the joints [freedom.count], or empty.
  TwoLevel(const Model& model, const State& state, const Freedom& freedom, const Form& form, const VecX& more);
  bool definite() const { return definite_; }  // false: the joints leave some piece or block free to move
  VecX apply(const VecX& residual) const;

 private:
  void group(const Model& model, const State& state, const Freedom& freedom);

  // of each block that may move, in order                                [freedom.count / 6]
  std::vector<int> piece_;
  std::vector<Vec3> arm_;                            // m, from the middle of its piece
  std::vector<Eigen::Matrix<float, 6, 6>> inverse_;  // near enough
  int pieces_ = 0;
  SparseLdlt coarse_;
  bool definite_ = true;
};

using Times = std::function<VecX(const VecX&)>;

// Solves K x = b, K symmetric and positive definite (Hestenes and Stiefel 1952), until the energy of the error, as the preconditioner
// has it, has fallen by tolerance^2. True if it has within `most` turns.
bool conjugate_gradients(const Times& times, const TwoLevel& near, const VecX& b, double tolerance, int most, VecX& x);
// The same for any K: BiCGSTAB (van der Vorst 1992, SIAM J. Sci. Stat. Comput. 13, 631), until the residual has fallen by `tolerance`.
// `near` approximates K^-1.
bool stabilised_gradients(const Times& times, const Times& near, const VecX& b, double tolerance, int most, VecX& x);

}  // namespace erbs
