// Clipping and moments of convex polygons in the plane.
#pragma once
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

using Vec2 = Eigen::Vector2d;
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
