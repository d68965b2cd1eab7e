// The linear algebra of Newton's method on the joint laws (equilibrium.h): what the joints answer where their blocks are, and the step that
// balances a residual.
#pragma once
#include <optional>
#include <vector>

#include "engine/analysis/equilibrium.h"
#include "engine/solve/joint_operator.h"
#include "engine/solve/two_level.h"

namespace erbs {

// What the joints would remember of the present poses.
struct Trial {
  Cold<JointMemory> memory;  // of those that are not sound
  Cold<PointHistory> history;
  Cold<CrushedFace> crushed;
  std::vector<std::uint8_t> sound;
};

// Internal forces at the present pose, joints answering from the history of `state` to where they are now.
VecX internal_force(const Model& model, const State& state, const Freedom& freedom, Trial& trial);

// Steps of Newton's method, by factors of the tangent or without a matrix.
class NewtonSteps {
 public:
  NewtonSteps(const Model& model, const State& state, const Freedom& freedom, Linear how);
  // All joints sound. False where the structure has a mechanism.
  bool sound(const VecX& residual, VecX& step);
  // `brake`: share of the sound stiffness on the diagonal [count]. False where the tangent is singular.
  bool cracked(const Trial& trial, const VecX& brake, const VecX& residual, VecX& step);

 private:
  struct Change;
  std::vector<Change> changes_of(const Trial& trial) const;
  bool by_symmetric_part(const Sparse& tangent, const VecX& residual, VecX& step);
  double factor_bytes() const;
  bool sound_iterative(const VecX& residual, VecX& step);
  bool cracked_iterative(const Trial& trial, const std::vector<Change>& changes, const VecX& held, const VecX& residual, VecX& step);

  const Model& m_;
  const State& s_;
  const Freedom& f_;
  const bool iterative_;
  SparseLdlt ldlt_;
  bool factored_ = false;
  SparseLdlt symmetric_;                 // part of the tangent
  Eigen::Index analysed_ = -1;           // numbers in the pattern that its order was found for
  std::optional<JointOperator> joints_;  // where they were at the first step
  std::optional<TwoLevel> near_;
};

}  // namespace erbs
