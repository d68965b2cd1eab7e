// Convex hull of points: triangles are added point by point, then coplanar triangles are merged into faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/geometry/polyhedron.h"

namespace erbs {
namespace {

using std::size_t;

struct Triangle {
  std::array<int, 3> v;
  Vec3 n;    // unit
  double d;  // n.x = d
  double area;
};

Triangle triangle(const std::vector<Vec3>& x, int a, int b, int c) {
  const Vec3 cross = (x[z(b)] - x[z(a)]).cross(x[z(c)] - x[z(a)]);
  const double length = cross.norm();
  const Vec3 n = length > 0 ? Vec3(cross / length) : Vec3(Vec3::Zero());
  return {{a, b, c}, n, n.dot(x[z(a)]), length / 2};
}

// Four points that span a large tetrahedron, by a greedy search.
std::array<int, 4> first_tetrahedron(const std::vector<Vec3>& x, double eps) {
  const int n = static_cast<int>(x.size());
  auto farthest = [&](auto&& distance) {
    int best = 0;
    for (int i = 1; i < n; ++i) {
      if (distance(x[z(i)]) > distance(x[z(best)])) best = i;
    }
    return best;
  };
  const int a = farthest([&](const Vec3& p) { return (p - x[0]).norm(); });
  const int b = farthest([&](const Vec3& p) { return (p - x[z(a)]).norm(); });
  const Vec3 along = (x[z(b)] - x[z(a)]).normalized();
  const int c = farthest([&](const Vec3& p) { return (p - x[z(a)]).cross(along).norm(); });
  const Triangle base = triangle(x, a, b, c);
  const int d = farthest([&](const Vec3& p) { return std::abs(base.n.dot(p) - base.d); });
  if (base.area < eps * eps || std::abs(base.n.dot(x[z(d)]) - base.d) < eps) {
    throw Error("the points lie in one plane: they span no body; give points on both sides");
  }
  if (base.n.dot(x[z(d)]) - base.d > 0) return {a, c, b, d};
  return {a, b, c, d};
}

std::vector<Triangle> hull_triangles(const std::vector<Vec3>& x, double eps) {
  const auto [a, b, c, d] = first_tetrahedron(x, eps);
  std::vector<Triangle> hull{triangle(x, a, b, c), triangle(x, a, c, d), triangle(x, c, b, d), triangle(x, b, a, d)};
  for (int p = 0; p < static_cast<int>(x.size()); ++p) {
    std::map<std::pair<int, int>, bool> horizon;  // directed edges of the triangles visible from p
    std::vector<Triangle> kept;
    for (const Triangle& t : hull) {
      if (t.n.dot(x[z(p)]) - t.d <= eps) {
        kept.push_back(t);
        continue;
      }
      for (size_t i = 0; i < 3; ++i) horizon[{t.v[i], t.v[(i + 1) % 3]}] = true;
    }
    if (kept.size() == hull.size()) continue;
    for (const auto& [edge, seen] : horizon) {
      if (!horizon.count({edge.second, edge.first})) kept.push_back(triangle(x, edge.first, edge.second, p));
    }
    hull = std::move(kept);
  }
  return hull;
}

struct Flat {
  double x, y;
  int v;
};

// Points of a face in its own plane, relative to their mean; the axes (x, y, n) are right-handed.
std::vector<Flat> flattened(const std::vector<Vec3>& x, const Vec3& n, const std::vector<int>& face) {
  Vec3 mean = Vec3::Zero();
  for (int v : face) mean += x[z(v)] / static_cast<double>(face.size());
  const Vec3 e = n.unitOrthogonal(), f = n.cross(e);
  std::vector<Flat> flat;
  for (int v : face) flat.push_back({e.dot(x[z(v)] - mean), f.dot(x[z(v)] - mean), v});
  return flat;
}

// Marks the strict corners of a face: the monotone chain of Andrew 1979, once for each side.
void mark_corners(std::vector<Flat> flat, double eps, std::vector<bool>& corner) {
  std::sort(flat.begin(), flat.end(), [](const Flat& p, const Flat& q) { return std::make_pair(p.x, p.y) < std::make_pair(q.x, q.y); });
  for (int side = 0; side < 2; ++side) {
    std::vector<Flat> chain;
    for (const Flat& r : flat) {
      while (chain.size() > 1) {
        const Flat &p = chain[chain.size() - 2], &q = chain.back();
        const double orientation = (q.x - p.x) * (r.y - q.y) - (q.y - p.y) * (r.x - q.x);
        if (orientation > eps * std::hypot(r.x - p.x, r.y - p.y)) break;
        chain.pop_back();
      }
      chain.push_back(r);
    }
    for (const Flat& p : chain) corner[z(p.v)] = true;
    std::reverse(flat.begin(), flat.end());
  }
}

// Vertices of a face, sorted counter-clockwise by their angle about the mean.
std::vector<int> loop_of(std::vector<Flat> flat) {
  std::sort(flat.begin(), flat.end(), [](const Flat& p, const Flat& q) { return std::atan2(p.y, p.x) < std::atan2(q.y, q.x); });
  std::vector<int> loop;
  for (const Flat& p : flat) loop.push_back(p.v);
  return loop;
}

// One plane for each set of coplanar triangles: the plane of the largest one.
std::vector<Plane> face_planes(const std::vector<Vec3>& x, std::vector<Triangle> triangles, double eps) {
  std::sort(triangles.begin(), triangles.end(), [](const Triangle& s, const Triangle& t) { return s.area > t.area; });
  std::vector<Plane> faces;
  for (const Triangle& t : triangles) {
    auto holds = [&](const Plane& f) {
      return f.n.dot(t.n) > 0 && std::all_of(t.v.begin(), t.v.end(), [&](int v) { return std::abs(f.n.dot(x[z(v)]) - f.d) < 4 * eps; });
    };
    if (t.area > eps * eps && std::none_of(faces.begin(), faces.end(), holds)) faces.push_back({t.n, t.d});
  }
  return faces;
}

}  // namespace

Polyhedron hull(const std::vector<Vec3>& points) {
  if (points.size() < 4) throw Error(fmt::format("a body needs at least 4 points, {} were given", points.size()));
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    if (!p.allFinite()) throw Error("a point is not a number");
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 centre = (low + high) / 2;
  const double eps = 1e-9 * (high - low).norm();
  std::vector<Vec3> x;
  for (const Vec3& p : points) {
    const bool known = std::any_of(x.begin(), x.end(), [&](const Vec3& q) { return (q + centre - p).norm() < eps; });
    if (!known) x.push_back(p - centre);
  }
  if (x.size() < 4) throw Error("the points coincide: they span no body");
  const std::vector<Triangle> triangles = hull_triangles(x, eps);
  std::vector<bool> on_hull(x.size(), false), corner(x.size(), false);
  for (const Triangle& t : triangles) {
    for (int v : t.v) on_hull[z(v)] = true;
  }
  const std::vector<Plane> faces = face_planes(x, triangles, eps);
  auto on_face = [&](const Plane& f, const std::vector<bool>& wanted) {
    std::vector<int> on;
    for (int v = 0; v < static_cast<int>(x.size()); ++v) {
      if (wanted[z(v)] && std::abs(f.n.dot(x[z(v)]) - f.d) < 4 * eps) on.push_back(v);
    }
    return flattened(x, f.n, on);
  };
  for (const Plane& f : faces) mark_corners(on_face(f, on_hull), eps, corner);
  Polyhedron result;
  std::vector<int> number(x.size(), -1);
  for (size_t v = 0; v < x.size(); ++v) {
    if (!corner[v]) continue;
    number[v] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(x[v] + centre);
  }
  for (const Plane& f : faces) {
    std::vector<int> loop = loop_of(on_face(f, corner));
    for (int& v : loop) v = number[z(v)];
    if (loop.size() >= 3) result.faces.push_back(std::move(loop));
  }
  if (std::string wrong = problem_of(result); !wrong.empty()) throw Error("no sound body is spanned by the points: " + wrong);
  return result;
}

}  // namespace erbs
