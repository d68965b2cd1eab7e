// Linear algebra of Newton's method on the joint laws (equilibrium.h): joint forces at the present poses, and the step that balances a
// residual.
#pragma once
#include <optional>
#include <vector>

#include "engine/analysis/start/equilibrium.h"
#include "engine/solve/linear/joint_operator.h"
#include "engine/solve/linear/two_level.h"

namespace erbs::analysis {

// Joint state that the present poses would leave.
struct Trial {
  LazyArray<JointMemory> memory;  // of joints that are not intact
  LazyArray<PointHistory> history;
  LazyArray<CrushedFace> crushed;
  std::vector<std::uint8_t> intact;
};

// Internal forces at the present pose. Each joint law is evaluated from the history in `state` to the present pose.
VecX internal_force(const Model& model, const State& state, const Freedom& freedom, Trial& trial);

// Newton steps, with a factored tangent or matrix-free.
class NewtonSteps {
 public:
  NewtonSteps(const Model& model, const State& state, const Freedom& freedom, Linear how);
  // Step with all joints intact. False if the structure has a mechanism.
  bool intact(const VecX& residual, VecX& step);
  // Step with cracked joints. `brake`: fraction of the intact stiffness added to the diagonal [count]. False if the tangent is singular.
  bool cracked(const Trial& trial, const VecX& brake, const VecX& residual, VecX& step);

 private:
  struct Change;
  std::vector<Change> changes_of(const Trial& trial) const;
  bool by_symmetric_part(const Sparse& tangent, const VecX& residual, VecX& step);
  double factor_bytes() const;
  bool intact_iterative(const VecX& residual, VecX& step);
  bool cracked_iterative(const Trial& trial, const std::vector<Change>& changes, const VecX& held, const VecX& residual, VecX& step);

  const Model& m_;
  const State& s_;
  const Freedom& f_;
  const bool iterative_;
  SparseLdlt ldlt_;
  bool factored_ = false;
  SparseLdlt symmetric_;                 // symmetric part of the tangent
  Eigen::Index analysed_ = -1;           // nonzeros of the pattern its ordering was computed for
  std::optional<JointOperator> joints_;  // with the joints at their pose of the first step
  std::optional<TwoLevel> near_;
};

}  // namespace erbs::analysis
