// Clipping and moments of convex polygons in the plane.
#pragma once
#include <type_traits>
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

// The part of a convex polygon where a linear function is zero or above. `corner(i)` and `value(i)`: corner i of `count`, and the function
// there. Calls `add(point, value)` for each corner of the part, in order, from the one on the edge that ends at corner 0. A point is
// anything that can be interpolated.
template <class Corner, class Value, class Add>
void cut_polygon(int count, const Corner& corner, const Value& value, const Add& add) {
  using Position = std::decay_t<decltype(corner(0))>;
  using Scalar = std::decay_t<decltype(value(0))>;
  Scalar before = count > 0 ? value(count - 1) : Scalar(0);
  for (int i = 0, last = count - 1; i < count; last = i++) {
    const Scalar now = value(i);
    if ((before < 0 && now > 0) || (before > 0 && now < 0)) {
      const Scalar share = before / (before - now);
      add(Position(corner(last) + share * (corner(i) - corner(last))), Scalar(0));
    }
    if (now >= 0) add(corner(i), now);
    before = now;
  }
}

using Vec2 = Eigen::Vector2d;
inline double cross2(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
using Polygon2 = std::vector<Vec2>;  // convex, counter-clockwise, m

// Part of the polygon in the half plane n.x <= d.
Polygon2 clip_half_plane(const Polygon2& polygon, const Vec2& n, double d);
// Intersection of two convex polygons, both counter-clockwise.
Polygon2 clip_convex(const Polygon2& a, const Polygon2& b);

struct PolygonMoments {
  double area = 0;                // m2, positive for counter-clockwise
  Vec2 centroid = Vec2::Zero();   // m
  double xx = 0, yy = 0, xy = 0;  // m4: int x2, y2, xy dA about the centroid
};
PolygonMoments moments(const Polygon2& polygon);

// Drops corners within `weld` of their neighbour, and corners on the line through both neighbours.
Polygon2 simplified(const Polygon2& polygon, double weld);

}  // namespace erbs
