// Sound joints as the step reads them: world axes, no point of theirs. A function of the poses of the last refresh.
// Every joint is kept by one of its blocks (Joint::kept_by_b) and computed in that block's lane. So the displacements of eight blocks side
// by side are read once for all they keep, what acts on them is summed up in registers (State::kept), and what acts on the other blocks is
// left in the lanes of the joints (State::given).
#pragma once
#include <atomic>
#include <cstring>
#include <memory>
#include <set>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/wide_pages.h"
#include "engine/solve/joint_kernel.h"
#include "engine/solve/lanes.h"

namespace erbs {

// Lane `from` of `batch` as lane `to` of `out` and its `law`, seen from its other end where `turned`; a lane of no joint.
void set_sound_lane(const JointBatch& batch, int from, SoundBatch& out, SoundLaw& law, int to, bool turned = false);
void clear_sound_lane(SoundBatch& out, SoundLaw& law, int lane);

class Sound {
 public:
  Sound(const Model& model, State& state);
  void refresh(const std::vector<std::uint8_t>& stale);  // geometry of the joints of blocks whose reference has changed
  void leave(int j);                                     // a joint that has cracked
  // What the joints kept by these groups of eight blocks do to all. Those near a limit are looked at point by point
  // (joint_response.h); those that crack go on in cracked.h. `sums`: one for each chunk of `grain` groups of all; fills their
  // energy.elastic when `sample`.
  static constexpr int grain = 2;
  void forces(Range groups, bool sample, std::vector<JointSums>& sums);
  // Those of joints with dashpots (joint_kernel.h); empty where no sound joint has any.
  const std::vector<JointBatch>& damped() const { return damped_; }
  // The forces alone, by the arithmetic of `kernels`; how many batches may be near a limit.
  int forces(int first, int last, const LaneKernels& kernels, double* stored);
  int groups() const { return batch_.empty() ? 0 : int(model_.kept.first_batch.size()) - 1; }

 private:
  void set_lanes(int k);
  void joints_in_place(int k, int joints[lanes]) const;  // -1: none, or one that has cracked
  void look_closer(int k, bool sample, JointSums& sums);
  void take_over(int j, const JointBatch& batch, const JointLanes& before, const JointLanes& now);

  const Model& model_;
  State& state_;
  const double carried_;  // SoundCloser, and so is ahead_
  int ahead_ = 0;
  std::vector<SoundBatch, WidePages<SoundBatch>> batch_;  // one of the two: empty where nothing reads it
  struct Bytes {
    bool operator()(const SoundLaw& a, const SoundLaw& b) const { return std::memcmp(&a, &b, sizeof(SoundLaw)) < 0; }
  };
  std::set<SoundLaw, Bytes> law_;  // each once
  std::vector<JointBatch> damped_;
  std::vector<int> held_;  // of each group of blocks, sound joints that they keep; -1: none, and nothing left of them
  bool all_held_ = true;   // no group has lost its last one
  std::vector<int> near_;  // batches that may be near a limit, from the first batch of the groups looked at on
  // Batches that have been looked at: some laws want it in every step. Each is one thread's own. Null where lanes have changed since.
  std::vector<std::unique_ptr<JointBatch>> looked_at_;
  std::atomic<bool> closely_ = false;      // whether there are any
  std::vector<const JointBatch*> closer_;  // the same for the kernel
};

// A state that another kernel has brought to where it is holds what keepers summed up, or rows that they do not write: neither is to act.
// And rows of blocks may not have been written where they are read from now on.
void forget_other_kernel(const Model& model, State& state);

}  // namespace erbs
