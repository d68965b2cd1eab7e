// Signed gap of two convex polyhedra, by the separating-axis theorem.
#pragma once
#include "engine/geometry/polyhedron.h"

namespace erbs {

struct Separation {
  double gap = 0;             // m; negative: penetration depth, the smallest shift that separates them
  Vec3 axis = Vec3::UnitX();  // unit, from a to b
};

// Largest gap over the separating axes: face normals of both bodies, cross products of edges. It is exact for overlap and for face-vertex
// and edge-edge distances. If a vertex is nearest to a vertex or to an edge end, it is a lower bound of the distance.
// `enough`: stops at the first axis with a larger gap.
Separation separation(const Polyhedron& a, const Polyhedron& b, double enough = 1e300);

}  // namespace erbs
