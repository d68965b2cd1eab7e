// The sequential scheme of Gu and Miao, for studies of it: all blocks are held, one at a time is let go for a step, and the next one
// meets it where it has arrived. Plain and readable, on one thread; the default of ERBS is the leapfrog of step.h.
//
// With K = L + D + U split by the order of the blocks the literal sweep is
//   M (x+ - 2 x + x-) / dt^2 + K x + L (x+ - x) = 0:  a damping matrix dt L, over random orders in the mean dt (K - D) / 2,
// which feeds rigid and slow motion at dt K_ii / (2 m) and takes from the zig-zag ones. Action and reaction are read at different
// instants, so that momentum is not kept. The centred sweep reads the force on a block half a step ahead on its own path: dt L + dt D/2,
// in the mean dt K / 2, nothing on rigid motion.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/solve/integrate.h"
#include "engine/solve/joint_kernel.h"

namespace erbs {

class Sequential {
 public:
  Sequential(const Model& model, State& state);

  // One sweep over all blocks: the place of joints() and blocks() of a leapfrog step. `push` and `load` as for advance(), held as they
  // were at the start of the sweep; `sums` one a block. The ledger's state terms are those at the start of the sweep.
  void sweep(const Excitation& e, const Pushes& pushes, bool sample, JointSums& joints, std::vector<BlockSums>& sums);

  // What the joints' forces of the last sweep add up to over all pairs of moving blocks, of the sum of their sizes: 0 where action is
  // reaction.
  double momentum_residual() const;
  // State::wrench as it was at the start of a sampled sweep, for what is recorded then.
  Rows& wrench_before() { return wrench_before_; }

 private:
  void update(int j, JointSums& sums);
  void predict(int b);
  void note_momentum(int b);

  const Model& model_;
  State& state_;
  const bool centred_;
  std::vector<int> order_;
  std::vector<int> first_end_;  // joints of each block: end_[first_end_[b] .. first_end_[b + 1])
  std::vector<int> end_;
  std::vector<PointHistory> trial_;
  Rows wrench_before_;
  Vec3 force_, moment_;  // N, N m about the first block at rest
  double forces_ = 0, moments_ = 0;
};

// Blocks in the order in which sweep number `step` lets them go. "fixed": as the scene makes them; "random": a permutation drawn from
// (seed, step), the same whenever it is asked for; "coloured": by colours of a greedy colouring (Welsh and Powell 1967), so that no two
// blocks of one colour share a joint.
std::vector<int> sweep_order(const Model& model, std::uint64_t seed, std::uint64_t step);

}  // namespace erbs
