#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/geometry/mass.h"
#include "engine/geometry/polyhedron.h"
#include "engine/geometry/separation.h"

using namespace erbs;

namespace {
Polyhedron brick() { return box_polyhedron({-0.15, -0.0625, -0.05}, {0.15, 0.0625, 0.05}); }
}  // namespace

TEST_CASE("the hull of a cube with points on faces, edges and inside is a cube", "[geometry]") {
  std::vector<Vec3> points;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      for (int k = 0; k <= 4; ++k) points.emplace_back(1e4 + i * 0.25, j * 0.25, k * 0.25);
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  const Polyhedron cube = hull(points);
  CHECK(cube.vertices.size() == 8);
  CHECK(cube.faces.size() == 6);
  CHECK(problem_of(cube).empty());
  CHECK(mass_properties(cube).volume == Approx(1).epsilon(1e-11));
}

TEST_CASE("hulls of random points and of prisms are sound and hold their points", "[geometry]") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) points.emplace_back(normal(random), normal(random), normal(random));
    const Polyhedron p = hull(points);
    CHECK(problem_of(p) == "");
    for (const Plane& f : planes(p))
      for (const Vec3& x : points) CHECK(f.n.dot(x) - f.d < 1e-8);
  }
  for (int n : {3, 7, 12}) {
    std::vector<Vec3> points;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 2; ++k) points.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), k);
    const Polyhedron p = transformed(hull(points), rotation({0.3, 1, 2}), {5, 6, 7});
    CHECK(static_cast<int>(p.faces.size()) == n + 2);
    CHECK(hull(p.vertices).faces.size() == p.faces.size());
    CHECK(mass_properties(p).volume == Approx(n / 2.0 * std::sin(2 * M_PI / n)));
  }
  CHECK_THROWS_AS(hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.5, 0}}), Error);
}

TEST_CASE("what is wrong with a body is named", "[geometry]") {
  CHECK(problem_of(brick()).empty());
  Polyhedron p = brick();
  p.vertices[3].x() = std::nan("");
  CHECK(problem_of(p) == "vertex 4 is not a number");
  p = brick();
  p.faces.edit().pop_back();
  CHECK(problem_of(p).find("not closed") != std::string::npos);
  p = brick();
  for (auto& f : p.faces.edit()) std::reverse(f.begin(), f.end());
  CHECK(problem_of(p).find("inside out") != std::string::npos);
  p = brick();
  std::reverse(p.faces.edit()[2].begin(), p.faces.edit()[2].end());
  CHECK(problem_of(p).find("inside out") != std::string::npos);
  p = hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
  p.vertices[4] = Vec3(0.2, 0.2, 0.2);
  CHECK(!problem_of(p).empty());
  p = brick();
  for (Vec3& v : p.vertices) v.z() = 0;
  CHECK(!problem_of(p).empty());
}

TEST_CASE("faces grow by their own offsets", "[geometry]") {
  const Polyhedron p = grown(brick(), {0.01, 0.02, 0, 0.005, -0.01, 0.03});
  CHECK(problem_of(p).empty());
  const Box b = bounding_box(p);
  CHECK((b.low - Vec3(-0.16, -0.0625, -0.04)).norm() < 1e-15);
  CHECK((b.high - Vec3(0.17, 0.0675, 0.08)).norm() < 1e-15);
  // A pyramid: four faces meet at the apex, so moving one face changes the topology.
  const Polyhedron pyramid = hull({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}});
  std::vector<double> offsets(5, 0.0);
  for (std::size_t f = 0; f < 5; ++f) offsets[f] = face_plane(pyramid, static_cast<int>(f)).n.x() > 0.5 ? 0.1 : 0.0;
  const Polyhedron roof = grown(pyramid, offsets);
  CHECK(problem_of(roof).empty());
  CHECK(roof.faces.size() == 5);
  CHECK(roof.vertices.size() == 6);
  CHECK(bounding_box(roof).high.z() == Approx(1));
  CHECK(bounding_box(roof).high.x() == Approx(1 + 0.1 * std::sqrt(2)));
  CHECK_THROWS_AS(grown(brick(), {0, 0, 0, 0, -0.06, -0.06}), Error);
}

TEST_CASE("mass properties: brick, turned brick far away, cut brick as two parts", "[geometry]") {
  const double l = 0.3, b = 0.125, h = 0.1, v = l * b * h;
  const Vec3 principal = v / 12 * Vec3(b * b + h * h, l * l + h * h, l * l + b * b);
  const MassProperties m = mass_properties(brick());
  CHECK(m.volume == Approx(v).epsilon(1e-14));
  CHECK(m.centroid.norm() < 1e-15);
  CHECK((m.inertia - Mat3(principal.asDiagonal())).norm() < 1e-15 * principal.norm());
  const Quat q = rotation({1, -2, 0.5});
  const Vec3 far(1e4, -2e4, 3e4);
  const MassProperties r = mass_properties(transformed(brick(), q, far));
  CHECK((r.centroid - far).norm() < 1e-11);
  CHECK((q.toRotationMatrix().transpose() * r.inertia * q.toRotationMatrix() - Mat3(principal.asDiagonal())).norm() <
        1e-9 * principal.norm());
  const std::vector<Polyhedron> halves{box_polyhedron({-0.15, -0.0625, -0.05}, {0.05, 0.0625, 0.05}),
                                       box_polyhedron({0.05, -0.0625, -0.05}, {0.15, 0.0625, 0.05})};
  const MassProperties two = mass_properties(halves);
  CHECK(two.volume == Approx(v));
  CHECK(two.centroid.norm() < 1e-15);
  CHECK((two.inertia - m.inertia).norm() < 1e-14 * m.inertia.norm());
}

TEST_CASE("separation is the gap or the depth", "[geometry]") {
  CHECK(separation(brick(), translated(brick(), {0, 0, 0.103})).gap == Approx(0.003));
  const Separation s = separation(brick(), translated(brick(), {0.1, 0.02, 0.098}));
  CHECK(s.gap == Approx(-0.002));
  CHECK((s.axis - Vec3::UnitZ()).norm() < 1e-12);
  // Two crossed edges.
  const Polyhedron a = transformed(brick(), rotation({M_PI / 4, 0, 0}), Vec3::Zero());
  const Polyhedron b = transformed(brick(), Quat(rotation({0, 0, M_PI / 2}) * rotation({M_PI / 4, 0, 0})), {0, 0, 0.2});
  const double ridge = bounding_box(a).high.z();
  CHECK(separation(a, b).gap == Approx(0.2 - 2 * ridge));
}
