// Driven supports that are lowered with what they bear. What rides on one has not fallen, as far as the support has been lowered below it;
// one that is drawn away faster than the block follows bears it no more.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Against the gravity of the scene, before any tilt{}; without gravity along z.
Vec3 upwards(const Model& model);
// m, of the centroid of a block.
double height_above_rest(const Model& model, const BlockPoses& pose, std::size_t b);

struct LoweredSupports {
  struct Ride {
    int block, bearer;
  };
  std::vector<Ride> ride;          // by block, of all that a driven block bears at rest, block upon block; not in a checkpoint
  std::vector<std::uint8_t> left;  // the support was once lower than the block by half its thickness, or the block has fallen [ride]

  // Looks for supports that have left their blocks. `start`: m, height of each block above rest at the start [nblock].
  void follow(const Model& model, const BlockPoses& pose, const std::vector<double>& start);
  void leave(int block);  // has fallen from all that bore it
  // m, of the support that has been lowered by most below a block.
  double lowered(const Model& model, const BlockPoses& pose, std::size_t b) const;
};

std::vector<LoweredSupports::Ride> rides_of(const Model& model);

}  // namespace erbs
