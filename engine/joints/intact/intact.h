// Intact joints as the step reads them: in world axes and without points. All data follow from the reference poses.
//
// Owner computes: each joint is evaluated in the lane of the block that owns it (`Joint::owned_by_b`). The displacements of eight blocks
// are read once for all joints that they own. Forces on the owners are summed in registers (`KernelCache::owner_sum`); forces on the
// neighbours are stored in the lanes of the joints (`KernelCache::neighbour_force`).
#pragma once
#include <atomic>
#include <cstring>
#include <memory>
#include <set>
#include <vector>

#include "engine/base/system/team.h"
#include "engine/base/system/wide_pages.h"
#include "engine/joints/joint_forces.h"
#include "engine/joints/kernels.h"

namespace erbs {

// Copies lane `from` of `pack` to lane `to` of `out` and of its `law`, seen from the other end if `from_b`; empties a lane.
void set_intact_lane(const JointPack& pack, int from, IntactPack& out, IntactConstants& law, int to, bool from_b = false);
void clear_intact_lane(IntactPack& out, IntactConstants& law, int lane);

class IntactJoints {
 public:
  IntactJoints(const Model& model, State& state);
  void update_reference(const std::vector<std::uint8_t>& outdated);  // updates the joints of blocks with a new reference pose
  void leave(int j);                                                 // removes a joint that has cracked
  // Forces of the joints that these groups of eight blocks own. Joints near a limit are evaluated point by point (`response.h`);
  // joints that crack continue in `cracked.h`. `sums`: one per chunk of `grain` groups; fills their `energy.elastic` if `sample`.
  static constexpr int grain = 2;
  void forces(Range groups, bool sample, std::vector<JointSums>& sums);
  // Packs of intact joints with dashpots (`joint_forces.h`); empty if there are none.
  const std::vector<JointPack>& damped() const { return damped_; }
  // The forces alone, by the arithmetic of `kernels`. Returns the number of packs that may be near a limit.
  int forces(int first, int last, const StepKernels& kernels, double* stored);
  int groups() const { return pack_.empty() ? 0 : int(model_.owner_schedule.first_pack.size()) - 1; }

 private:
  void set_pack(int k);
  void joints_in_slots(int k, int joints[pack_size]) const;  // -1: none, or a cracked joint
  void check_points(int k, bool sample, JointSums& sums);
  void replace_by_cracked(int j, const JointPack& pack, const ElasticPack& before, const ElasticPack& now);

  const Model& model_;
  State& state_;
  const double carried_;  // as in `CornerCheck`, like `ahead_`
  int ahead_ = 0;
  std::vector<IntactPack, WidePages<IntactPack>> pack_;  // empty with dashpots or another kernel
  struct Bytes {
    bool operator()(const IntactConstants& a, const IntactConstants& b) const { return std::memcmp(&a, &b, sizeof(IntactConstants)) < 0; }
  };
  std::set<IntactConstants, Bytes> law_;  // each once
  std::vector<JointPack> damped_;
  std::vector<int> owned_;      // number of intact joints that each group of blocks owns; -1: none, and their sums are zero
  bool all_owned_ = true;       // no group has lost its last intact joint
  std::vector<int> may_yield_;  // packs that may be near a limit; each call writes from the first pack of its groups on
  // Packs already evaluated point by point; some laws need this in every step. Each belongs to one thread. Null if its lanes have changed.
  std::vector<std::unique_ptr<JointPack>> checked_;
  std::atomic<bool> any_checked_ = false;       // true if there are any
  std::vector<const JointPack*> corner_check_;  // the same for the kernel
};

// Adapts a state that another kernel has advanced. Sums of the owner schedule, or wrench rows that it does not write, must not act; pose
// rows may be out of date where this kernel reads them.
void forget_other_kernel(const Model& model, State& state);

}  // namespace erbs
