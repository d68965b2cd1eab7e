// Equilibrium under constant loads: how a run starts, so that shaking meets a wall at rest.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct Equilibrium {
  bool converged = false;
  int iterations = 0;
  double unbalanced = 0;  // largest unbalanced force / largest applied force
  std::string why;        // where not converged
};

// Newton's method on the joint laws, sparse LDL^T for the tangent (the intact structure at first, then finite differences of the
// law in joints that open or slide). `push` is force and moment on each block besides gravity (6 doubles a block). Blocks that
// no joint holds to the ground stay where they are. On success the state holds the equilibrium; otherwise it is unchanged.
Equilibrium settle(const Model& model, State& state, const std::vector<double>& push);

}  // namespace erbs
