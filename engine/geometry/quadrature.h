// Contact points of a convex polygon: positions and weights that integrate a traction over it.
#pragma once
#include <string>
#include <vector>

#include "engine/geometry/clip.h"

namespace erbs {

struct QuadraturePoint {
  double x, y;    // m
  double weight;  // m2
  // Cell of the point: a counter-clockwise loop whose area is the weight. The cells fill the polygon without overlap.
  std::vector<Vec2> cell{};
  // Corners of the cell, moved into the convex hull of all points. The point checks a linear field there (tension). Over all cells that
  // field has the same extremes as at the points.
  std::vector<Vec2> tension_loop{};
};

// rule:
//  simpson   points on the true edge, exact for 1, x, y, x2, xy, y2 (bending): elastic stiffness and toe are both right
//            (two points cannot do both: exact in bending, they lie at +-1/(2 sqrt 3) of the side);
//            other polygons: fan triangles about the centroid, weights 1/20 at vertices, 2/15 at mid-sides, 9/20 at centroids
//  midpoint  equal cells, one point at the centroid of each (of its part inside the polygon)
//  trapezoid equal spacing, edges included, half weights at the edges (too stiff in bending: 1 + 2/(n-1)^2)
//  gauss     Gauss-Legendre; two or more points are exact in bending, none lies on the edge
// n_long: points along the longer side of a rectangle, n_short: along the shorter. For other polygons the midpoint rule counts along the
// principal axes. Throws Error for an unknown rule or an impossible number of points.
std::vector<QuadraturePoint> quadrature(const Polygon2& polygon, const std::string& rule, int n_long, int n_short);

// A rule on a line: positions in [-1/2, 1/2], weights that sum to 1.
struct LineRule {
  std::vector<double> at, weight;
};
LineRule line_rule(const std::string& rule, int n);

// Principal axes of weighted points. The first axis is the direction of the largest spread.
struct PrincipalAxes {
  Vec2 centroid = Vec2::Zero();  // m
  double angle = 0;              // rad, from x to the first axis, in (-pi/2, pi/2]
  double area = 0;               // m2, sum of weights
  double along = 0, across = 0;  // m4, sums of weight times squared coordinate along the first and the second axis
};
PrincipalAxes principal_axes(const std::vector<QuadraturePoint>& points);

}  // namespace erbs
