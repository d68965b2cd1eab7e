// Sound joints in the lanes of the blocks that keep them (batches.h), and what crosses over from lane to lane: the other block's
// displacements, and what the joint does to that block. Groups of eight blocks go through the joints they keep in rounds, and through what
// others do to them; every block may take its own in any order, so they are dealt such that eight lanes side by side read few records.
#pragma once
#include <vector>

#include "engine/model/joint_batch.h"

namespace erbs {

struct Model;

struct KeptLanes {
  std::vector<int> first_batch;  // of each group of blocks                                [groups + 1]
  std::vector<int> joint;        // in each lane of a batch; -1: none                      [batches * lanes]
  std::vector<int> lane;         // batch * lanes + lane                                   [njoint]
  std::vector<Crossing> other;   // where State::shift has the other blocks of a batch     [batches]
  // where State::given has what joints do to blocks that do not keep them: to a group of moving ones, ...
  std::vector<int> first_taken;  //                                                        [groups + 1]
  std::vector<Crossing> taken;
  // ... and to any one of them, in doubles
  std::vector<int> first_end;  //                                                        [nblock + 1]
  std::vector<int> end;
};

KeptLanes deal_lanes(const Model& model);  // after choose_keepers

}  // namespace erbs
