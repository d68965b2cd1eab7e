#include "engine/geometry/quadrature.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

using namespace erbs;

namespace {
const Polygon2 rectangle{{1, 1}, {1.3, 1}, {1.3, 1.1}, {1, 1.1}};

double second(const LineRule& r) {
  double sum = 0;
  for (std::size_t i = 0; i < r.at.size(); ++i) sum += r.weight[i] * r.at[i] * r.at[i];
  return 12 * sum;
}

Polygon2 heptagon() {
  Polygon2 p;
  for (int i = 0; i < 7; ++i) p.emplace_back(3 + 0.5 * std::cos(0.9 * i), -2 + 0.3 * std::sin(0.9 * i));
  return p;
}
}  // namespace

// V13: rotational stiffness against kn B H^3 / 12.
TEST_CASE("rotational stiffness of point rules has its known ratio", "[geometry][verify]") {
  for (int n : {1, 2, 3, 4, 6, 8}) CHECK(second(line_rule("midpoint", n)) == Approx(1 - 1.0 / (n * n)).margin(1e-10));
  for (int n : {2, 3, 4, 5, 9}) CHECK(second(line_rule("trapezoid", n)) == Approx(1 + 2.0 / ((n - 1) * (n - 1))).margin(1e-10));
  for (int n = 2; n <= 12; ++n) {
    CHECK(second(line_rule("simpson", n)) == Approx(1).margin(1e-10));
    CHECK(second(line_rule("gauss", n)) == Approx(1).margin(1e-10));
  }
  const LineRule three = line_rule("simpson", 3);
  CHECK(three.weight[0] == Approx(1.0 / 6));
  CHECK(three.weight[1] == Approx(4.0 / 6));
  CHECK(line_rule("gauss", 2).at[1] == Approx(0.5 / std::sqrt(3.0)));
}

TEST_CASE("line rules are symmetric, positive, sum to one; simpson reaches the edge", "[geometry]") {
  for (const char* rule : {"simpson", "midpoint", "trapezoid", "gauss"}) {
    for (int n = 2; n <= 12; ++n) {
      const LineRule r = line_rule(rule, n);
      double sum = 0;
      for (std::size_t i = 0; i < r.at.size(); ++i) {
        const std::size_t j = r.at.size() - 1 - i;
        sum += r.weight[i];
        CHECK(r.weight[i] > 0);
        CHECK(r.at[i] == Approx(-r.at[j]).margin(1e-15));
        CHECK(r.weight[i] == Approx(r.weight[j]).epsilon(1e-13));
      }
      CHECK(sum == Approx(1).epsilon(1e-14));
    }
  }
  for (int n = 3; n <= 12; ++n) CHECK(line_rule("simpson", n).at.back() == 0.5);
}

TEST_CASE("points on polygons integrate polynomials as their rule promises", "[geometry]") {
  for (const Polygon2& p : {rectangle, Polygon2{{0, 0}, {2, 0}, {0.5, 1}}, heptagon()}) {
    const PolygonMoments exact = moments(p);
    for (const char* rule : {"simpson", "gauss", "midpoint", "trapezoid"}) {
      const auto points = quadrature(p, rule, 4, 3);
      const PrincipalAxes a = principal_axes(points);
      CHECK(a.area == Approx(exact.area).epsilon(1e-12));
      CHECK((a.centroid - exact.centroid).norm() < 1e-12);
      if (std::string(rule) == "simpson" || std::string(rule) == "gauss") {
        CHECK(a.along + a.across == Approx(exact.xx + exact.yy).epsilon(1e-11));
        CHECK(a.along * a.across == Approx(exact.xx * exact.yy - exact.xy * exact.xy).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("cells have their points' weights, fill the polygon, and watch no wider than the points", "[geometry]") {
  for (const Polygon2& p : {rectangle, Polygon2{{0, 0}, {2, 0}, {0.5, 1}}, heptagon()}) {
    for (const char* rule : {"simpson", "gauss", "midpoint", "trapezoid"}) {
      const auto points = quadrature(p, rule, 5, 2);
      PolygonMoments sum;
      for (const QuadraturePoint& q : points) {
        const PolygonMoments own = moments(q.cell);
        INFO(rule << " point at " << q.x << ", " << q.y);
        CHECK(own.area == Approx(q.weight).epsilon(1e-12));
        sum.area += own.area;
        sum.centroid += own.area * own.centroid;
        sum.xx += own.xx + own.area * own.centroid.x() * own.centroid.x();
      }
      const PolygonMoments whole = moments(p);
      CHECK(sum.area == Approx(whole.area).epsilon(1e-12));
      CHECK((sum.centroid / sum.area - whole.centroid).norm() < 1e-12);
      CHECK(sum.xx == Approx(whole.xx + whole.area * whole.centroid.x() * whole.centroid.x()).epsilon(1e-11));
      for (int i = 0; i < 12; ++i) {
        const Vec2 n(std::cos(0.5 * i), std::sin(0.5 * i));
        double at_points = -1e300, watched = -1e300;
        for (const QuadraturePoint& q : points) {
          at_points = std::max(at_points, n.dot(Vec2(q.x, q.y)));
          for (const Vec2& x : q.tension_loop) watched = std::max(watched, n.dot(x));
        }
        CHECK(watched <= at_points + 1e-9);
      }
    }
  }
}

TEST_CASE("the longer side takes the points of the longer side", "[geometry]") {
  CHECK(quadrature(rectangle, "simpson", 5, 3).size() == 15);
  const auto points = quadrature({{0, 0}, {1, 0}, {1, 3}, {0, 3}}, "simpson", 5, 2);
  int on_left = 0;
  for (const QuadraturePoint& q : points) on_left += q.x < 0.5;
  CHECK(on_left == 5);
  const PrincipalAxes a = principal_axes(points);
  CHECK(a.along == Approx(1 * 27 / 12.0));
  CHECK(std::abs(std::cos(a.angle)) < 1e-12);
}

TEST_CASE("a general polygon has its corners among the points of simpson", "[geometry]") {
  const Polygon2 p = heptagon();
  const auto points = quadrature(p, "simpson", 3, 3);
  CHECK(points.size() == 7 + 7 + 7 + 7 + 1);
  for (const Vec2& v : p) {
    CHECK(std::any_of(points.begin(), points.end(), [&](const QuadraturePoint& q) { return (Vec2(q.x, q.y) - v).norm() < 1e-14; }));
  }
}

TEST_CASE("an unknown rule is refused", "[geometry]") {
  CHECK_THROWS_AS(quadrature(rectangle, "simson", 3, 3), Error);
  CHECK_THROWS_AS(quadrature(rectangle, "trapezoid", 1, 3), Error);
}

TEST_CASE("clipping and moments of polygons", "[geometry]") {
  const Polygon2 square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Polygon2 diamond{{0.5, -0.5}, {1.5, 0.5}, {0.5, 1.5}, {-0.5, 0.5}};
  CHECK(moments(clip_convex(square, diamond)).area == Approx(1));
  const Polygon2 shifted{{0.75, 0.5}, {2, 0.5}, {2, 3}, {0.75, 3}};
  const PolygonMoments m = moments(clip_convex(square, shifted));
  CHECK(m.area == Approx(0.125));
  CHECK((m.centroid - Vec2(0.875, 0.75)).norm() < 1e-15);
  CHECK(m.yy == Approx(0.25 * 0.125 / 12));
  CHECK(m.xx == Approx(0.5 * std::pow(0.25, 3) / 12));
  CHECK(clip_convex(square, {{2, 2}, {3, 2}, {3, 3}}).empty());
  CHECK(simplified({{0, 0}, {0.5, 0}, {1, 0}, {1, 1e-14}, {1, 1}, {0, 1}}, 1e-9).size() == 4);
}
