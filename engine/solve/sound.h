// Sound joints as the step reads them: world axes, no point of theirs. A function of the poses of the last refresh.
#pragma once
#include <memory>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/solve/joint_kernel.h"
#include "engine/solve/lanes.h"

namespace erbs {

// Lane `from` of `batch` as lane `to` of `out`; a lane of no joint.
void set_sound_lane(const JointBatch& batch, int from, SoundBatch& out, int to);
void clear_sound_lane(const Model& model, SoundBatch& out, int lane);

class Sound {
 public:
  Sound(const Model& model, State& state);
  void update(const std::vector<int>& joints);  // after a refresh of these
  void leave(int j);                            // a joint that has cracked
  // Writes the wrench rows of these batches. Joints near a limit are looked at point by point (joint_response.h); those that crack go on
  // in cracked.h. `sums`: one for each chunk of batch_grain batches of all; fills their energy.elastic when `sample`.
  void forces(Range batches, bool sample, std::vector<JointSums>& sums);
  // Those of joints with dashpots (joint_kernel.h); empty where no sound joint has any.
  const std::vector<JointBatch>& damped() const { return damped_; }
  // The wrench rows alone, by the arithmetic of `kernels`; how many batches may be near a limit, and which in `near`.
  int forces(int first, int last, const LaneKernels& kernels, double* stored, int* near);

 private:
  void look_closer(int k, bool sample, JointSums& sums);

  const Model& model_;
  State& state_;
  std::vector<SoundBatch> batch_;  // one of the two: empty where nothing reads it
  std::vector<JointBatch> damped_;
  // Batches that were looked at since their last refresh: some laws want it in every step. Each is one thread's own.
  std::vector<std::unique_ptr<JointBatch>> looked_at_;
};

}  // namespace erbs
