// Inertia of a relaxation, softened for what a structure does as a whole. What is at rest does not depend on masses, so the long waves,
// which keep a relaxation waiting, may be as quick as wanted while the short ones, which set the step, stay.
#pragma once
#include <vector>

#include "engine/base/system/team.h"
#include "engine/joints/kernels.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/blocks/integrate.h"
#include "engine/solve/linear/rigid_pieces.h"

namespace erbs {

// In place of M^-1 acts M^-1 + rate R K_c^-1 R^T, with R the motions of rigid pieces and K_c = R^T K R their stiffness. It is symmetric and
// positive definite, hence the inverse of a mass matrix. Every motion of the pieces has at least `rate` for its circular frequency squared,
// and the largest one of all rises by no more than `rate`: for the eigenvalues of rate R K_c^-1 R^T K are `rate` and 0. Beds that open are
// softer than K, never stiffer. (Two-level preconditioning of an explicit march: Toselli and Widlund 2005, Domain Decomposition Methods,
// 3.2, there of conjugate gradients.)
class CoarseInertia {
 public:
  // `freedom`: blocks that joints connect to the ground, the only ones that this inertia moves. `size`: blocks in a piece.
  CoarseInertia(const Model& model, const State& state, const Freedom& freedom, int size);
  bool definite() const { return system_.definite(); }
  // The share of the energy x^T K x / 2 of a motion x that the pieces take part in; `force` = K x.  [freedom.count]
  double share(const VecX& force, const VecX& x) const;
  void set_rate(double rate) { rate_ = rate; }  // 1/s2

  // A step: the forces on the blocks of a range of groups, all pieces on one thread, the rows of the range and their work.
  void gather(const VectorPack<6>* force, Range groups);
  void solve();
  // The work of this inertia counts as damping: with it the ledger closes, and all of it is gone at rest.
  void scatter(const State& state, Range groups, std::vector<BlockSums>& sums);
  const double* rows() const { return row_.data(); }  // N, N m: the force that makes the difference, one row per block
  Vec3 force(int b) const { return Eigen::Map<const Vec3>(rows() + pack_size * b); }  // N, of it on block b

 private:
  struct Block {
    int piece = -1, slot = -1;  // -1: does not take part
    Vec3 arm;                   // m, from the centre of its piece
    double mass = 0;
    Mat3 inertia;  // kg m2, at rest: rotations on the way to equilibrium are small
  };

  RigidPieces pieces_;
  CoarseSystem system_;
  double rate_ = 0;
  std::vector<Block> block_;     // [nblock]
  std::vector<int> slot_piece_;  // a slot sums the blocks of one piece in one chunk, so that sums do not depend on threads
  std::vector<int> first_slot_;  // of each chunk                        [chunks + 1]
  std::vector<Vec6> slot_;       // N, N m
  VecX motion_;                  // of the pieces: wrenches, then accelerations
  Rows row_;
};

}  // namespace erbs
