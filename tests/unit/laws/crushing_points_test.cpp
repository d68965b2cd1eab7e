// Contact points that bear a face and yield one by one, against a law of each point written out.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "engine/laws/crushing.h"
#include "tests/unit/laws/faces.h"

using namespace erbs;
using test::at;
using test::Gap;

namespace {

const std::vector<double> points{-.15, -.06, .01, .15, -.06, .02, .15, .06, .01, -.15, .06, .015, .02, .01, .03};  // s, t, area

CompressionFace face(double ultimate) { return {1e10, 1e-4, 0, nullptr, ultimate, int(points.size() / 3), points.data()}; }

// One point, closed to u: its pressure, from the deepest it has been.
struct OnePoint {
  double s, t, area, set = 0;  // m, m, m2, m
  void go(const CompressionFace& f, double u) {
    const double over = u - f.limit;
    if (set < f.ultimate || f.ultimate == 0) set = std::max(set, f.ultimate > 0 ? over / (1 - f.limit / f.ultimate) : over);
  }
  double force(const CompressionFace& f, double u) const {
    return f.ultimate > 0 && set >= f.ultimate ? 0 : f.kn * area * std::max(0.0, u - set);
  }
};

}  // namespace

TEST_CASE("points that bear a face yield one by one, and the balance of every step closes", "[laws][crushing]") {
  const CompressionFace b = face(GENERATE(0.0, 3e-4, 2e-3));
  std::vector<OnePoint> alone;
  for (std::size_t i = 0; i < points.size(); i += 3) alone.push_back({points[i], points[i + 1], points[i + 2]});
  CrushedFace crushed;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  Gap before{0, 0, 0};
  double taken = 0, work = 0, error = 0;
  for (int turn = 0; turn < 12; ++turn) {
    const Gap from = before, to{b.limit * (any(random) - 0.2 - 0.1 * turn), 12 * b.limit * any(random), 12 * b.limit * any(random)};
    const int steps = 2000;
    for (int i = 1; i <= steps; ++i) {
      Gap now;
      for (std::size_t k = 0; k < 3; ++k) now[k] = from[k] + (to[k] - from[k]) * i / steps;
      const Pressed p0 = pressed(b, crushed, before.data());
      const double crushing = crush(b, crushed, before.data(), now.data());
      const Pressed p1 = pressed(b, crushed, now.data());
      const double done = -0.5 * ((p0.force + p1.force) * (now[0] - before[0]) + (p0.s + p1.s) * (now[1] - before[1]) +
                                  (p0.t + p1.t) * (now[2] - before[2]));
      taken += crushing, work += done;
      error = std::max(error, std::fabs(done - crushing - (p1.energy - p0.energy)));
      Pressed sum;
      for (OnePoint& one : alone) {
        const double u = -at(now, one.s, one.t);
        one.go(b, u);
        const double f = one.force(b, u);
        sum.force += f, sum.s += f * one.s, sum.t += f * one.t, sum.energy += 0.5 * f * f / (b.kn * one.area);
      }
      REQUIRE(p1.force == Approx(sum.force).margin(1e-3));  // N, of some 1e5
      REQUIRE(p1.s == Approx(sum.s).margin(1e-4));
      REQUIRE(p1.t == Approx(sum.t).margin(1e-4));
      REQUIRE(p1.energy == Approx(sum.energy).margin(1e-7));
      before = now;
    }
  }
  CHECK(crushed.planes == 1);
  CHECK(taken > 0);
  CHECK(error < 1e-3 * taken);  // contact that begins, and yielding that begins or ends, within a step
  CHECK(std::fabs(work - taken - pressed(b, crushed, before.data()).energy) < 5e-3 * taken);
  double lost = 0, whole = 0;
  for (const OnePoint& one : alone) {
    CHECK(crushed_depth(b, crushed, one.s, one.t) == Approx(one.set).margin(1e-12 * b.limit));
    CHECK(pressed_depth(b, crushed, before.data(), one.s, one.t) ==
          Approx(one.force(b, -at(before, one.s, one.t)) / (b.kn * one.area)).margin(1e-9 * b.limit));
    lost += one.area * std::min(one.set, b.ultimate), whole += one.area;
  }
  CHECK(lost_strength(b, crushed) == Approx(b.ultimate > 0 ? lost / (b.ultimate * whole) : 0).margin(1e-12));
}

TEST_CASE("points below fc are not crushed", "[laws][crushing]") {
  const CompressionFace b = face(0);
  CrushedFace crushed;
  const Gap rest{0, 0, 0}, below{-0.5 * b.limit, 3 * b.limit, 0};
  CHECK(crush(b, crushed, rest.data(), below.data()) == 0);
  CHECK(crushed.planes == 0);
}
