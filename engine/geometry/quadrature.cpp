#include "engine/geometry/quadrature.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/geometry/clip.h"

namespace erbs {
namespace {

using std::size_t;

LineRule gauss_line(int n) {
  LineRule r;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {  // Newton on the Legendre polynomial
      double p0 = 1, p1 = x;
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    r.at.push_back(-x / 2);
    r.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return r;
}

// Equal spacing. Odd n: composite Simpson. Even n from 4: the trapezoid rule, with two outer weights on each side that make it exact
// for quadratics (n = 4 is the 3/8 rule).
LineRule simpson_line(int n) {
  if (n <= 2) return gauss_line(n);
  LineRule r;
  const double h = 1.0 / (n - 1), half = (n - 1) / 2.0;
  double outer = 0, next = 0;
  if (n % 2 == 0) {
    double inside = 0;  // half the sum of squared positions between the two outer pairs, in spacings
    for (int i = n / 2; i < n - 2; ++i) inside += (i - half) * (i - half);
    outer = (half * half * half / 3 - inside - 1.5 * (half - 1) * (half - 1)) / (half * half - (half - 1) * (half - 1));
    next = 1.5 - outer;
  }
  for (int i = 0; i < n; ++i) {
    r.at.push_back(i * h - 0.5);
    const int from_end = std::min(i, n - 1 - i);
    double w = 1;
    if (n % 2 == 1) w = from_end == 0 ? 1.0 / 3 : i % 2 == 1 ? 4.0 / 3 : 2.0 / 3;
    else if (from_end == 0) w = outer;
    else if (from_end == 1) w = next;
    r.weight.push_back(w * h);
  }
  return r;
}

bool is_rectangle(const Polygon2& p) {
  if (p.size() != 4) return false;
  for (size_t i = 0; i < 4; ++i) {
    const Vec2 e = p[(i + 1) % 4] - p[i], f = p[(i + 2) % 4] - p[(i + 1) % 4];
    if (std::abs(e.dot(f)) > 1e-6 * e.norm() * f.norm()) return false;
  }
  return true;
}

// Borders of the cells on a line: cumulative weights.
std::vector<double> borders(const LineRule& r) {
  std::vector<double> at{-0.5};
  for (const double w : r.weight) at.push_back(at.back() + w);
  at.back() = 0.5;
  return at;
}

std::vector<QuadraturePoint> on_rectangle(const Polygon2& p, const LineRule& longer, const LineRule& shorter) {
  Vec2 u = (p[1] - p[0] + p[2] - p[3]) / 2, v = (p[3] - p[0] + p[2] - p[1]) / 2;
  const Vec2 centre = (p[0] + p[1] + p[2] + p[3]) / 4;
  if (v.norm() > u.norm() * (1 + 1e-9)) {
    const Vec2 old = u;
    u = v;
    v = -old;
  }
  const double area = cross2(u, v);
  const std::vector<double> across = borders(shorter), along = borders(longer);
  std::vector<QuadraturePoint> points;
  for (size_t j = 0; j < shorter.at.size(); ++j) {
    for (size_t i = 0; i < longer.at.size(); ++i) {
      const Vec2 x = centre + longer.at[i] * u + shorter.at[j] * v;
      const auto corner = [&](size_t k, size_t l) { return Vec2(centre + along[i + k] * u + across[j + l] * v); };
      points.push_back(
          {x.x(), x.y(), area * longer.weight[i] * shorter.weight[j], {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, {}});
    }
  }
  return points;
}

// Cells of the fan. Each triangle is divided into three kinds of cells.
//   centroid   the triangle itself, shrunk about its centroid by the factor `inner`
//   corners    kites between a corner of the triangle and the same corner of the shrunk one; they start at the fraction `cut` of the sides
//   mid-sides  the rest
// The areas 9/20, 1/20 and 2/15 require inner^2 = 9/20; a kite has 2 cut (1 - inner) / 3 of the area of its triangle. inner = 0 and
// cut = 1/2 divide the triangle into three equal kites.
struct FanCells {
  const Polygon2& p;
  Vec2 c;
  double inner, cut;
  size_t next(size_t i) const { return (i + 1) % p.size(); }
  size_t last(size_t i) const { return (i + p.size() - 1) % p.size(); }
  Vec2 middle(size_t i) const { return (p[i] + p[next(i)] + c) / 3; }
  Vec2 within(size_t i, const Vec2& v) const { return middle(i) + inner * (v - middle(i)); }  // corner v of triangle i, shrunk
  Vec2 part(const Vec2& from, const Vec2& to) const { return from + cut * (to - from); }
  std::vector<Vec2> corner(size_t i) const {
    const Vec2& v = p[i];
    return {v, part(v, p[next(i)]), within(i, v), part(v, c), within(last(i), v), part(v, p[last(i)])};
  }
  std::vector<Vec2> side(size_t i) const {
    const Vec2 &v = p[i], &w = p[next(i)];
    return {part(v, w), part(w, v), within(i, w), within(i, v)};
  }
  std::vector<Vec2> spoke(size_t i) const {
    const Vec2& v = p[i];
    return {part(c, v), within(last(i), c), within(last(i), v), part(v, c), within(i, v), within(i, c)};
  }
  std::vector<Vec2> inside(size_t i) const { return {within(i, p[i]), within(i, p[next(i)]), within(i, c)}; }
  std::vector<Vec2> centre() const {
    std::vector<Vec2> loop;
    for (size_t i = 0; i < p.size(); ++i) loop.insert(loop.end(), {part(c, p[i]), within(i, c)});
    return loop;
  }
};

// Fan triangles about the centroid. Neighbouring triangles share corners, mid-sides and the centre of the fan.
std::vector<QuadraturePoint> fan(const Polygon2& p, const std::string& rule) {
  const Vec2 c = moments(p).centroid;
  const size_t n = p.size();
  const bool simpson = rule == "simpson";
  const double shrunk = std::sqrt(9.0 / 20);
  const FanCells cells{p, c, simpson ? shrunk : 0.0, simpson ? 3 / (40 * (1 - shrunk)) : 0.5};
  std::vector<QuadraturePoint> centre{{c.x(), c.y(), 0, cells.centre(), {}}}, corner, spoke, side, inside;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 half = (p[i] + c) / 2;
    corner.push_back({p[i].x(), p[i].y(), 0, cells.corner(i), {}});
    spoke.push_back({half.x(), half.y(), 0, cells.spoke(i), {}});
  }
  for (size_t i = 0; i < n; ++i) {
    const size_t k = (i + 1) % n;
    const double area = cross2(p[i] - c, p[k] - c) / 2;
    const Vec2 m = (p[i] + p[k]) / 2, g = cells.middle(i);
    if (rule == "gauss") {  // three interior points, exact for quadratics
      const Vec2 v[3] = {p[i], p[k], c};
      for (size_t e = 0; e < 3; ++e) {
        const Vec2 x = v[e] / 2 + g / 2;
        inside.push_back({x.x(), x.y(), area / 3, {v[e], (v[e] + v[(e + 1) % 3]) / 2, g, (v[e] + v[(e + 2) % 3]) / 2}, {}});
      }
      continue;
    }
    const double at_vertex = simpson ? 1.0 / 20 : 1.0 / 3, at_side = simpson ? 2.0 / 15 : 0.0;
    centre[0].weight += area * at_vertex;
    corner[i].weight += area * at_vertex;
    corner[k].weight += area * at_vertex;
    spoke[i].weight += area * at_side;
    spoke[k].weight += area * at_side;
    side.push_back({m.x(), m.y(), area * at_side, cells.side(i), {}});
    inside.push_back({g.x(), g.y(), simpson ? area * 9.0 / 20 : 0.0, cells.inside(i), {}});
  }
  std::vector<QuadraturePoint> points;
  for (const auto* set : {&corner, &side, &spoke, &inside, &centre}) {
    for (const QuadraturePoint& q : *set) {
      if (q.weight > 0) points.push_back(q);
    }
  }
  return points;
}

// Equal cells along the principal axes, cut by the polygon. The point of a cell is its centroid, the weight its area.
std::vector<QuadraturePoint> cells(const Polygon2& p, int n_long, int n_short) {
  const PolygonMoments m = moments(p);
  const double angle = 0.5 * std::atan2(2 * m.xy, m.xx - m.yy);
  const Vec2 e(std::cos(angle), std::sin(angle)), f(-e.y(), e.x());
  Vec2 low(1e300, 1e300), high(-1e300, -1e300);
  for (const Vec2& v : p) {
    const Vec2 x(e.dot(v), f.dot(v));
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  std::vector<QuadraturePoint> points;
  for (int j = 0; j < n_short; ++j) {
    Polygon2 row = clip_half_plane(p, f, low.y() + (high.y() - low.y()) * (j + 1) / n_short);
    row = clip_half_plane(row, -f, -(low.y() + (high.y() - low.y()) * j / n_short));
    for (int i = 0; i < n_long; ++i) {
      Polygon2 cell = clip_half_plane(row, e, low.x() + (high.x() - low.x()) * (i + 1) / n_long);
      cell = clip_half_plane(cell, -e, -(low.x() + (high.x() - low.x()) * i / n_long));
      const PolygonMoments part = moments(cell);
      if (part.area > 1e-12 * m.area) points.push_back({part.centroid.x(), part.centroid.y(), part.area, cell, {}});
    }
  }
  return points;
}

// Convex hull, counter-clockwise (Andrew 1979); one or two corners if all points coincide or lie on a line.
std::vector<Vec2> convex_hull(const std::vector<QuadraturePoint>& points, double weld) {
  std::vector<Vec2> sorted, hull;
  for (const QuadraturePoint& p : points) sorted.emplace_back(p.x, p.y);
  std::sort(sorted.begin(), sorted.end(), [&](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  for (int pass = 0; pass < 2; ++pass) {
    const size_t first = hull.size();
    for (const Vec2& x : sorted) {
      while (hull.size() >= first + 2 &&
             cross2(hull.back() - hull[hull.size() - 2], x - hull.back()) <= weld * (x - hull[hull.size() - 2]).norm())
        hull.pop_back();
      hull.push_back(x);
    }
    hull.pop_back();
    std::reverse(sorted.begin(), sorted.end());
  }
  if (hull.empty()) hull.push_back(sorted.front());
  return hull;
}

Vec2 nearest(const std::vector<Vec2>& hull, const Vec2& x, double weld) {
  bool inside = hull.size() > 2;
  Vec2 best = hull.front();
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vec2 &a = hull[i], edge = hull[(i + 1) % hull.size()] - a;
    if (cross2(edge, x - a) < -weld * edge.norm()) inside = false;
    const double square = edge.squaredNorm(), at = square > 0 ? std::clamp((x - a).dot(edge) / square, 0.0, 1.0) : 0.0;
    const Vec2 y = a + at * edge;
    if ((x - y).squaredNorm() < (x - best).squaredNorm()) best = y;
  }
  return inside || (x - best).norm() < weld ? x : best;
}

void set_watch(std::vector<QuadraturePoint>& points, double weld) {
  const std::vector<Vec2> hull = convex_hull(points, weld);
  for (QuadraturePoint& p : points) {
    p.tension_loop.clear();
    for (const Vec2& x : p.cell) p.tension_loop.push_back(nearest(hull, x, weld));
  }
}

}  // namespace

LineRule line_rule(const std::string& rule, int n) {
  const int least = rule == "trapezoid" ? 2 : 1;
  if (n < least || n > 64) throw Error(fmt::format("the rule {} takes {} to 64 points along a side, not {}", rule, least, n));
  if (rule == "simpson") return simpson_line(n);
  if (rule == "gauss") return gauss_line(n);
  LineRule r;
  if (rule != "midpoint" && rule != "trapezoid") {
    throw Error("unknown rule of contact points \"" + rule + "\"; it is simpson, midpoint, trapezoid or gauss");
  }
  for (int i = 0; i < n; ++i) {
    if (rule == "midpoint") {
      r.at.push_back((i + 0.5) / n - 0.5);
      r.weight.push_back(1.0 / n);
    } else {
      r.at.push_back(static_cast<double>(i) / (n - 1) - 0.5);
      r.weight.push_back((i == 0 || i == n - 1 ? 0.5 : 1.0) / (n - 1));
    }
  }
  return r;
}

std::vector<QuadraturePoint> quadrature(const Polygon2& polygon, const std::string& rule, int n_long, int n_short) {
  const LineRule longer = line_rule(rule, n_long), shorter = line_rule(rule, n_short);
  auto points = is_rectangle(polygon) ? on_rectangle(polygon, longer, shorter)
                : rule == "midpoint"  ? cells(polygon, n_long, n_short)
                                      : fan(polygon, rule);
  set_watch(points, 1e-9 * std::sqrt(moments(polygon).area));
  return points;
}

PrincipalAxes principal_axes(const std::vector<QuadraturePoint>& points) {
  PrincipalAxes a;
  for (const QuadraturePoint& p : points) {
    a.area += p.weight;
    a.centroid += p.weight * Vec2(p.x, p.y);
  }
  a.centroid /= a.area;
  double xx = 0, yy = 0, xy = 0;
  for (const QuadraturePoint& p : points) {
    const double x = p.x - a.centroid.x(), y = p.y - a.centroid.y();
    xx += p.weight * x * x;
    yy += p.weight * y * y;
    xy += p.weight * x * y;
  }
  if (std::abs(xy) < 1e-12 * (xx + yy)) xy = 0;
  if (std::abs(xx - yy) < 1e-12 * (xx + yy) && xy == 0) a.angle = 0;  // no preferred axis: keep x
  else a.angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const double c = std::cos(a.angle), s = std::sin(a.angle);
  a.along = c * c * xx + s * s * yy + 2 * c * s * xy;
  a.across = s * s * xx + c * c * yy - 2 * c * s * xy;
  return a;
}

}  // namespace erbs
