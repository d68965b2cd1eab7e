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

// Integrals of Mirtich, "Fast and accurate computation of polyhedral mass properties", J. Graphics Tools 1(2), 1996, summed over
// tetrahedra from the mean of the vertices. The body is shifted there first, so that 1e4 m from the origin costs no digits.
MassProperties mass_properties(const Polyhedron& p);
// The same of one rigid body that consists of several convex parts without overlap.
MassProperties mass_properties(const std::vector<Polyhedron>& parts);

}  // namespace erbs
