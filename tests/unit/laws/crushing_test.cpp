// Closed form of compression on a yielding face, against a fine grid of points that yield independently.
#include "engine/laws/crushing.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/laws/faces.h"

using namespace erbs;

namespace {

using test::at;
using test::faces;
using test::Gap;

CompressionFace face(const std::vector<double>& corners) { return {1e10, 1e-4, int(corners.size()) / 2, corners.data()}; }

// Points of equal area (m2) over a face, each with its own permanent set.
struct YieldingPlaces : test::Grid {
  explicit YieldingPlaces(const std::vector<double>& corners, int n = 700) : Grid(corners, n) {}
  void go(const Gap& g, double limit) {
    for (auto& [s, t, z] : place) z = std::min(z, at(g, s, t) + limit);
  }
  Pressed press(const Gap& g, double kn) const {
    Pressed sum;
    for (const auto& [s, t, z] : place) {
      const double y = std::max(0.0, z - at(g, s, t));
      sum.force += kn * y * area, sum.s += kn * y * s * area, sum.t += kn * y * t * area, sum.energy += 0.5 * kn * y * y * area;
    }
    return sum;
  }
};

void check(const Pressed& a, const Pressed& b, double scale, double share) {
  CHECK(std::fabs(a.force - b.force) < share * scale);
  CHECK(std::fabs(a.s - b.s) < share * scale * 0.1);
  CHECK(std::fabs(a.t - b.t) < share * scale * 0.1);
  CHECK(std::fabs(a.energy - b.energy) < share * scale * 1e-4);
}

}  // namespace

TEST_CASE("a face that yields presses as its places do one by one", "[laws][crushing]") {
  const auto& corners = faces[std::size_t(GENERATE(0, 1, 2))];
  const CompressionFace b = face(corners);
  YieldingPlaces places(corners);
  CrushedFace crushed;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const double whole = b.kn * b.limit * double(places.place.size()) * places.area;
  Gap last{1, 0, 0};
  for (int turn = 0; turn < 6; ++turn) {
    const Gap g{b.limit * (any(random) - 0.6), 12 * b.limit * any(random), 12 * b.limit * any(random)};
    crush(b, crushed, last.data(), g.data());
    places.go(g, b.limit);
    check(pressed(b, crushed, g.data()), places.press(g, b.kn), whole, 5e-3);  // error of the grid: its cells at the borders
    const Gap back{g[0] + 0.5 * b.limit, 0.7 * g[1], g[2]};                    // unloading
    check(pressed(b, crushed, back.data()), places.press(back, b.kn), whole, 5e-3);
    for (std::size_t i = 0; i < places.place.size(); i += 997) {
      const auto& [s, t, z] = places.place[i];
      CHECK(pressed_depth(b, crushed, back.data(), s, t) == Approx(std::max(0.0, z - at(back, s, t))).margin(1e-9 * b.limit));
    }
    last = g;
  }
  CHECK(crushed.planes >= 3);
}

TEST_CASE("what crushing takes closes the balance of every step", "[laws][crushing][energy]") {
  const auto& corners = faces[std::size_t(GENERATE(0, 2))];
  const CompressionFace b = face(corners);
  CrushedFace crushed;
  // Gaps that circle the face at varying depth, with more planes than a face can keep.
  const auto gap = [&](double x) {
    const double depth = b.limit * (0.5 + 1.5 * std::sin(0.37 * x) * std::sin(0.37 * x));
    return Gap{-depth, 9 * b.limit * std::cos(x), 9 * b.limit * std::sin(x)};
  };
  Gap before = gap(0);
  double taken = crush(b, crushed, Gap{1, 0, 0}.data(), before.data());
  CHECK(taken > 0);
  Pressed p0 = pressed(b, crushed, before.data());
  double work = 0, stored = -p0.energy, error = 0;
  taken = 0;
  const int steps = 6000;
  for (int i = 1; i <= steps; ++i) {
    const Gap now = gap(20.0 * i / steps);
    const double crushing = crush(b, crushed, before.data(), now.data());
    const Pressed p1 = pressed(b, crushed, now.data());
    const double done =
        -0.5 * ((p0.force + p1.force) * (now[0] - before[0]) + (p0.s + p1.s) * (now[1] - before[1]) + (p0.t + p1.t) * (now[2] - before[2]));
    error = std::max(error, std::fabs(done - crushing - (p1.energy - p0.energy)));
    work += done, taken += crushing;
    before = now, p0 = p1;
  }
  stored += p0.energy;
  CHECK(crushed.planes == CrushedFace::most);
  CHECK(taken > 0.05 * work);
  CHECK(std::fabs(work - taken - stored) < 1e-6 * taken);  // start and end of compression within a step: an error of third order
  CHECK(error < 1e-6 * taken);
}

TEST_CASE("planes that a face has no room for are those that matter least", "[laws][crushing]") {
  const CompressionFace b = face(faces[0]);
  YieldingPlaces places(faces[0], 300);
  CrushedFace crushed;
  Gap last{1, 0, 0};
  for (int i = 0; i <= 400; ++i) {  // once around the face
    const double x = 2 * 3.14159265358979 * i / 400;
    const Gap g{-0.6 * b.limit, 9 * b.limit * std::cos(x), 9 * b.limit * std::sin(x)};
    crush(b, crushed, last.data(), g.data());
    places.go(g, b.limit);
    last = g;
  }
  const Gap all_over{-0.9 * b.limit, 0, 0};
  check(pressed(b, crushed, all_over.data()), places.press(all_over, b.kn), b.kn * b.limit * 0.3 * 0.12, 0.01);
}

TEST_CASE("below fc nothing is crushed, above it unloading is elastic", "[laws][crushing]") {
  const CompressionFace b = face(faces[0]);
  CrushedFace crushed;
  const Gap rest{0, 0, 0}, below{-0.5 * b.limit, 3 * b.limit, 0}, above{-1.5 * b.limit, 8 * b.limit, 0};
  CHECK(crush(b, crushed, rest.data(), below.data()) == 0);
  CHECK(crushed.planes == 0);
  CHECK(crush(b, crushed, below.data(), above.data()) > 0);
  CHECK(crushed.planes == 1);
  const double h = 1e-3 * b.limit, area = 0.3 * 0.12;
  Gap lighter = above;
  lighter[0] += h;
  // The part in contact unloads with the elastic stiffness of the face.
  double contact = 0.3;
  const double heel = (1.5 * b.limit) / (8 * b.limit);  // s of zero gap
  contact = std::min(0.3, heel + 0.15);
  const double change = pressed(b, crushed, above.data()).force - pressed(b, crushed, lighter.data()).force;
  CHECK(change == Approx(b.kn * h * area * contact / 0.3).epsilon(1e-3));
  CHECK(crush(b, crushed, above.data(), lighter.data()) == 0);
  CHECK(crush(b, crushed, lighter.data(), above.data()) == 0);
}
