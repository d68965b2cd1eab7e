// Friction of a patch that is a point or that nothing presses: the cases that the return map of `friction_law.h` leaves out.
#pragma once
#include "engine/contact/law/pair_lanes.h"

namespace erbs {

// Limits the springs and the dashpots of the pair in lane `l`, which `return_map()` left with `holds` 0. A point transmits no torsion.
void return_point(PairPack& w, int l);
void return_point(OnePair& w);

}  // namespace erbs
