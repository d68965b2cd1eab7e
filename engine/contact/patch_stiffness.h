// What the patch of a touching pair resists with: springs kn over it along its normal, ks across it and about its normal.
#pragma once
#include "engine/contact/overlap.h"
#include "engine/model/pair.h"

namespace erbs {

// Stiffness against motions of one block with the other held: N/m, N, N m; world axes, about the block's centroid.
struct PatchStiffness {
  Mat6 on_a, on_b;
};

// As `pair` lies now; false if the bodies do not overlap. The springs of friction are those of the pair's memory, which keeps the
// largest patch seen. Of the pair only `corners` may change.
bool patch_stiffness(Pair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, OverlapRoom& room,
                     PatchStiffness& out);

}  // namespace erbs
