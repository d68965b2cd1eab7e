// A convex polyhedron: what a block is made of.
#pragma once
#include <string>
#include <vector>

#include "engine/base/shared.h"
#include "engine/base/vec.h"

namespace erbs {

using Faces = Shared<std::vector<int>>;  // vertex loops, counter-clockwise seen from outside

struct Polyhedron {
  std::vector<Vec3> vertices;  // m [nv]
  Faces faces;                 // [nf]
};
using Parts = Shared<Polyhedron>;  // convex, of one rigid block

// Plane n.x = d, n unit and outward.
struct Plane {
  Vec3 n;
  double d;  // m
};

// Axis-parallel box.
struct Box {
  Vec3 low, high;  // m
};

// The convex hull; coplanar triangles are merged to one face, points on faces and edges are dropped. Throws Error where the
// points span no volume.
Polyhedron hull(const std::vector<Vec3>& points);

// One plane a face, in the order of the faces.
std::vector<Plane> planes(const Polyhedron& p);
Plane face_plane(const Polyhedron& p, int face);

// What is wrong with p in words (not a number, degenerate, not closed, inverted, not planar, not convex); empty where it is sound.
std::string problem_of(const Polyhedron& p);

// Each face plane moved outwards by its own offset (m, may be negative), vertices recomputed. Faces keep their order; a face
// that vanishes is dropped. Throws Error where nothing is left.
Polyhedron grown(const Polyhedron& p, const std::vector<double>& offsets);

Polyhedron translated(const Polyhedron& p, const Vec3& by);
// x -> q x + by
Polyhedron transformed(const Polyhedron& p, const Quat& q, const Vec3& by);
Box bounding_box(const Polyhedron& p);
Vec3 mean_vertex(const Polyhedron& p);
double smallest_edge(const Polyhedron& p);  // m
// Smallest distance between two parallel planes that hold p, over its face normals (m).
double thickness(const Polyhedron& p);
// An axis-parallel box with the given corners.
Polyhedron box_polyhedron(const Vec3& low, const Vec3& high);

}  // namespace erbs
