// Signed gap of two convex polyhedra.
#pragma once
#include "engine/geometry/polyhedron.h"

namespace erbs {

struct Separation {
  double gap = 0;             // m; negative: the least shift that parts them (penetration depth)
  Vec3 axis = Vec3::UnitX();  // unit, from a to b
};

// Greatest gap over the separating axes (face normals of both, cross products of edges). Exact for overlap and for
// face-vertex and edge-edge distances; a lower bound of the distance where a vertex or an edge end is nearest to a vertex.
// `enough`: stop at the first axis that shows a larger gap than this.
Separation separation(const Polyhedron& a, const Polyhedron& b, double enough = 1e300);

}  // namespace erbs
