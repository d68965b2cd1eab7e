// Static equilibrium under constant loads: the start of a run, so that shaking meets a structure at rest.
#pragma once
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

struct Equilibrium {
  bool converged = false;  // all islands
  int iterations = 0;
  double unbalanced = 0;            // largest unbalanced force / largest applied force of its island
  std::vector<std::uint8_t> found;  // the block's island is in equilibrium [nblock]
  int given_up = 0;                 // number of islands without equilibrium
  std::string why;                  // reason, for the worst of these
};

// What metrics.json says of it, also at the end of a resumed run.
template <class E, class F>
requires std::is_same_v<std::remove_const_t<E>, Equilibrium>
void each(E& e, F&& f) {
  f("iterations", e.iterations);
  f("unbalanced", e.unbalanced);
  f("given_up", e.given_up);
}

// Solution of the linear systems in Newton's method: sparse factors, or matrix-free iterations (two_level.h). `by_size` takes iterations if
// factors would need more than 100 MiB. Iterations that do not converge fall back on factors.
enum class Linear { by_size, direct, iterative };

// Newton's method on the joint laws. The matrix is factored as sparse LDL^T while all joints are intact. Once a joint opens or slides, the
// consistent tangent is factored as LU, since friction makes it unsymmetric.
// Line search: each island takes its own fraction of a step, up to the point where the work of the residual along the step vanishes. The
// potential of opening joints is convex, so this point is its minimum along the step.
// A fraction of the intact stiffness brakes blocks that have lost support; it decreases as balance approaches (pseudo-transient
// continuation, Kelley and Keyes 1998, SIAM J. Numer. Anal. 35, 508).
// `loads` holds force and moment on each block besides gravity (6 doubles a block). Blocks that no joint connects to the ground stay in
// place. On return the state holds the equilibrium of each island that has one; other islands are unchanged.
Equilibrium settle(const Model& model, State& state, const std::vector<double>& loads, Linear how = Linear::by_size);

}  // namespace erbs::analysis
