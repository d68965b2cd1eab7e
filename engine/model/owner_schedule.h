// Owner-computes schedule of intact joints. A joint is evaluated in the lane of the block that owns it (joint_packs.h). Two quantities
// cross lanes: the displacement of its other block, and its force on that block. A Crossing is the gather table of one such read. A group
// of eight blocks evaluates its own joints in rounds, one joint per block, and gathers the forces of other joints in rounds. The order of a
// block's joints is free: the schedule fills each round so that its eight lanes read few records.
#pragma once
#include <vector>

#include "engine/model/joint_pack.h"

namespace erbs {

struct Model;

struct OwnerSchedule {
  std::vector<int> first_pack;     // first batch of each group of blocks                    [groups + 1]
  std::vector<int> joint;          // joint in each lane of a batch; -1: none                [batches * lanes]
  std::vector<int> lane;           // batch * lanes + lane of each joint                     [njoint]
  std::vector<GatherTable> other;  // gathers the other blocks of a batch from KernelCache::increment  [batches]
  // Forces of joints on blocks that do not own them, in KernelCache::neighbour_force: gather tables of each group of moving blocks.
  std::vector<int> first_gather;  //                                                        [groups + 1]
  std::vector<GatherTable> gather_in;
  // The same for each single block: positions in KernelCache::neighbour_force, in doubles.
  std::vector<int> first_end;  //                                                        [nblock + 1]
  std::vector<int> end;
};

OwnerSchedule make_owner_schedule(const Model& model);  // after `choose_owners`

}  // namespace erbs
