// Sum over contact points of on K on', with on the rows of a contact force and K its flexibility: symmetric, coupling blocks that touch.
#pragma once
#include <utility>
#include <vector>

#include "engine/analysis/limit/problem.h"

namespace erbs::analysis {

// Adds the force f (n, s, t on block b) to the equilibrium of both blocks.
void add_force(const LimitProblem& problem, const ContactPoint& contact, const Vec3& f, VecX& rows);
// Velocity of block b relative to block a, along n, s, t.
Vec3 relative_velocity(const LimitProblem& problem, const ContactPoint& contact, const VecX& rates);

class ContactMatrix {
 public:
  explicit ContactMatrix(const LimitProblem& problem);
  void clear();
  void add(const ContactPoint& contact, const Mat3& flexibility);
  bool factorize();
  VecX solve(const VecX& right) const;  // with one step of refinement

 private:
  const LimitProblem& problem_;
  Sparse matrix_;                                          // lower triangle
  std::vector<std::vector<std::pair<int, int>>> partner_;  // of each body: later bodies it touches, and their place in its columns
  SparseLdlt factor_;
};

}  // namespace erbs::analysis
