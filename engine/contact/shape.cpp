#include "engine/contact/shape.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/geometry/mass.h"

namespace erbs {
namespace {

// Two faces in one plane would both be the nearest face.
bool has_coplanar_faces(const std::vector<Plane>& faces, double size) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t g = 0; g < f; ++g) {
      if (faces[f].n.dot(faces[g].n) > 1 - 1e-14 && std::abs(faces[f].d - faces[g].d) < 1e-9 * size) return true;
    }
  }
  return false;
}

}  // namespace

ContactShape contact_shape(const Polyhedron& part) {
  const Box box = bounding_box(part);
  const double size = (box.high - box.low).norm();
  const Polyhedron p = has_coplanar_faces(planes(part), size) ? hull(part.vertices) : part;
  if (p.vertices.size() > std::size_t(most_vertices) || p.faces.size() > std::size_t(most_faces)) {
    throw Error(
        fmt::format("a block has {} vertices and {} faces; contact takes up to {} and {} per convex part: simplify the mesh or split it",
                    p.vertices.size(), p.faces.size(), most_vertices, most_faces));
  }
  ContactShape s;
  s.vertex = p.vertices;
  for (const Plane& plane : planes(p)) {
    s.normal.push_back(plane.n);
    s.offset.push_back(plane.d);
  }
  for (const auto& face : p.faces) {
    s.loop_first.push_back(static_cast<int>(s.loop.size()));
    std::uint64_t mask = 0;
    for (int v : face) mask |= std::uint64_t(1) << v;
    s.mask.push_back(mask);
    s.loop.insert(s.loop.end(), face.begin(), face.end());
  }
  s.loop_first.push_back(static_cast<int>(s.loop.size()));
  s.volume = mass_properties(p).volume;
  s.thickness = thickness(p);
  s.smallest_edge = smallest_edge(p);
  s.centre = (box.low + box.high) / 2;
  s.half = (box.high - box.low) / 2;
  for (const Vec3& v : p.vertices) {
    s.radius = std::max(s.radius, (v - s.centre).norm());
    s.reach = std::max(s.reach, v.norm());
  }
  return s;
}

ContactShapes contact_shapes(const std::vector<std::vector<Polyhedron>>& parts_of_blocks) {
  ContactShapes all;
  for (const auto& parts : parts_of_blocks) {
    all.first.push_back(static_cast<int>(all.shape.size()));
    for (const Polyhedron& p : parts) {
      all.block.push_back(static_cast<int>(all.first.size()) - 1);
      all.shape.push_back(contact_shape(p));
    }
  }
  all.first.push_back(static_cast<int>(all.shape.size()));
  return all;
}

}  // namespace erbs
