// Faces of different blocks that face each other at rest: the places of joints.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/polyhedron.h"
#include "engine/scene/scene.h"

namespace erbs {

inline constexpr double most_overlap = 1e-3;  // of the smaller edge: more is a mistake, unless the scene says that it is none

struct InterfaceBlock {
  std::span<const Polyhedron> parts;  // m, world axes at rest
  std::string_view group;
  bool fixed = false;
  double joint = 0, widest_joint = 0;  // m, as in Block
};

struct Interface {
  int a, b;                   // blocks, a < b
  int part_a, part_b;         // parts of the blocks
  int face_a, face_b;         // faces of the parts
  std::vector<Vec3> polygon;  // m, overlap on the surface midway between the faces, world axes at rest, counter-clockwise about normal
  Vec3 normal;                // unit, from a to b
  double gap;                 // m, mean distance of the faces at rest; negative where they overlap
  double area;                // m2
  int rule;                   // index of the joint rule
};

// Two blocks that overlap at rest.
struct Overlap {
  int a, b;
  double depth;     // m, the least shift that parts them
  double relative;  // of the smallest edge of both
};

// Two blocks with faces that face each other across a gap wider than their rule joins; they have no joint.
struct Unjoined {
  int a, b;
  double gap;  // m, the smallest
  int rule;
};

struct Interfaces {
  std::vector<Interface> all;     // sorted by (a, b, part_a, part_b, face_a, face_b)
  // sorted by (a, b); gaps up to three thicknesses or 30 mm beyond one, a quarter of the smaller edge at most
  std::vector<Unjoined> unjoined;
  std::vector<Overlap> overlaps;  // relative depth above 1e-6, sorted by (a, b)
  bool cut = false;               // there were too many overlaps: the search was not ended
};

// The last rule that matches a pair of groups wins; pairs without a rule, pairs whose rule says none, and pairs of fixed blocks
// have no interface. Faces count as facing where their normals are opposite within 1e-3 rad and their gap lies between
// -`overlap` of the smaller edge (or the rule's tolerance, if larger) and thickness + tolerance; a joint that the masonry of both blocks
// made wider counts as one of its ordinary width. Blocks that lie in each other by the
// hundred have pairs by the square of that: after `most_deep` pairs that overlap by more than most_overlap the search ends.
Interfaces find_interfaces(std::span<const InterfaceBlock> blocks, std::span<const JointRule> rules, double overlap = 0.05,
                           std::size_t most_deep = 1000000);

}  // namespace erbs
