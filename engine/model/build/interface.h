// Interfaces: faces of different blocks that face each other at rest, and become joints.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/polyhedron.h"
#include "engine/scene/scene.h"

namespace erbs {

inline constexpr double most_overlap = 1e-3;  // of the smaller edge: a deeper overlap is a mistake, unless the scene allows it

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
  std::vector<Vec3> polygon;  // m, overlap, midway between the faces; world axes at rest, counter-clockwise about normal
  Vec3 normal;                // unit, from a to b
  double gap;                 // m, mean distance of the faces at rest; negative: overlap
  double area;                // m2
  int rule;                   // index of the joint rule
};

// Two blocks that overlap at rest.
struct Overlap {
  int a, b;
  double depth;     // m, the smallest shift that separates them
  double relative;  // relative to the smallest edge of both
};

// Two blocks without a joint whose faces face each other across a gap that is too wide for their rule.
struct Unjoined {
  int a, b;
  double gap;  // m, the smallest
  int rule;
};

struct Interfaces {
  std::vector<Interface> all;  // sorted by (a, b, part_a, part_b, face_a, face_b)
  // sorted by (a, b); gaps up to two thicknesses (at least 30 mm) beyond the widest joint, at most a quarter of the smaller edge beyond it
  std::vector<Unjoined> unjoined;
  std::vector<Overlap> overlaps;  // relative depth above 1e-6, sorted by (a, b)
  bool cut = false;               // too many overlaps: the search was stopped
};

// Finds all interfaces. The last rule that matches a pair of groups wins. Pairs without a rule, pairs whose rule is none = true, and pairs
// of fixed blocks have no interface. Two faces are joined if their normals are opposite within 1e-3 rad and their gap lies in a range. The
// range begins at -`overlap` of the smaller edge (or at -tolerance, if that is lower) and ends at thickness + tolerance. A joint that the
// masonry of both blocks widened counts as one of ordinary width.
// Hundreds of blocks inside each other make pairs by the square of their number. The search stops after `most_deep` pairs that overlap by
// more than most_overlap.
Interfaces find_interfaces(std::span<const InterfaceBlock> blocks, std::span<const JointRule> rules, double overlap = 0.05,
                           std::size_t most_deep = 1000000);

}  // namespace erbs
