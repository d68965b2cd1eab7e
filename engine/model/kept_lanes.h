// Owner-computes schedule of intact joints. A joint is evaluated in the lane of the block that owns it (batches.h). Two quantities cross
// lanes: the displacement of its other block, and its force on that block. A Crossing is the gather table of one such read.
// A group of eight blocks evaluates its own joints in rounds, one joint per block, and gathers the forces of other joints in rounds. The
// order of a block's joints is free: the schedule fills each round so that its eight lanes read few records.
#pragma once
#include <vector>

#include "engine/model/joint_batch.h"

namespace erbs {

struct Model;

struct KeptLanes {
  std::vector<int> first_batch;  // first batch of each group of blocks                    [groups + 1]
  std::vector<int> joint;        // joint in each lane of a batch; -1: none                [batches * lanes]
  std::vector<int> lane;         // batch * lanes + lane of each joint                     [njoint]
  std::vector<Crossing> other;   // gathers the other blocks of a batch from State::shift  [batches]
  // Forces of joints on blocks that do not own them, in State::given: gather tables of each group of moving blocks.
  std::vector<int> first_taken;  //                                                        [groups + 1]
  std::vector<Crossing> taken;
  // The same for each single block: positions in State::given, in doubles.
  std::vector<int> first_end;  //                                                        [nblock + 1]
  std::vector<int> end;
};

KeptLanes deal_lanes(const Model& model);  // after `choose_keepers`

}  // namespace erbs
