// Primal-dual interior point method for the limit problem with round friction cones (Mehrotra's predictor and corrector). Forces are
// eliminated at each contact point, so that the matrix of a step couples blocks that touch, as a stiffness matrix does. The slack of the
// forces gives the statical multiplier, the multipliers of equilibrium are the velocities of the mechanism.
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "engine/analysis/limit/cone.h"
#include "engine/analysis/limit/problem.h"

namespace erbs::analysis {

class InteriorPoint {
 public:
  explicit InteriorPoint(const LimitProblem& problem);
  ~InteriorPoint();

  // The largest lambda <= `most` with equilibrium of contact forces, constant and lambda push. `tolerance`: gap of the two multipliers,
  // relative. `warm`: starts near the last solution, for strengths that differ little from its own.
  LimitSolution solve(const VecX& constant, const VecX& push, const std::vector<Strength>& strength, double most, double tolerance,
                      bool warm = false);

 private:
  struct Iterate;
  struct Steps;
  struct Matrix;
  void set_cones(const std::vector<Strength>& strength);
  void residuals(Iterate& at) const;
  bool factorize();
  bool advance(Iterate& at);
  std::pair<double, double> longest(const Iterate& at, const Steps& way, double share) const;
  double coming_gap(const Iterate& at, const Steps& way, double s_step, double z_step) const;
  void newton(const Iterate& at, double target, const Steps* predictor, Steps& out) const;
  bool start(Iterate& at);
  bool start_warm(Iterate& at);

  const LimitProblem& problem_;
  std::vector<ContactCone> cone_;
  std::vector<Mat3> flexibility_;  // inverse of each contact point's stiffness
  VecX constant_, push_;
  double most_ = 0;
  int degree_ = 0;
  VecX along_push_;  // matrix^-1 push
  std::unique_ptr<Matrix> matrix_;
  std::unique_ptr<Iterate> kept_;  // an iterate well inside the cones, for a warm start
};

}  // namespace erbs::analysis
