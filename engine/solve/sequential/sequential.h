// The sequential scheme of Gu and Miao, for parameter studies; the default of ERBS is the leapfrog of `step.h`. All blocks are fixed; one
// at a time is released for a step, and the next block sees it at its new pose. It runs on one thread.
//
// A block acts on its neighbours alone. So blocks are scheduled in rounds: each block in the round after the last of its neighbours that
// precede it in the order. Blocks of one round share no joint; they advance as packs, with the result of one by one. The intact joints of a
// block that has moved are evaluated in packs (`intact_kernel.h`); `kernel = "reference"` evaluates them point by point instead.
//
// With K = L + D + U split by the order of the blocks, the literal sweep is
//   M (x+ - 2 x + x-) / dt^2 + K x + L (x+ - x) = 0:  a damping matrix dt L, on average over random orders dt (K - D) / 2.
// It feeds rigid and slow motion at dt K_ii / (2 m) and damps zig-zag motion. Action and reaction are read at different instants, so that
// momentum is not conserved. The centred sweep reads the force on a block half a step ahead on its own path: dt L + dt D/2, on average
// dt K / 2, with no effect on rigid motion.
#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/joints/joint_forces.h"
#include "engine/joints/kernels.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs {

class Sequential {
 public:
  Sequential(const Model& model, State& state);

  // One sweep over all blocks, in place of the phases `joints` and `blocks` of a leapfrog step. External actions stay as they are at the
  // start of the sweep. `sums` as for `BlockGather::advance()`. The state terms of the ledger are those at the start of the sweep.
  void sweep(const Excitation& e, const ExternalForces& external, const std::vector<BlockConstants>& constants, bool sample,
             JointSums& joints, std::vector<BlockSums>& sums);
  void update_reference(const std::vector<std::uint8_t>& outdated);  // `outdated`: blocks with a new reference pose

  // Sum of the joint forces of the last sampled sweep over all pairs of moving blocks, over the sum of their magnitudes: 0 if action equals
  // reaction exactly.
  double momentum_residual() const;
  // `KernelCache::wrench` at the start of a sampled sweep, for recorders.
  Rows& wrench_before() { return wrench_before_; }

 private:
  void schedule_blocks();
  void update(const std::vector<int>& joints);  // their geometry at the reference poses
  void visit(int b, double moved, JointSums& sums);
  void check_points(int pack, int b, double moved, JointSums& sums);
  void update_joint(int j, JointSums& sums);
  void predict(int b);
  void try_out(int j);
  void leave(int j);
  void clear_lane(int lane);
  double stored() const;
  bool rotated_far(int b) const;
  void note_momentum(int b);

  const Model& model_;
  State& state_;
  const bool centred_, plain_;
  std::vector<int> driven_;
  std::vector<int> order_;                                       // of the sweep, round by round; moving blocks only
  std::vector<int> round_;                                       // rounds are `order_[round_[i] .. round_[i + 1])`
  std::vector<int> level_, next_, first_neighbour_, neighbour_;  // moving neighbours of each block: `neighbour_[first_neighbour_[b] ..)`
  std::vector<int> first_end_;                                   // joints of each block: `end_[first_end_[b] .. first_end_[b + 1])`
  std::vector<int> end_;
  std::vector<int> first_pack_;  // its intact joints: `pack_[first_pack_[b] .. first_pack_[b + 1])`; each block has its own copy
  std::vector<IntactPack> pack_;
  std::deque<IntactConstants> law_;  // one per pack
  std::vector<IntactEnds> ends_;
  std::vector<int> joint_;  // of each lane of `pack_`; -1: none
  struct Lanes {
    int of_a = -1, of_b = -1;  // in `pack_`: batch * lanes + lane; -1: none
  };
  std::vector<Lanes> lane_;  // per joint
  std::vector<int> broken_;  // number of joints of each block that are not intact
  std::vector<int> may_yield_, its_joints_;
  std::vector<PointHistory> trial_;
  Rows wrench_before_;
  Vec3 force_ = Vec3::Zero(), moment_ = Vec3::Zero();  // N, N m about the first block at rest
  double forces_ = 0, moments_ = 0;
};

// Order of the blocks in sweep number `step`. "fixed": as in the scene; "random": a permutation drawn from (seed, step), so that it can be
// repeated; "coloured": by a greedy colouring (Welsh and Powell 1967), in which blocks of one colour share no joint.
std::vector<int> sweep_order(const Model& model, std::uint64_t seed, std::uint64_t step);

}  // namespace erbs
