// A convex polyhedron: what a block is made of.
#pragma once
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

struct Polyhedron {
  std::vector<Vec3> vertices;           // m                                               [nv]
  std::vector<std::vector<int>> faces;  // vertex loops, counter-clockwise seen from outside [nf]
};

// Plane n.x = d, n unit and outward.
struct Plane {
  Vec3 n;
  double d;  // m
};

}  // namespace erbs
