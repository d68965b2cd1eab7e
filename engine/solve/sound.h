// Intact joints as the step reads them: in world axes and without points. All data follow from the reference poses.
//
// Owner computes: each joint is evaluated in the lane of the block that owns it (`Joint::kept_by_b`). The displacements of eight blocks are
// read once for all joints that they own. Forces on the owners are summed in registers (`State::kept`); forces on the neighbours are stored
// in the lanes of the joints (`State::given`).
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

// Copies lane `from` of `batch` to lane `to` of `out` and of its `law`, seen from the other end if `turned`; empties a lane.
void set_sound_lane(const JointBatch& batch, int from, SoundBatch& out, SoundLaw& law, int to, bool turned = false);
void clear_sound_lane(SoundBatch& out, SoundLaw& law, int lane);

class Sound {
 public:
  Sound(const Model& model, State& state);
  void refresh(const std::vector<std::uint8_t>& stale);  // updates the joints of blocks with a new reference pose
  void leave(int j);                                     // removes a joint that has cracked
  // Forces of the joints that these groups of eight blocks own. Joints near a limit are evaluated point by point (`joint_response.h`);
  // joints that crack continue in `cracked.h`. `sums`: one per chunk of `grain` groups; fills their `energy.elastic` if `sample`.
  static constexpr int grain = 2;
  void forces(Range groups, bool sample, std::vector<JointSums>& sums);
  // Packs of intact joints with dashpots (`joint_kernel.h`); empty if there are none.
  const std::vector<JointBatch>& damped() const { return damped_; }
  // The forces alone, by the arithmetic of `kernels`. Returns the number of packs that may be near a limit.
  int forces(int first, int last, const LaneKernels& kernels, double* stored);
  int groups() const { return batch_.empty() ? 0 : int(model_.kept.first_batch.size()) - 1; }

 private:
  void set_lanes(int k);
  void joints_in_place(int k, int joints[lanes]) const;  // -1: none, or a cracked joint
  void look_closer(int k, bool sample, JointSums& sums);
  void take_over(int j, const JointBatch& batch, const JointLanes& before, const JointLanes& now);

  const Model& model_;
  State& state_;
  const double carried_;  // as in `SoundCloser`, like `ahead_`
  int ahead_ = 0;
  std::vector<SoundBatch, WidePages<SoundBatch>> batch_;  // empty with dashpots or another kernel
  struct Bytes {
    bool operator()(const SoundLaw& a, const SoundLaw& b) const { return std::memcmp(&a, &b, sizeof(SoundLaw)) < 0; }
  };
  std::set<SoundLaw, Bytes> law_;  // each once
  std::vector<JointBatch> damped_;
  std::vector<int> held_;  // number of intact joints that each group of blocks owns; -1: none, and their sums are zero
  bool all_held_ = true;   // no group has lost its last intact joint
  std::vector<int> near_;  // packs that may be near a limit; each call writes from the first pack of its groups on
  // Packs already evaluated point by point; some laws need this in every step. Each belongs to one thread. Null if its lanes have changed.
  std::vector<std::unique_ptr<JointBatch>> looked_at_;
  std::atomic<bool> closely_ = false;      // true if there are any
  std::vector<const JointBatch*> closer_;  // the same for the kernel
};

// Adapts a state that another kernel has advanced. Sums of the owner schedule, or wrench rows that it does not write, must not act; pose
// rows may be out of date where this kernel reads them.
void forget_other_kernel(const Model& model, State& state);

}  // namespace erbs
