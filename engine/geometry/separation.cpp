#include "engine/geometry/separation.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace erbs {
namespace {

// Smallest and largest n.x over the vertices, relative to `origin`: then 1e4 m from the origin costs no digits.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
};

Range range(const Polyhedron& p, const Vec3& n, const Vec3& origin) {
  Range r;
  for (const Vec3& v : p.vertices) {
    const double d = n.dot(v - origin);
    r.low = std::min(r.low, d);
    r.high = std::max(r.high, d);
  }
  return r;
}

// False if the signed gap of a and b along n cannot exceed `depth` (m). For bodies that penetrate each other a few vertices decide.
bool may_part(const Polyhedron& a, const Polyhedron& b, const Vec3& n, const Vec3& origin, double depth) {
  Range ra, rb;
  const auto take = [&](const Vec3& v, Range& r) {
    const double d = n.dot(v - origin);
    r.low = std::min(r.low, d), r.high = std::max(r.high, d);
  };
  for (std::size_t i = 0; i < std::max(a.vertices.size(), b.vertices.size()); ++i) {
    take(a.vertices[std::min(i, a.vertices.size() - 1)], ra);
    take(b.vertices[std::min(i, b.vertices.size() - 1)], rb);
    if (std::max(rb.low - ra.high, ra.low - rb.high) <= depth) return false;
  }
  return true;
}

std::vector<Vec3> edge_directions(const Polyhedron& p) {
  std::vector<Vec3> all;
  for (const auto& f : p.faces) {
    for (std::size_t i = 0; i < f.size(); ++i) {
      const int a = f[i], b = f[(i + 1) % f.size()];
      if (a > b) continue;
      const Vec3 e = (p.vertices[static_cast<std::size_t>(b)] - p.vertices[static_cast<std::size_t>(a)]).normalized();
      if (std::none_of(all.begin(), all.end(), [&](const Vec3& o) { return o.cross(e).squaredNorm() < 1e-16; })) all.push_back(e);
    }
  }
  return all;
}

}  // namespace

Separation separation(const Polyhedron& a, const Polyhedron& b, double enough) {
  const Vec3 origin = a.vertices[0];
  Separation best;
  best.gap = -std::numeric_limits<double>::infinity();
  auto better = [&](double gap, const Vec3& axis) {
    if (gap > best.gap) best = {gap, axis};
    return best.gap > enough;
  };
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    const Vec3 n = face_plane(a, static_cast<int>(f)).n;
    if (better(range(b, n, origin).low - range(a, n, origin).high, n)) return best;
  }
  for (std::size_t f = 0; f < b.faces.size(); ++f) {
    const Vec3 n = face_plane(b, static_cast<int>(f)).n;
    if (better(range(a, n, origin).low - range(b, n, origin).high, -n)) return best;
  }
  const std::vector<Vec3> ea = edge_directions(a), eb = edge_directions(b);
  for (const Vec3& s : ea) {
    for (const Vec3& t : eb) {
      const Vec3 c = s.cross(t);
      const double length = c.norm();
      if (length < 1e-6) continue;  // parallel edges: a face normal covers this case
      const Vec3 n = c / length;
      if (!may_part(a, b, n, origin, best.gap)) continue;
      const Range ra = range(a, n, origin), rb = range(b, n, origin);
      // Prefer a face normal if its gap is the same up to round-off.
      const double ab = rb.low - ra.high, ba = ra.low - rb.high, prefer = 1e-12 * (ra.high - ra.low);
      if (std::max(ab, ba) - prefer > best.gap && better(std::max(ab, ba), ab > ba ? n : Vec3(-n))) return best;
    }
  }
  return best;
}

}  // namespace erbs
