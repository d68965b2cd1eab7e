// The performance point of curves and shapes that are known by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/performance/performance.h"
#include "engine/record/performance/performance_figure.h"
#include "engine/record/performance/performance_folder.h"
#include "tests/support/folder.h"

using namespace erbs;

namespace {

DesignSpectrum en_b(double ag) {
  DesignSpectrum s;
  s.kind = "EN 1998-1 type 1", s.ground = "B", s.ag = ag;
  return s;
}

// An elastic and perfectly plastic oscillator.
BilinearCurve plastic(double period, double yield) { return {yield * std::pow(period / (2 * pi), 2), yield, 1, 0}; }

// Of an elastic and perfectly plastic structure: `mass` (kg) at each height moves as `shape` says, 1 at the monitored point.
struct Structure {
  BaseShearCurve curve;
  PushShape shape;
};
Structure structure(const std::vector<double>& mass, const std::vector<double>& phi, double yield, double at_yield, double end) {
  Structure out;
  const int steps = 40;
  for (int i = 0; i <= steps; ++i) {
    const double u = end * i / steps;
    out.curve.displacement.push_back(u);
    out.curve.shear.push_back(std::min(yield, yield * u / at_yield));
    out.curve.multiplier.push_back(out.curve.shear.back() / 1e5);
    out.curve.time.push_back(0.04 * i);
  }
  out.curve.peak = steps;
  for (std::size_t i = 0; i < mass.size(); ++i)
    out.shape.blocks.push_back(
        {"b" + std::to_string(i), i % 2 == 0 ? "even" : "odd", mass[i], double(i + 1), 0.001 * phi[i], end * phi[i]});
  out.shape.elastic = 0.001, out.shape.peak = end;
  return out;
}

PerformanceDemand demand_of(double ag) {
  PerformanceDemand demand;
  demand.spectrum = en_b(ag);
  return demand;
}

}  // namespace

TEST_CASE("a bilinear curve has the force and the energy of its curve", "[performance]") {
  SECTION("elastic and perfectly plastic: itself") {
    for (const double yield : {0.01, 0.03, 0.09}) {
      const BilinearCurve b = bilinear_curve({0, yield, 0.1}, {0, 2, 2}, 0.1);
      CHECK(b.yield_displacement == Approx(yield));
      CHECK(b.yield_acceleration == 2);
      CHECK(b.energy == Approx(2 * (0.1 - yield / 2)));
    }
  }
  SECTION("a parabola yields at two thirds") {
    std::vector<double> D, A;
    for (int i = 0; i <= 1000; ++i) D.push_back(0.05 * i / 1000), A.push_back(3 * (2 - i / 1000.0) * i / 1000);
    const BilinearCurve b = bilinear_curve(D, A, 0.05);
    CHECK(b.yield_displacement == Approx(0.05 * 2 / 3).epsilon(1e-5));
    CHECK(b.energy == Approx(b.yield_acceleration * (b.end - b.yield_displacement / 2)));
  }
  SECTION("up to a point before the end, between two points") {
    const BilinearCurve b = bilinear_curve({0, 0.01, 0.03, 0.1}, {0, 1, 1, 0.5}, 0.02);
    CHECK(b.end == 0.02);
    CHECK(b.yield_displacement == Approx(0.01));
  }
  SECTION("past a peak it keeps the peak, and the energy") {
    const BilinearCurve b = bilinear_curve({0, 0.01, 0.03}, {0, 2, 1}, 0.03);
    CHECK(b.yield_acceleration == 2);
    CHECK(b.energy == Approx(0.01 + 0.03));
    CHECK(b.yield_displacement == Approx(2 * (0.03 - 0.02)));
  }
  SECTION("a straight or stiffening curve yields at its end") {
    CHECK(bilinear_curve({0, 0.1}, {0, 2}, 0.1).yield_displacement == Approx(0.1));
    CHECK(bilinear_curve({0, 0.05, 0.1}, {0, 0.5, 2}, 0.1).yield_displacement == 0.1);
  }
  CHECK_THROWS_WITH(bilinear_curve({0, 0.1}, {0, -1}, 0.1), Catch::Contains("no load"));
}

TEST_CASE("the target displacement follows annex B.5", "[performance]") {
  const DesignSpectrum s = en_b(2);           // plateau 6 m/s2 from .15 to .5 s
  for (const double T : {0.2, 0.35, 0.49}) {  // short: below T_C
    CAPTURE(T);
    const double elastic = 6 * std::pow(T / (2 * pi), 2);
    CHECK(target_displacement(plastic(T, 8), s).target == Approx(elastic));  // q < 1
    CHECK(target_displacement(plastic(T, 6), s).target == Approx(elastic));  // q = 1
    for (const double q : {1.5, 3.0}) {
      const TargetDisplacement t = target_displacement(plastic(T, 6 / q), s);
      CHECK(t.period == Approx(T));
      CHECK(t.q == Approx(q));
      CHECK(t.target == Approx(std::min(3.0, (1 + (q - 1) * 0.5 / T) / q) * elastic));
      CHECK(t.ductility == Approx(t.target / (elastic / q)));
    }
  }
  CHECK(target_displacement(plastic(0.1, 0.02), s).target == Approx(3 * target_displacement(plastic(0.1, 0.02), s).elastic));
  for (const double T : {0.5, 1.0, 1.9, 3.0})  // long: that of the elastic oscillator, whatever q
    for (const double yield : {0.1, 1.0, 20.0})
      CHECK(target_displacement(plastic(T, yield), s).target == Approx(spectral_displacement(s, T)));
  DesignSpectrum table;
  table.kind = "table", table.period = {0, 1}, table.acceleration = {2, 2}, table.TC = 0.5;
  CHECK_THROWS_WITH(target_displacement(plastic(1.5, 1), table), Catch::Contains("T* = 1.5 s") && Catch::Contains("add rows"));
}

TEST_CASE("Gamma of small shapes is known by hand", "[performance]") {
  const PerformanceDemand demand = demand_of(2);
  const auto of = [&](const std::vector<double>& mass, const std::vector<double>& phi) {
    return participation(structure(mass, phi, 1, 0.01, 0.02).shape, demand);
  };
  const Participation two = of({2, 1}, {0.5, 1});
  CHECK(two.gamma == Approx(4.0 / 3));
  CHECK(two.mass == Approx(3));
  CHECK(two.mass_star == Approx(2));
  CHECK(two.effective_mass == Approx(8.0 / 3));
  CHECK(of({5}, {1}).gamma == Approx(1));
  // Eight equal masses: a line 1.412, a parabola 1.488; the aqueduct of the literature has 6.19 / 4.1 = 1.510, towards a cantilever.
  std::vector<double> line, parabola, bent;
  for (int i = 1; i <= 8; ++i) line.push_back(i / 8.0), parabola.push_back(i * i / 64.0), bent.push_back(std::pow(i / 8.0, 2.5));
  const std::vector<double> equal(8, 3.0);
  CHECK(of(equal, line).gamma == Approx(1.41176).epsilon(1e-5));
  CHECK(of(equal, parabola).gamma == Approx(1.48837).epsilon(1e-5));
  CHECK(of(equal, bent).gamma > 6.185 / 4.15);  // both numbers are rounded
  CHECK(of(equal, bent).gamma < 6.195 / 4.05);
}

TEST_CASE("levels and groups gather the mass", "[performance]") {
  const Structure s = structure({1, 1, 1, 1, 2, 2}, {0.1, 0.2, 0.4, 0.6, 0.9, 1}, 1, 0.01, 0.02);
  PerformanceDemand demand = demand_of(2);
  CHECK(participation(s.shape, demand).nodes == 6);
  demand.nodes = 3;  // levels of a third of the height
  const Participation three = participation(s.shape, demand);
  CHECK(three.nodes == 3);
  CHECK(three.gamma == Approx((2 * 0.15 + 2 * 0.5 + 4 * 0.95) / (2 * 0.0225 + 2 * 0.25 + 4 * 0.9025)));
  CHECK(three.phi_top == Approx(0.95));
  CHECK(three.mass_star == Approx(2 * 0.15 + 2 * 0.5 + 4 * 0.95));
  demand.nodes = 0, demand.group = "odd";  // its shape, for the whole mass
  const Participation odd = participation(s.shape, demand);
  CHECK(odd.nodes == 3);
  CHECK(odd.mass == Approx(8));
  CHECK(odd.mass_star == Approx(8.0 / 4 * (0.2 + 0.6 + 2)));
  demand.group = "", demand.blocks = {"b1", "b3", "b5"};
  CHECK(participation(s.shape, demand).gamma == odd.gamma);
  demand.blocks = {"none"};
  CHECK_THROWS_WITH(participation(s.shape, demand), Catch::Contains("none of its blocks moves"));
  demand.group = "none";
  CHECK_THROWS_WITH(participation(s.shape, demand), Catch::Contains("group \"none\"") && Catch::Contains("leave group out"));
  PushShape still = s.shape;
  still.peak = 0;
  CHECK_THROWS_WITH(participation(still, demand_of(2)), Catch::Contains("monitor another point"));
}

TEST_CASE("an oscillator of one mass gives itself back", "[performance]") {
  const double mass = 1000;
  for (const double T : {0.25, 0.8})
    for (const double q : {0.5, 1.5, 2.5}) {
      CAPTURE(T, q);
      const DesignSpectrum s = en_b(2);
      const double Sa = spectral_acceleration(s, T), yield = Sa / q, at_yield = yield * std::pow(T / (2 * pi), 2);
      const Structure one = structure({mass}, {1}, yield * mass, at_yield, 5 * at_yield);
      const double elastic = spectral_displacement(s, T);
      const double target = T >= 0.5 || q <= 1 ? elastic : elastic / q * (1 + (q - 1) * 0.5 / T);
      for (const bool iterate : {false, true}) {
        PerformanceDemand demand = demand_of(2);
        demand.iterate = iterate;
        const Performance p = performance_of(one.curve, one.shape, demand);
        for (const PerformancePoint* point : {&p.n2, &p.mpp}) {
          CHECK(point->within_curve);
          CHECK(point->oscillator.period == Approx(T).epsilon(1e-3));
          CHECK(point->displacement == Approx(target).epsilon(2e-3));
          CHECK(point->top == Approx(target).epsilon(2e-3));
          CHECK(*point->shear == Approx(mass * std::min(yield, yield * target / at_yield)).epsilon(5e-3));
          CHECK(*point->time == Approx(0.04 * 40 * point->displacement / (5 * at_yield)));
          CHECK(std::abs(*point->nearest - point->displacement) <= 0.5 * 5 * at_yield / 40 + 1e-12);
        }
      }
    }
}

TEST_CASE("two masses: both variants by hand", "[performance]") {
  // Gamma = 4/3, M = 3000 kg, m* = 2000 kg; yields at 6 kN and 20 mm.
  const Structure s = structure({2000, 1000}, {0.5, 1}, 6000, 0.02, 0.2);
  const Performance p = performance_of(s.curve, s.shape, demand_of(1));
  CHECK(p.mpp.bilinear.yield_acceleration == Approx(2));
  CHECK(p.n2.bilinear.yield_acceleration == Approx(6000 / (4.0 / 3) / 2000));  // F* / m*
  for (const PerformancePoint* point : {&p.mpp, &p.n2}) {
    CHECK(point->bilinear.yield_displacement == Approx(0.015));
    const double T = 2 * pi * std::sqrt(0.015 / point->bilinear.yield_acceleration);
    CHECK(point->oscillator.period == Approx(T));
    CHECK(point->oscillator.target == Approx(spectral_displacement(en_b(1), T)));
    CHECK(point->displacement == Approx(4.0 / 3 * point->oscillator.target));
  }
  // The terminal leads with the displacement that erbs report and `--push-to` name.
  CHECK(performance_text(to_json(p)).find(fmt::format("monitored point at {:.4g} mm (top", 1e3 * p.n2.displacement)) != std::string::npos);
  CHECK(to_json(p)["n2"]["yield_force_N"].get<double>() == Approx(4500));
  CHECK(to_json(p)["mpp"]["yield_force_N"].get<double>() == Approx(6000));
}

TEST_CASE("a demand beyond the curve is a verdict", "[performance]") {
  const Structure s = structure({1000}, {1}, 500, 0.01, 0.03);
  const Performance p = performance_of(s.curve, s.shape, demand_of(5));
  CHECK_FALSE(p.n2.within_curve);
  CHECK_FALSE(p.n2.shear);
  const Json json = to_json(p);
  CHECK(json["n2"]["verdict"] == "the demand exceeds the capacity");
  CHECK(json["n2"]["time_s"].is_null());
  CHECK(performance_text(json).find("the demand exceeds the capacity") != std::string::npos);
  CHECK(!performance_figure(p, en_b(5), "beyond").empty());
}

TEST_CASE("periods whose names would run into each other are named to either side", "[performance]") {
  const Structure s = structure({1000}, {1}, 3000, 0.012, 0.3);  // T* = 0.397 s beside the corner at 0.5 s
  const plot::Figure figure = performance_figure(performance_of(s.curve, s.shape, demand_of(2)), en_b(2), "close");
  std::vector<std::string> looks;
  for (const plot::Label& label : figure.panels.front().labels)
    if (label.text.starts_with("T* =") || label.text == "0.5 s") looks.push_back(label.look.substr(0, label.look.find(' ')));
  CHECK(looks == std::vector<std::string>{"right", "left"});
}

TEST_CASE("periods whose lines leave the sheet close to each other at the right are named one behind the other", "[performance]") {
  const Structure s = structure({1000}, {1}, 100, 0.0912, 0.3);  // T* = 6 s beside the corner at 8 s
  PerformanceDemand demand = demand_of(2);
  demand.spectrum.TD = 8;
  const plot::Figure figure = performance_figure(performance_of(s.curve, s.shape, demand), demand.spectrum, "close");
  double corner = 0, own = 0;  // mm, where the names begin
  for (const plot::Label& label : figure.panels.front().labels) {
    if (label.text.starts_with("T* =")) own = std::stod(label.at.substr(6));
    if (label.text == "8 s") corner = std::stod(label.at.substr(6));
  }
  CHECK(corner > 0);
  CHECK(corner < 0.85 * own);
}

TEST_CASE("a target where a push has leapt over all states is refused", "[performance]") {
  const double mass = 1000, T = 0.8;
  const double yield = spectral_acceleration(en_b(2), T) / 2.5, at_yield = yield * std::pow(T / (2 * pi), 2);
  Structure s = structure({mass}, {1}, yield * mass, at_yield, 5 * at_yield);  // target: 2.5 at_yield
  CHECK(performance_of(s.curve, s.shape, demand_of(2)).n2.within_curve);
  std::vector<double>* const rows[] = {&s.curve.displacement, &s.curve.shear, &s.curve.multiplier, &s.curve.time};
  for (std::vector<double>* row : rows) row->erase(row->begin() + 9, row->begin() + 39);  // from at_yield to nearly the end
  s.curve.peak = int(s.curve.displacement.size()) - 1;
  CHECK_THROWS_WITH(performance_of(s.curve, s.shape, demand_of(2)), Catch::Contains("far from either; push with shorter steps"));
}

TEST_CASE("a yield displacement between two states far apart is refused", "[performance]") {
  // A block on a bed slides at .3 g: the springs of the bed yield at a micrometre, the next state is a millimetre away.
  Structure s = structure({1000}, {1}, 1, 1, 0.2);
  const auto slides = [&](double first) {
    BaseShearCurve curve;
    for (double u = 0; u < 0.9e-6; u += 0.25e-6) curve.displacement.push_back(u);
    for (double u = first; u < 0.02; u *= 1.5) curve.displacement.push_back(u);
    for (const double u : curve.displacement) {
      curve.shear.push_back(1000 * 0.3 * 9.81 * std::min(1.0, u / 1e-6));
      curve.multiplier.push_back(curve.shear.back() / 9810), curve.time.push_back(u);
    }
    curve.peak = int(curve.displacement.size()) - 1;
    return performance_of(curve, s.shape, demand_of(4)).n2;
  };
  CHECK_THROWS_WITH(slides(1e-3), Catch::Contains("yield displacement") && Catch::Contains("push with shorter steps"));
  CHECK(slides(1e-6).bilinear.yield_displacement == Approx(1e-6).epsilon(1e-3));
}

TEST_CASE("iteration draws the bilinear curve up to the target", "[performance]") {
  // Stiff at first, then soft up to a peak far away: the curve up to the peak would give too long a period.
  Structure s = structure({1000}, {1}, 1, 1, 0.2);
  for (std::size_t i = 0; i < s.curve.displacement.size(); ++i) {
    const double u = s.curve.displacement[i];
    s.curve.shear[i] = u < 0.02 ? 1e5 * u : 2000 + 5000 * (u - 0.02);
  }
  PerformanceDemand demand = demand_of(1);
  const Performance once = performance_of(s.curve, s.shape, demand);
  demand.iterate = true;
  const Performance repeated = performance_of(s.curve, s.shape, demand);
  CHECK(once.n2.bilinear.end == Approx(0.2));
  CHECK(repeated.n2.bilinear.end == Approx(repeated.n2.oscillator.target).epsilon(1e-5));
  CHECK(repeated.n2.oscillator.period < once.n2.oscillator.period);
  CHECK(repeated.n2.rounds > 2);
}

TEST_CASE("iteration finds the end where the target falls so steeply that steps jump over it", "[performance]") {
  // A = 2 tanh(u / u0) m/s2, at first with the period .03 s: just beyond yield, the target falls 30 times as fast as the end grows.
  const double u0 = 2 * std::pow(0.03 / (2 * pi), 2);
  Structure s = structure({1000}, {1}, 1, 1, 20 * u0);
  BaseShearCurve curve;
  for (int i = 0; i <= 200; ++i) {
    curve.displacement.push_back(0.1 * u0 * i), curve.shear.push_back(2000 * std::tanh(0.1 * i));
    curve.multiplier.push_back(1e-5 * curve.shear.back()), curve.time.push_back(0.04 * i);
  }
  curve.peak = 200;
  PerformanceDemand demand = demand_of(1);
  demand.iterate = true;
  const PerformancePoint p = performance_of(curve, s.shape, demand).n2;
  CHECK(p.oscillator.target == Approx(4.815183e-5).epsilon(2e-6));  // by bisection beside
  CHECK(p.bilinear.end == Approx(p.oscillator.target).epsilon(2e-6));
  CHECK(p.rounds > 100);
}

TEST_CASE("a curve without load has no performance point", "[performance][bad_input]") {
  Structure s = structure({1000}, {1}, 1000, 0.01, 0.03);
  s.curve.peak = 0;
  CHECK_THROWS_WITH(performance_of(s.curve, s.shape, demand_of(2)), Catch::Contains("no state"));
}

TEST_CASE("the shape of a push survives its file", "[performance]") {
  const test::Folder dir;
  PushShape shape = structure({1, 2.5}, {0.123456789012345, 1}, 1, 0.01, 0.02).shape;
  shape.blocks[0].name = "pier, left", shape.blocks[1].group = "";
  write_shape(dir.path.string(), shape);
  const PushShape got = read_shape(dir.path.string());
  REQUIRE(got.blocks.size() == 2);
  CHECK(got.peak == shape.peak);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(got.blocks[i].mass == shape.blocks[i].mass);
    CHECK(got.blocks[i].peak == shape.blocks[i].peak);
    CHECK(got.blocks[i].group == shape.blocks[i].group);
  }
  CHECK_THROWS_WITH(read_base_shear_curve(dir.path.string()), Catch::Contains("curve.csv"));
}
