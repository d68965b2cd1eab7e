#include "engine/geometry/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/error.h"

namespace erbs {
namespace {

using std::size_t;

int count(size_t n) { return static_cast<int>(n); }

// Newell's normal, of length twice the area; robust for slightly warped loops.
Vec3 loop_normal(const std::vector<Vec3>& v, const std::vector<int>& loop) {
  Vec3 n = Vec3::Zero();
  const Vec3& origin = v[z(loop[0])];
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 p = v[z(loop[i])] - origin;
    const Vec3 q = v[z(loop[(i + 1) % loop.size()])] - origin;
    n += p.cross(q);
  }
  return n;
}

double size_of(const std::vector<Vec3>& v) {
  Vec3 low = v[0], high = v[0];
  for (const Vec3& p : v) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

// Signed volume, summed over tetrahedra from the first vertex.
double signed_volume(const Polyhedron& p) {
  double six = 0;
  const Vec3 o = p.vertices[0];
  for (const auto& f : p.faces) {
    for (size_t i = 1; i + 1 < f.size(); ++i) {
      const Vec3 a = p.vertices[z(f[0])] - o, b = p.vertices[z(f[i])] - o, c = p.vertices[z(f[i + 1])] - o;
      six += a.dot(b.cross(c));
    }
  }
  return six / 6;
}

}  // namespace

Plane face_plane(const Polyhedron& p, int face) {
  const auto& loop = p.faces[z(face)];
  const Vec3 n = loop_normal(p.vertices, loop).normalized();
  double d = 0;
  for (int v : loop) d += n.dot(p.vertices[z(v)]);
  return {n, d / static_cast<double>(loop.size())};
}

std::vector<Plane> planes(const Polyhedron& p) {
  std::vector<Plane> result;
  result.reserve(p.faces.size());
  for (size_t f = 0; f < p.faces.size(); ++f) result.push_back(face_plane(p, count(f)));
  return result;
}

namespace {

std::string problem_of_faces(const Polyhedron& p, double size) {
  const int nv = count(p.vertices.size());
  std::map<std::pair<int, int>, int> edges;
  for (size_t f = 0; f < p.faces.size(); ++f) {
    const auto& loop = p.faces[f];
    if (loop.size() < 3) return fmt::format("face {} has {} vertices, at least 3 are needed", f + 1, loop.size());
    for (size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      if (a < 0 || a >= nv) return fmt::format("face {} names vertex {}, there are {}", f + 1, a + 1, nv);
      if (b < 0 || b >= nv) return fmt::format("face {} names vertex {}, there are {}", f + 1, b + 1, nv);
      if (a == b) return fmt::format("face {} names vertex {} twice in a row", f + 1, a + 1);
      ++edges[{a, b}];
    }
    if (loop_normal(p.vertices, loop).norm() < 1e-12 * size * size) return fmt::format("face {} has no area", f + 1);
  }
  for (const auto& [edge, n] : edges) {
    if (n > 1) {
      return fmt::format(
          "the edge of vertices {} and {} is passed twice in the same direction: a face is turned inside out, or two faces coincide",
          edge.first + 1, edge.second + 1);
    }
    if (!edges.count({edge.second, edge.first})) {
      return fmt::format("the surface is not closed at the edge of vertices {} and {}", edge.first + 1, edge.second + 1);
    }
  }
  return "";
}

}  // namespace

std::string problem_of(const Polyhedron& p) {
  for (size_t i = 0; i < p.vertices.size(); ++i) {
    if (!p.vertices[i].allFinite()) return fmt::format("vertex {} is not a number", i + 1);
  }
  if (p.vertices.size() < 4) return fmt::format("it has {} vertices, at least 4 are needed", p.vertices.size());
  if (p.faces.size() < 4) return fmt::format("it has {} faces, at least 4 are needed", p.faces.size());
  const double size = size_of(p.vertices);
  if (!(size > 0)) return "all its vertices coincide";
  if (std::string wrong = problem_of_faces(p, size); !wrong.empty()) return wrong;
  std::set<int> used;
  for (const auto& f : p.faces) used.insert(f.begin(), f.end());
  if (used.size() != p.vertices.size()) return "a vertex belongs to no face";
  const double volume = signed_volume(p);
  if (volume < -1e-12 * size * size * size) return "its faces are turned inside out (they must be counter-clockwise seen from outside)";
  if (volume < 1e-12 * size * size * size) return "it has no volume";
  const double tolerance = 1e-6 * size;
  for (size_t f = 0; f < p.faces.size(); ++f) {
    const Plane plane = face_plane(p, count(f));
    for (int v : p.faces[f]) {
      const double off = plane.n.dot(p.vertices[z(v)]) - plane.d;
      if (std::abs(off) > tolerance) return fmt::format("face {} is not plane: vertex {} is {:.3g} m off", f + 1, v + 1, off);
    }
    for (size_t v = 0; v < p.vertices.size(); ++v) {
      const double out = plane.n.dot(p.vertices[v]) - plane.d;
      if (out > tolerance) return fmt::format("it is not convex: vertex {} is {:.3g} m outside face {}", v + 1, out, f + 1);
    }
  }
  return "";
}

namespace {

// Rebuilds a body from its face planes: each face is a large square, cut by all other planes. Used if moved planes change the topology.
Polyhedron cut_from_planes(const std::vector<Plane>& all, double reach) {
  Polyhedron result;
  const double weld = 1e-9 * reach;
  auto vertex_index = [&](const Vec3& x) {
    for (size_t i = 0; i < result.vertices.size(); ++i) {
      if ((result.vertices[i] - x).norm() < weld) return count(i);
    }
    result.vertices.push_back(x);
    return count(result.vertices.size()) - 1;
  };
  for (size_t f = 0; f < all.size(); ++f) {
    const Vec3 n = all[f].n;
    const Vec3 t = n.unitOrthogonal(), s = n.cross(t), c = all[f].d * n;
    std::vector<Vec3> loop{c - reach * t - reach * s, c + reach * t - reach * s, c + reach * t + reach * s, c - reach * t + reach * s};
    for (size_t g = 0; g < all.size() && !loop.empty(); ++g) {
      if (g == f) continue;
      std::vector<Vec3> kept;
      for (size_t i = 0; i < loop.size(); ++i) {
        const Vec3 p = loop[i], q = loop[(i + 1) % loop.size()];
        const double dp = all[g].n.dot(p) - all[g].d, dq = all[g].n.dot(q) - all[g].d;
        if (dp <= 0) kept.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept.push_back(p + dp / (dp - dq) * (q - p));
      }
      loop = std::move(kept);
    }
    std::vector<int> ids;
    for (const Vec3& x : loop) {
      const int id = vertex_index(x);
      if (ids.empty() || (ids.back() != id && ids.front() != id)) ids.push_back(id);
    }
    if (ids.size() >= 3) result.faces.push_back(std::move(ids));
  }
  return result;
}

}  // namespace

Polyhedron grown(const Polyhedron& p, const std::vector<double>& offsets) {
  ERBS_ASSERT(offsets.size() == p.faces.size());
  const Vec3 centre = mean_vertex(p);
  const double size = size_of(p.vertices);
  std::vector<Plane> moved = planes(translated(p, -centre));
  for (size_t f = 0; f < moved.size(); ++f) moved[f].d += offsets[f];
  std::vector<std::vector<int>> around(p.vertices.size());
  for (size_t f = 0; f < p.faces.size(); ++f) {
    for (int v : p.faces[f]) around[z(v)].push_back(count(f));
  }
  // If three faces meet at every vertex (boxes, prisms), each new vertex is one 3x3 solve and the topology stays.
  Polyhedron result = p;
  bool same = true;
  for (size_t v = 0; v < p.vertices.size() && same; ++v) {
    same = around[v].size() == 3;
    if (!same) break;
    Mat3 a;
    Vec3 d;
    for (int i = 0; i < 3; ++i) {
      const Plane& plane = moved[z(around[v][z(i)])];
      a.row(i) = plane.n.transpose();
      d[i] = plane.d;
    }
    result.vertices[v] = a.partialPivLu().solve(d);
  }
  for (size_t v = 0; v < p.vertices.size() && same; ++v) {
    for (const Plane& plane : moved) same = same && plane.n.dot(result.vertices[v]) - plane.d < 1e-10 * size;
  }
  if (!same) {
    double reach = size;
    for (double o : offsets) reach += std::abs(o);
    result = cut_from_planes(moved, 4 * reach);
  }
  if (result.vertices.size() < 4) throw Error("nothing is left of a block after its faces were moved inwards; use smaller joints");
  return translated(result, centre);
}

Polyhedron translated(const Polyhedron& p, const Vec3& by) {
  Polyhedron r = p;
  for (Vec3& v : r.vertices) v += by;
  return r;
}

Polyhedron transformed(const Polyhedron& p, const Quat& q, const Vec3& by) {
  Polyhedron r = p;
  const Mat3 rotation = q.toRotationMatrix();
  for (Vec3& v : r.vertices) v = rotation * v + by;
  return r;
}

Box bounding_box(const Polyhedron& p) {
  Box b{p.vertices[0], p.vertices[0]};
  for (const Vec3& v : p.vertices) {
    b.low = b.low.cwiseMin(v);
    b.high = b.high.cwiseMax(v);
  }
  return b;
}

Vec3 mean_vertex(const Polyhedron& p) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : p.vertices) sum += v - p.vertices[0];
  return p.vertices[0] + sum / static_cast<double>(p.vertices.size());
}

double smallest_edge(const Polyhedron& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : p.faces) {
    for (size_t i = 0; i < f.size(); ++i) least = std::min(least, (p.vertices[z(f[i])] - p.vertices[z(f[(i + 1) % f.size()])]).norm());
  }
  return least;
}

double thickness(const Polyhedron& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes(p)) {
    double deepest = 0;
    for (const Vec3& v : p.vertices) deepest = std::max(deepest, plane.d - plane.n.dot(v));
    least = std::min(least, deepest);
  }
  return least;
}

double thickness(const Parts& parts) {
  if (parts.size() == 1) return thickness(parts[0]);
  double least = std::numeric_limits<double>::infinity();
  for (const Polyhedron& part : parts)
    for (const Plane& plane : planes(part)) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Polyhedron& other : parts)
        for (const Vec3& v : other.vertices) low = std::min(low, plane.n.dot(v)), high = std::max(high, plane.n.dot(v));
      least = std::min(least, high - low);
    }
  return least;
}

Polyhedron box_polyhedron(const Vec3& low, const Vec3& high) {
  Polyhedron p;
  p.vertices.reserve(8);
  for (int k = 0; k < 8; ++k) {
    p.vertices.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(), k & 4 ? high.z() : low.z());
  }
  static const Faces faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  p.faces = faces;
  return p;
}

}  // namespace erbs
