// Poses of the blocks as contacts see them, and conservative bounds on their motion. Each block's travel is accumulated, and a separated
// pair is tested again only when the two travels could have closed its gap (`ContactState::separation`).
#pragma once
#include <vector>

#include "engine/model/state.h"
#include "engine/solve/contacts/bodies.h"
#include "engine/solve/contacts/sleep.h"

namespace erbs {

class MotionBounds {
 public:
  static constexpr double round_off = 1e-9;  // margin, as a share of distance and travel: above the round-off of sums over some 1e6 steps
  struct PairBound {
    int a = 0, b = 0;
    double until = 0;  // m; no test while `travel_ahead_[a] + travel_ahead_[b] < until`
  };

  MotionBounds(const Model& model, State& state, ContactBodies& bodies, int threads);
  void initialise();
  void list_pairs();                // after the list of pairs has changed
  void select(const Sleep& sleep);  // the blocks that need a pose in every step
  // The blocks that need one in the middle of a macro step: those of the live pairs `fast`.
  void select_fast(const std::vector<int>& fast);
  // Updates the poses of blocks [first, last) after their drift; each thread has its own range. `within`: the next step is within a macro
  // step, so that only blocks of fast pairs need it.
  void track(int thread, int first, int last, bool within);
  // The remaining poses before the forces of a step; of all `involved` blocks if `unsorted`. True if a block travels far in few steps.
  bool prepare(const std::vector<int>& involved, bool unsorted);
  void prepare_substep();  // the same within a macro step
  // Sets poses within a macro step without a change of the State: travel is that of the blocks of fast pairs alone, in a resumed run too.
  void place(const std::vector<int>& blocks);
  // Updates the poses of all blocks; those asleep keep their pose if `sleep` is given.
  void update_all(const Sleep* sleep);

  const PairBound& pair(int i) const { return pair_bounds_[std::size_t(i)]; }
  // True if the travel of both blocks is within the bound of the pair's last test.
  bool waits(int i) const {
    const PairBound& one = pair(i);
    return travel_ahead_[std::size_t(one.a)] + travel_ahead_[std::size_t(one.b)] < one.until;
  }
  // True if a separated pair needs no evaluation: the travel of its two blocks since the last one cannot have closed the gap.
  bool surely_separated(int i);
  void note_separation(int i, double distance);               // after an evaluation; m, 0 if unknown
  double spin(int b) const { return spin_[std::size_t(b)]; }  // m/s, speed of the farthest point by rotation
  double fastest_pair() const { return fastest_pair_; }       // m/s, upper bound of the speed of approach of any two blocks

 private:
  static constexpr int update_every = 16;  // steps between two updates of all poses, unless some block travels far in that time
  // A group of eight blocks and the selected ones among them.
  struct BlockGroup {
    int group;
    unsigned which;
    double is_in[pack_size] = {};  // 1 for a selected block, else 0
  };
  struct alignas(64) MaxSpeed {
    double speed[pack_size] = {};  // m/s, greatest over many groups, lane by lane
  };
  static void add_to_group(std::vector<BlockGroup>& groups, int b);
  void update(BlockGroup blocks, MaxSpeed& fastest);

  const Model& model_;
  State& state_;
  ContactBodies& bodies_;
  std::vector<BlockGroup> awake_;              // involved blocks that are awake
  std::vector<BlockGroup> placed_;             // moving ones among the blocks of live pairs
  std::vector<BlockGroup> driven_;             // driven ones among these; no drift moves them
  std::vector<BlockGroup> fast_;               // moving ones among the blocks of fast pairs
  std::vector<PairBound> pair_bounds_;         // per pair
  std::vector<VectorPack<3>> last_u_;          // m, displacements at the last update of the pose, by groups of eight as in State
  std::vector<double> spin_;                   // m/s, speed of each block's farthest point by rotation; whole groups
  std::vector<double> travel_, travel_ahead_;  // m, travel of each block; the same with the next steps (`BlockPosePack`)
  std::vector<double> fastest_loose_;          // m2/s2, greatest squared speed of an involved block, per thread
  std::vector<MaxSpeed> fastest_;              // m/s, of the blocks that each thread has updated
  double fastest_pair_ = 0;
};

}  // namespace erbs
