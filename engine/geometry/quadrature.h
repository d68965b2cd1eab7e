// Contact points on a convex polygon: places and weights that integrate a traction over it.
#pragma once
#include <string>
#include <vector>

#include "engine/geometry/clip.h"

namespace erbs {

struct QuadraturePoint {
  double x, y;    // m
  double weight;  // m2
  // The point's cell: a counter-clockwise loop of that area. Cells fill the polygon without overlap.
  std::vector<Vec2> cell{};
  // Corners of the cell brought into the convex hull of all points: where the point watches a linear field. Over all points its
  // extremes are those at the points.
  std::vector<Vec2> watch{};
};

// rule:
//  simpson   points on the true edge and exact for 1, x, y, x2, xy, y2 (bending), so elastic stiffness and toe are both right
//            (2 points cannot be both: they are exact in bending and lie at +-1/(2 sqrt 3) of the side);
//            polygons that are no rectangles: fan triangles about the centroid, 1/20 at vertices, 2/15 at mid-sides, 9/20 at centroids
//  midpoint  equal cells, one point in the centre of each (of its part inside the polygon)
//  trapezoid equal spacing, edges included, half weights at the edges (too stiff in bending: 1 + 2/(n-1)^2)
//  gauss     Gauss-Legendre, 2 or more points exact in bending, none on the edge
// n_long along the longer side of a rectangle, n_short along the shorter; other polygons: their principal axes (midpoint only).
// Throws Error for an unknown rule or a number of points it cannot have.
std::vector<QuadraturePoint> quadrature(const Polygon2& polygon, const std::string& rule, int n_long, int n_short);

// Positions in [-1/2, 1/2] and weights that sum to 1.
struct LineRule {
  std::vector<double> at, weight;
};
LineRule line_rule(const std::string& rule, int n);

// Principal axes of weighted points: the first axis is the one along which they spread most.
struct PrincipalAxes {
  Vec2 centroid = Vec2::Zero();  // m
  double angle = 0;              // rad, of the first axis against x, in (-pi/2, pi/2]
  double area = 0;               // m2, sum of weights
  double along = 0, across = 0;  // m4, sum of weight times squared distance along the first and the second axis
};
PrincipalAxes principal_axes(const std::vector<QuadraturePoint>& points);

}  // namespace erbs
