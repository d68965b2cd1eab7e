// Volume, centroid and inertia of polyhedra.
#pragma once
#include <vector>

#include "engine/geometry/polyhedron.h"

namespace erbs {

struct MassProperties {
  double volume = 0;             // m3
  Vec3 centroid = Vec3::Zero();  // m
  Mat3 inertia = Mat3::Zero();   // m5, about the centroid, per unit density, world axes
};

// The integrals of Mirtich, "Fast and accurate computation of polyhedral mass properties", J. Graphics Tools 1(2), 1996, taken
// over tetrahedra from a vertex (the body is shifted there first, so that 1e4 m from the origin costs no digits).
MassProperties mass_properties(const Polyhedron& p);
// One rigid body of several convex parts that do not overlap.
MassProperties mass_properties(const std::vector<Polyhedron>& parts);

}  // namespace erbs
