// The limit problem with friction cones of plane facets, as a linear program. In a plane problem two facets are the cone itself. In space
// an inscribed cone gives a lower bound of the multiplier and a circumscribed one an upper bound; one facet edge lies along the push, so
// that both agree where joints slide in its direction.
#pragma once
#include <vector>

#include "engine/analysis/limit/linear_program.h"
#include "engine/analysis/limit/problem.h"

namespace erbs::analysis {

class FacetedProblem {
 public:
  // `bond`: there is cohesion, now or in a later solution. The multiplier is at most `most`.
  FacetedProblem(const LimitProblem& problem, const VecX& constant, const VecX& push, const std::vector<Strength>& strength, int facets,
                 bool circumscribed, bool bond, double most);
  // With other tensions and cohesions, but the same slopes; the basis of the last solution is the start.
  LimitSolution solve(const std::vector<Strength>& strength);

 private:
  // Unit shear (s, t) of edge i of the cone, and of segment i: half as many segments add up to a polygon of as many sides.
  Vec3 edge(int i) const;
  Vec3 segment(int i) const;
  void add_column(const ContactPoint& contact, const Vec3& force);

  const LimitProblem& problem_;
  int facets_;
  bool circumscribed_, bond_;
  VecX constant_, push_;
  std::vector<double> slope_;  // of each contact point
  LinearProgram program_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace erbs::analysis
