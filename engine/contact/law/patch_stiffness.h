// Stiffness of the patch of a touching pair: springs kn over the patch along its normal, ks across and about its normal.
#pragma once
#include "engine/contact/overlap/overlap.h"
#include "engine/model/contact_pair.h"

namespace erbs {

// Stiffness against motions of one block, the other fixed: N/m, N, N m; world axes, about the block's centroid.
struct PatchStiffness {
  Mat6 on_a, on_b;
};

// At the present pose of `pair`; false if the bodies do not overlap. The friction springs are those in the pair's memory, which has the
// largest patch so far. Of the pair only `corners` may change.
bool patch_stiffness(ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, OverlapRoom& room,
                     PatchStiffness& out);

}  // namespace erbs
