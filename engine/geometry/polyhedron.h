// A convex polyhedron: what a block is made of.
#pragma once
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

// Vertex loops, counter-clockwise seen from outside [nf]. Copies share them until one is edited: all bricks have the same.
class Faces {
 public:
  using Loops = std::vector<std::vector<int>>;
  Faces() = default;
  Faces(Loops loops) : loops_(std::make_shared<Loops>(std::move(loops))) {}
  Faces(std::initializer_list<std::vector<int>> loops) : Faces(Loops(loops)) {}
  const Loops& loops() const;
  std::size_t size() const { return loops().size(); }
  bool empty() const { return loops().empty(); }
  const std::vector<int>& operator[](std::size_t i) const { return loops()[i]; }
  Loops::const_iterator begin() const { return loops().begin(); }
  Loops::const_iterator end() const { return loops().end(); }
  Loops& edit();  // of its own
  void push_back(std::vector<int> loop) { edit().push_back(std::move(loop)); }
  friend bool operator==(const Faces& a, const Faces& b) { return a.loops() == b.loops(); }

 private:
  std::shared_ptr<Loops> loops_;
};

struct Polyhedron {
  std::vector<Vec3> vertices;  // m [nv]
  Faces faces;
};

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
