// Equilibrium under constant loads: how a run starts, so that shaking meets a wall at rest.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct Equilibrium {
  bool converged = false;  // all islands
  int iterations = 0;
  double unbalanced = 0;            // largest unbalanced force / largest applied force of its island
  std::vector<std::uint8_t> found;  // the block's island has come to equilibrium [nblock]
  int given_up = 0;                 // islands that have not
  std::string why;                  // of the worst of those
};

// How the linear systems of Newton's method are solved: by sparse factors, or, where those would take more than 100 MiB, by iterations
// that need no matrix (two_level.h) and fall back on factors where they do not converge.
enum class Linear { by_size, direct, iterative };

// Newton's method on the joint laws: sparse LDL^T while all joints are sound, LU of the consistent tangent once some open or slide
// (friction makes it unsymmetric). Each island takes its own part of a step, to where the step's work vanishes: the potential of
// joints that open is convex, so that this is its lowest point along the step. A part of the sound stiffness, smaller as the
// balance comes near, brakes blocks that have lost their hold (pseudo-transient continuation, Kelley and Keyes 1998, SIAM J. Numer.
// Anal. 35, 508). `push` is force and moment on each block besides gravity (6 doubles a block). Blocks that no joint holds to the
// ground stay where they are. The state holds the equilibrium of each island that has one; the others are as they were.
Equilibrium settle(const Model& model, State& state, const std::vector<double>& push, Linear how = Linear::by_size);

}  // namespace erbs
