// Compressive strength that softens with the crushed depth, in closed form over a face, against places that soften one by one.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "engine/laws/crushing.h"
#include "engine/laws/mortar.h"
#include "tests/unit/laws/faces.h"

using namespace erbs;

namespace {

using test::at;
using test::faces;
using test::Gap;

CompressionFace face(const std::vector<double>& corners, double ultimate) {
  return {1e10, 1e-4, int(corners.size()) / 2, corners.data(), ultimate};
}

double area_of(const std::vector<double>& corners) {
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); k += 2) {
    const std::size_t l = (k + 2) % corners.size();
    twice += corners[k] * corners[l + 1] - corners[l] * corners[k + 1];
  }
  return 0.5 * twice;
}

// Independent points of equal area. Each knows its crushed depth w; it yields where kn (u - w) would exceed fc (1 - w / ultimate).
struct SofteningPlaces : test::Grid {
  explicit SofteningPlaces(const std::vector<double>& corners, int n = 500) : Grid(corners, n) {}
  void go(const CompressionFace& f, const Gap& g) {
    for (auto& [s, t, w] : place) {
      const double u = -at(g, s, t), left = std::max(0.0, 1 - w / f.ultimate);
      if (u - w <= f.limit * left) continue;
      w = u < f.ultimate ? (u - f.limit) / (1 - f.limit / f.ultimate) : u;  // kn (u - w) = fc (1 - w / ultimate)
    }
  }
  Pressed press(const CompressionFace& f, const Gap& g) const {
    Pressed sum;
    for (const auto& [s, t, w] : place) {
      const double y = w < f.ultimate ? std::max(0.0, -w - at(g, s, t)) : 0;
      sum.force += f.kn * y * area, sum.s += f.kn * y * s * area, sum.t += f.kn * y * t * area, sum.energy += 0.5 * f.kn * y * y * area;
    }
    return sum;
  }
  double lost(const CompressionFace& f) const {
    double sum = 0;
    for (const auto& [s, t, w] : place) sum += std::min(1.0, w / f.ultimate);
    return sum / double(place.size());
  }
};

}  // namespace

TEST_CASE("a face that softens presses as its places do one by one", "[laws][crushing][softening]") {
  const auto& corners = faces[std::size_t(GENERATE(0, 1, 2))];
  const CompressionFace b = face(corners, GENERATE(1.5e-4, 4e-4, 2e-3));
  SofteningPlaces places(corners);
  CrushedFace crushed;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const double whole = b.kn * b.limit * area_of(corners);
  Gap last{1e-3, 0, 0};
  for (int i = 0; i < 9; ++i) {
    const double depth = b.ultimate * (0.25 + 0.12 * i);
    const Gap g{-0.5 * depth, 4 * depth * any(random), 5 * depth * any(random)};
    crush(b, crushed, last.data(), g.data());
    places.go(b, g);
    const Gap back{g[0] + 0.6 * b.limit, 0.9 * g[1], g[2]};
    for (const Gap& gap : {g, back}) {
      const Pressed a = pressed(b, crushed, gap.data()), c = places.press(b, gap);
      CHECK(std::fabs(a.force - c.force) < 0.01 * whole);  // the grid errs at its borders
      CHECK(std::fabs(a.s - c.s) < 0.001 * whole);
      CHECK(std::fabs(a.t - c.t) < 0.001 * whole);
      CHECK(std::fabs(a.energy - c.energy) < 0.01 * whole * b.limit);
    }
    CHECK(lost_strength(b, crushed) == Approx(places.lost(b)).margin(0.01));
    for (std::size_t k = 0; k < places.place.size(); k += 997) {
      const auto& [s, t, w] = places.place[k];
      const double y = w < b.ultimate ? std::clamp(-w - at(back, s, t), 0.0, b.limit) : 0;
      CHECK(pressed_depth(b, crushed, back.data(), s, t) == Approx(y).margin(1e-9 * b.limit));
      CHECK(std::min(crushed_depth(b, crushed, s, t), b.ultimate) == Approx(std::min(w, b.ultimate)).margin(1e-9 * b.ultimate));
    }
    last = g;
  }
}

TEST_CASE("uniform crushing takes Gc per area, for any stiffness, face and step", "[laws][crushing][softening][energy]") {
  const auto& corners = faces[std::size_t(GENERATE(0, 1, 2))];
  const double fc = GENERATE(2e6, 10e6), kn = GENERATE(1e10, 3e10, 2e11), Gc = fc * GENERATE(1.6e-3, 0.8e-3);
  const int steps = GENERATE(200, 1000, 5000);
  const CompressionFace b{kn, fc / kn, int(corners.size()) / 2, corners.data(), 2 * Gc / fc};
  CrushedFace crushed;
  const double area = area_of(corners);
  double taken = 0, work = 0, peak = 0, last_force = 0;
  Gap before{0, 0, 0};
  for (int i = 1; i <= steps; ++i) {
    const Gap now{-1.1 * b.ultimate * i / steps, 0, 0};
    taken += crush(b, crushed, before.data(), now.data());
    const Pressed p = pressed(b, crushed, now.data());
    work += 0.5 * (p.force + last_force) * (before[0] - now[0]);
    peak = std::max(peak, p.force);
    // The envelope: fc (1 - w / ultimate), w the crushed depth.
    const double w = crushed_depth(b, crushed, 0, 0);
    if (w > 0 && w < b.ultimate) CHECK(p.force == Approx(area * fc * (1 - w / b.ultimate)).epsilon(1e-9));
    before = now, last_force = p.force;
  }
  CHECK(last_force == 0);
  CHECK(lost_strength(b, crushed) == Approx(1));
  CHECK(taken == Approx(work).epsilon(1e-12));  // nothing stays stored
  // The steps in which crushing begins and ends cut a corner of the curve: at most half a step of closing times the change of pressure.
  const double step = 1.1 * b.ultimate / steps, corner = step * step * kn;
  CHECK(std::fabs(taken - area * Gc) < area * corner);
  CHECK(peak <= area * fc * (1 + 1e-12));
  CHECK(crushed.planes == 1);
}

TEST_CASE("the balance of every step closes while a face softens", "[laws][crushing][softening][energy]") {
  const auto& corners = faces[std::size_t(GENERATE(0, 2))];
  const CompressionFace b = face(corners, 1e-3);
  CrushedFace crushed;
  // A face that rocks about both axes, deeper from turn to turn.
  const auto gap = [&](double x) {
    return Gap{-b.limit * (0.5 + 0.4 * x), 9 * b.limit * (1 + 0.3 * x) * std::sin(2 * x), 9 * b.limit * std::cos(1.3 * x)};
  };
  Gap before{0, 0, 0};
  Pressed p0;
  double work = 0, taken = 0, error = 0;
  const int steps = 20000;
  for (int i = 1; i <= steps; ++i) {
    const double x = 20.0 * i / steps;
    Gap now = gap(x);
    for (double& part : now) part *= std::min(1.0, 10.0 * i / steps);
    const double crushing = crush(b, crushed, before.data(), now.data());
    const Pressed p1 = pressed(b, crushed, now.data());
    const double done =
        -0.5 * ((p0.force + p1.force) * (now[0] - before[0]) + (p0.s + p1.s) * (now[1] - before[1]) + (p0.t + p1.t) * (now[2] - before[2]));
    error = std::max(error, std::fabs(done - crushing - (p1.energy - p0.energy)));
    work += done, taken += crushing;
    before = now, p0 = p1;
  }
  CHECK(lost_strength(b, crushed) > 0.5);
  CHECK(std::fabs(work - taken - p0.energy) < 1e-5 * taken);  // contact that begins or ends within a step: third order
  CHECK(error < 1e-6 * taken);
  CHECK(taken < 5e-4 * b.kn * b.limit * area_of(corners) * 1.001);  // at most Gc over the area
}

TEST_CASE("without a fracture energy the bed is the plateau it was, to the bit", "[laws][crushing][softening]") {
  CompressionFace plateau = face(faces[2], 0), endless = face(faces[2], 1e9);
  CrushedFace a, c;
  Gap last{0, 0, 0};
  for (int i = 1; i < 8; ++i) {
    const Gap g{-3e-5 * i, 2e-3 * std::sin(1.0 * i), 1e-3 * std::cos(2.0 * i)};
    const double work = crush(plateau, a, last.data(), g.data());
    CHECK(crush(endless, c, last.data(), g.data()) == Approx(work).epsilon(1e-9));
    CHECK(pressed(endless, c, g.data()).force == Approx(pressed(plateau, a, g.data()).force).epsilon(1e-9));
    last = g;
  }
  CHECK(lost_strength(plateau, a) == 0);
}

TEST_CASE("a mortar that would snap back in compression is refused with the least Gc", "[laws][crushing][softening]") {
  Mortar m;
  m.kn = 1e10, m.ks = 4e9, m.fc = 10e6;
  const auto mistakes = [](const Mortar& of) {
    std::string all;
    for (const auto& mistake : of.mistakes()) all += mistake;
    return all;
  };
  m.Gc = 16e3;
  CHECK(mistakes(m).empty());
  CHECK(m.compile().crush_depth == Approx(3.2e-3));       // twice the usual Gc / fc = 1.6 mm
  CHECK(m.compile().closing_ultimate == Approx(3.2e-3));  // where the strength has gone, so has the bond
  m.uc_ultimate = 2e-3;
  CHECK(m.compile().closing_ultimate == Approx(2e-3));
  m.Gc = 4e3;
  CHECK_THAT(mistakes(m), Catch::Contains("Gc = 4000 J/m2") && Catch::Contains("fc^2 / (2 kn) = 5000 J/m2") && Catch::Contains("16000"));
  m.Gc = 16e3, m.kn_cracked = 2e9;
  CHECK_THAT(mistakes(m), Catch::Contains("fc^2 / (2 kn_cracked) = 25000 J/m2"));
  m.kn_cracked = 0, m.fc = 0;
  CHECK_THAT(mistakes(m), Catch::Contains("give fc"));
}
