#include "engine/geometry/clip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace erbs {

Polygon2 clip_half_plane(const Polygon2& polygon, const Vec2& n, double d) {
  Polygon2 kept;
  const int count = static_cast<int>(polygon.size());
  const auto corner = [&](int i) -> const Vec2& { return polygon[static_cast<std::size_t>(i)]; };
  const auto inside = [&](int i) { return d - n.dot(corner(i)); };
  cut_polygon(count, corner, inside, [&](const Vec2& p, double) { kept.push_back(p); });
  // The point on the last edge comes last: the polygon starts with the same corner as before, as far as that stays.
  if (count > 0 && inside(0) * inside(count - 1) < 0) std::rotate(kept.begin(), kept.begin() + 1, kept.end());
  return kept;
}

Polygon2 clip_convex(const Polygon2& a, const Polygon2& b) {
  Polygon2 result = a;
  for (std::size_t i = 0; i < b.size() && !result.empty(); ++i) {
    const Vec2 edge = b[(i + 1) % b.size()] - b[i];
    const Vec2 outward(edge.y(), -edge.x());
    const double length = outward.norm();
    if (length > 0) result = clip_half_plane(result, outward / length, outward.dot(b[i]) / length);
  }
  if (result.size() < 3) result.clear();
  return result;
}

PolygonMoments moments(const Polygon2& polygon) {
  PolygonMoments m;
  if (polygon.size() < 3) return m;
  const Vec2 origin = polygon[0];
  Vec2 first = Vec2::Zero();
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 p = polygon[i] - origin, q = polygon[i + 1] - origin;
    const double a = cross2(p, q) / 2;
    m.area += a;
    first += a / 3 * (p + q);
    xx += a / 6 * (p.x() * p.x() + q.x() * q.x() + p.x() * q.x());
    yy += a / 6 * (p.y() * p.y() + q.y() * q.y() + p.y() * q.y());
    xy += a / 12 * (2 * p.x() * p.y() + 2 * q.x() * q.y() + p.x() * q.y() + q.x() * p.y());
  }
  if (m.area == 0) {
    m.centroid = origin;
    return m;
  }
  const Vec2 c = first / m.area;
  m.centroid = origin + c;
  m.xx = xx - m.area * c.x() * c.x();
  m.yy = yy - m.area * c.y() * c.y();
  m.xy = xy - m.area * c.x() * c.y();
  return m;
}

Polygon2 simplified(const Polygon2& polygon, double weld) {
  Polygon2 apart;
  for (const Vec2& p : polygon) {
    if (apart.empty() || (p - apart.back()).norm() > weld) apart.push_back(p);
  }
  while (apart.size() > 1 && (apart.front() - apart.back()).norm() <= weld) apart.pop_back();
  Polygon2 result;
  for (std::size_t i = 0; i < apart.size(); ++i) {
    const Vec2 p = apart[(i + apart.size() - 1) % apart.size()], q = apart[i], r = apart[(i + 1) % apart.size()];
    if (std::abs(cross2(q - p, r - p)) > weld * (r - p).norm()) result.push_back(q);
  }
  return result;
}

}  // namespace erbs
