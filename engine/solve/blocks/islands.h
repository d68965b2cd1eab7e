// Islands of joined blocks, for reference poses, mass damping and loose blocks.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Recomputes island, grounded and joined from the joints not yet released to contact.
void find_islands(const Model& model, State& state);

// Acts once a block has rotated beyond `KernelCache::lazy_rotation` since its reference pose. The present pose becomes the reference of
// this block, and of all blocks rotated half as far, so that not every step finds another one. Returns true in this case, with 1 in
// `outdated` [nblock + 1] for these blocks; the caller then updates the geometry of their joints.
bool take_outdated_poses(const Model& model, State& state, std::vector<std::uint8_t>& outdated);

}  // namespace erbs
