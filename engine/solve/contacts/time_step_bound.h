// Bound on the time step by joints and contacts together, while contacts come and go.
//
// Two upper bounds of omega^2 of the whole system; the lower one counts:
//   by joints   omega^2 of the intact structure at rest (`4 / StepRange::critical^2`), plus twice the largest eigenvalue of the other
//   contacts'
//               stiffness on a block (Weyl's inequality). A cracked joint, or the contact that replaced it, is no stiffer.
//   by blocks   twice the largest eigenvalue of the total stiffness on a block, remaining joints included. Since
//               (x - y) K (x - y) <= 2 (x K x + y K y), 2 / omega is the block bound of the present structure. Weights of the blocks
//               bring it nearer to the true eigenvalue where a few of them ask for a short step (`by_weights`).
// The matrices are updated at intervals by `update_bound()`. Between two updates each block adds scalars that every step has available: the
// rates of its contacts beyond the last update (`PairResult::omega2_a`, `omega2_b`), and the rate of a face that may strike it next. The
// block with the greatest sum decides. So the step may exceed the limit of the intact structure once stiff joints are gone.
#pragma once
#include <limits>
#include <span>
#include <vector>

#include "engine/contact/law/pair.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Time steps of a structure and of a run.
struct StepRange {
  double critical = std::numeric_limits<double>::infinity();  // s, 2 / omega_max at rest, joints in their stiffer form; infinite without
  double longest = 0;                                         // s, longest step of a run, once contacts allow more than the joints did
};

class ContactLimit {
 public:
  ContactLimit(const Model& model, State& state, const StepRange& range) : model_(model), state_(state), range_(range) {}

  const StepRange& range() const { return range_; }
  // 1/s2, share of block b in 1 / dt^2. `omega2` (1/s2): its contacts beyond the last update; `impact_omega2` (1/s2): a face that may
  // strike it.
  double on_block(int b, double omega2, double impact_omega2) const;
  double common() const;  // 1/s2, the share of the structure that is common to all blocks
  // The greatest share among moving `blocks`; `omega2` and `impact_omega2` of each block of the model [nblock].
  double on_most(std::span<const int> blocks, std::span<const double> omega2, std::span<const double> impact_omega2) const;
  // s, time step allowed if the greatest share is `most`. `common`: of blocks that share in the structure, else of loose ones.
  double allowed(double most, bool common = true) const;
  // True if the bound needs an update; `allowed` (s) is the step that it allows now.
  bool due(double allowed) const;
  // Updates the bound with joints and present contacts. Former joints count as the joints they replaced. `scalars` (1/s2): sum of the rates
  // of all other contacts per block, an upper bound that may be the lower one.
  void update_bound(const ContactShapes& shapes, std::span<const ContactBlock> blocks, const std::vector<double>& scalars,
                    OverlapRoom& room);

 private:
  double shorter() const;
  double intact() const;
  struct Spring {
    int a, b;         // blocks
    Mat6 on_a, on_b;  // against motions of one of them: N/m, N, N m
  };
  std::vector<double> by_weights(std::span<const ContactBlock> blocks, std::span<const double> scalars, double enough);
  static double share_of(const ContactBlock& block, const Mat6& k, double fine);
  std::vector<double> by_matrices(std::span<const ContactBlock> blocks, std::span<const Mat6> stiffness) const;
  void add_joints();

  const Model& model_;
  State& state_;
  const StepRange range_;
  std::vector<Spring> springs_;  // of the last update
};

}  // namespace erbs
