// The mechanism of a collapse in a word, from how the blocks move: overturning, sliding, crushing, hinges, shear.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/record/results/mechanism.h"

namespace erbs {

// Displacements of all blocks, or velocities on the same scale. [nblock]
struct BlockMotions {
  std::vector<Vec3> u;      // m
  std::vector<Vec3> theta;  // rad
};
BlockMotions motions_of(const BlockPoses& pose, int nblock);

struct NamedMechanism {
  std::string name;  // see name_mechanism(); "none" if nothing moves
  std::string text;  // a sentence, with the share of the mass that moves and where
  double moving_share = 0;
};

// `push`: unit vector of the load, horizontal. What moves is what moves by a fifth of the largest displacement, and
// what follows it as one body.
//   sliding                one body, with hardly any rotation or without any joint that opens
//   crushing               the same, downwards, where a law yields in compression
//   overturning            one body that turns about a level axis; "overturning out of plane" where it is a wall less than half as thick as
//                          wide, across which it falls; "overturning on a stepped crack" where its crack runs through bed and head joints
//   hinges                 several bodies that turn against each other; joints open at edges
//   shear                  several bodies that slide on each other: "shear along diagonal cracks" where bed and head joints take part
NamedMechanism name_mechanism(const Model& model, const BlockMotions& motions, const Mechanism& joints, const Vec3& push);

// What each wall does in it, by the groups of the blocks that are walls (half as thick as wide) and of which a tenth of the mass moves, in
// the order of their first blocks:
//   across the push   "overturning out of plane" as one body, "sliding", "bending out of plane" as several
//   along the push    "diagonal cracks" where a crack climbs through bed and head joints at 24 to 66 degrees, apart from beds that move
//                     from end to end of the wall; "sliding" or "rocking in plane" as one body, "shear" or "hinges" otherwise
using WallMechanism = std::pair<std::string, std::string>;  // group, what it does
std::vector<WallMechanism> wall_mechanisms(const Model& model, const BlockMotions& motions, const Mechanism& joints, const Vec3& push,
                                           const std::vector<std::string>& group);

}  // namespace erbs
