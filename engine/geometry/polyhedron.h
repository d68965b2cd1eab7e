// Convex polyhedron: the shape of a part of a block.
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
using Parts = Shared<Polyhedron>;  // the convex parts of one rigid block

// Plane n.x = d; n is a unit vector and points outward.
struct Plane {
  Vec3 n;
  double d;  // m
};

// Axis-parallel box.
struct Box {
  Vec3 low, high;  // m
};

// Convex hull. Coplanar triangles are merged into one face; points on faces and edges are dropped. Throws Error if the points span no
// volume.
Polyhedron hull(const std::vector<Vec3>& points);

// Face planes, in the order of the faces.
std::vector<Plane> planes(const Polyhedron& p);
Plane face_plane(const Polyhedron& p, int face);

// Describes the first defect of p (not a number, degenerate, not closed, inverted, not planar, not convex); empty for a valid body.
std::string problem_of(const Polyhedron& p);

// Moves each face plane outward by its own offset (m, may be negative) and recomputes the vertices. Faces keep their order; a face
// that vanishes is dropped. Throws Error if no body is left.
Polyhedron grown(const Polyhedron& p, const std::vector<double>& offsets);

Polyhedron translated(const Polyhedron& p, const Vec3& by);
// x -> q x + by
Polyhedron transformed(const Polyhedron& p, const Quat& q, const Vec3& by);
Box bounding_box(const Polyhedron& p);
Vec3 mean_vertex(const Polyhedron& p);
double smallest_edge(const Polyhedron& p);  // m
// Smallest distance (m) between two parallel planes that enclose p, over its face normals.
double thickness(const Polyhedron& p);
double thickness(const Parts& parts);  // m, the same of all parts together, across one of their faces
// An axis-parallel box with the given corners.
Polyhedron box_polyhedron(const Vec3& low, const Vec3& high);

}  // namespace erbs
