// The sequential scheme of Gu and Miao, for studies of it: all blocks are held, one at a time is let go for a step, and the next one
// meets it where it has arrived. On one thread; the default of ERBS is the leapfrog of step.h. The sound joints of a block, which has
// moved alone, answer eight side by side (lanes_sound.inc); kernel = "reference" asks each of them point by point instead. What a block
// does concerns its neighbours alone: so blocks are dealt into rounds, each in the round after the last of those neighbours that precede
// it in the order, and the blocks of a round, none of which has a joint with another, go side by side with the result of one by one.
//
// With K = L + D + U split by the order of the blocks the literal sweep is
//   M (x+ - 2 x + x-) / dt^2 + K x + L (x+ - x) = 0:  a damping matrix dt L, over random orders in the mean dt (K - D) / 2,
// which feeds rigid and slow motion at dt K_ii / (2 m) and takes from the zig-zag ones. Action and reaction are read at different
// instants, so that momentum is not kept. The centred sweep reads the force on a block half a step ahead on its own path: dt L + dt D/2,
// in the mean dt K / 2, nothing on rigid motion.
#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/solve/integrate.h"
#include "engine/solve/joint_kernel.h"
#include "engine/solve/lanes.h"

namespace erbs {

class Sequential {
 public:
  Sequential(const Model& model, State& state);

  // One sweep over all blocks: the place of joints() and blocks() of a leapfrog step. What acts is held as it was at the start of the
  // sweep. `sums` as for Picked::advance(). The ledger's state terms are those at the start of the sweep.
  void sweep(const Excitation& e, const Pushes& pushes, const std::vector<BlockConstants>& constants, bool sample, JointSums& joints,
             std::vector<BlockSums>& sums);
  void refresh(const std::vector<std::uint8_t>& stale);  // of blocks

  // What the joints' forces of the last sampled sweep add up to over all pairs of moving blocks, of the sum of their sizes: 0 where
  // action is reaction.
  double momentum_residual() const;
  // State::wrench as it was at the start of a sampled sweep, for what is recorded then.
  Rows& wrench_before() { return wrench_before_; }

 private:
  void deal_order();
  void update(const std::vector<int>& joints);  // after a refresh of these
  void visit(int b, double moved, JointSums& sums);
  void look_closer(int batch, int b, double moved, JointSums& sums);
  void follow(int j, JointSums& sums);
  void predict(int b);
  void try_out(int j);
  void leave(int j);
  void clear_lane(int lane);
  double stored() const;
  bool turned_far(int b) const;
  void note_momentum(int b);

  const Model& model_;
  State& state_;
  const bool centred_, plain_;
  std::vector<int> driven_;
  std::vector<int> order_;                                       // of the sweep, moving blocks only: round by round
  std::vector<int> round_;                                       // rounds are order_[round_[i] .. round_[i + 1])
  std::vector<int> level_, next_, first_neighbour_, neighbour_;  // moving neighbours of each block: neighbour_[first_neighbour_[b] ..)
  std::vector<int> first_end_;                                   // joints of each block: end_[first_end_[b] .. first_end_[b + 1])
  std::vector<int> end_;
  std::vector<int> first_batch_;  // its sound joints: batch_[first_batch_[b] .. first_batch_[b + 1]), each block its own copy
  std::vector<SoundBatch> batch_;
  std::deque<SoundLaw> law_;  // each batch's own
  std::vector<SoundEnds> ends_;
  std::vector<int> joint_;  // of a lane of batch_; -1 none
  struct Lanes {
    int of_a = -1, of_b = -1;  // in batch_: batch * lanes + lane; -1 none
  };
  std::vector<Lanes> lane_;  // of a joint
  std::vector<int> broken_;  // joints of each block that are no longer sound
  std::vector<int> near_, its_joints_;
  std::vector<PointHistory> trial_;
  Rows wrench_before_;
  Vec3 force_ = Vec3::Zero(), moment_ = Vec3::Zero();  // N, N m about the first block at rest
  double forces_ = 0, moments_ = 0;
};

// Blocks in the order in which sweep number `step` lets them go. "fixed": as the scene makes them; "random": a permutation drawn from
// (seed, step), the same whenever it is asked for; "coloured": by colours of a greedy colouring (Welsh and Powell 1967), so that no two
// blocks of one colour share a joint.
std::vector<int> sweep_order(const Model& model, std::uint64_t seed, std::uint64_t step);

}  // namespace erbs
