#include "engine/loads/record/record.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/units.h"
#include "engine/loads/loads.h"
#include "engine/loads/record/record_report.h"
#include "tests/support/places.h"

using namespace erbs;

namespace {

Record el_centro(double time_factor = 1, double peak = 0) {
  Record record;
  record.file = test::in_source("/scenes/records/elcentro_1940_ns.csv");
  record.time_factor = time_factor;
  record.peak = peak;
  return read_record(record);
}

}  // namespace

TEST_CASE("El Centro has the numbers known of it", "[loads][record]") {
  const RecordReport r = report(el_centro());
  CHECK(r.points == 1559);
  CHECK(r.dt == Approx(0.02));
  CHECK(r.duration == Approx(31.18));
  CHECK(r.pga.value / standard_g == Approx(-0.31882).epsilon(1e-12));
  CHECK(std::abs(r.pgv.value) == Approx(0.3609).margin(5e-5));
  CHECK(std::abs(r.pgd.value) == Approx(0.2120).margin(5e-5));
  CHECK(r.end_velocity == Approx(6.8e-4).margin(5e-6));
  CHECK(r.end_displacement == Approx(-5.3e-3).margin(5e-5));
  // Reference: a scan with 200 points per piece.
  CHECK(std::abs(r.true_pgv.value) == Approx(0.36199786).epsilon(1e-6));
  CHECK(std::abs(r.true_pgd.value) == Approx(0.21197524).epsilon(1e-6));
}

TEST_CASE("the file of El Centro is the one of the catalogue", "[loads][record]") {
  const Record record = el_centro();
  CHECK(record.acceleration.values[0] == 0);  // at rest at t = 0
  CHECK(record.acceleration.times[1] == Approx(0.02));
  CHECK(record.acceleration.values[1] == Approx(0.0063 * standard_g));
  CHECK(record.hash.size() == 16);
}

TEST_CASE("a record scales in amplitude and time", "[loads][record]") {
  const Record plain = el_centro(), scaled = el_centro(0.707, 0.4 * standard_g);
  const double f = 0.707, a = 0.4 / 0.31882;
  const RecordReport r = report(plain), s = report(scaled);
  CHECK(s.pga.value == Approx(a * r.pga.value));
  CHECK(std::abs(s.pga.value) == Approx(0.4 * standard_g));
  CHECK(s.dt == Approx(0.01414));
  CHECK(s.true_pgv.value == Approx(a * f * r.true_pgv.value));
  CHECK(s.true_pgd.value == Approx(a * f * f * r.true_pgd.value));
  CHECK(s.arias == Approx(a * a * f * r.arias));
  CHECK(s.time_95 == Approx(f * r.time_95));
}

TEST_CASE("a record starts late, and its ground goes on at its end velocity", "[loads][record]") {
  Record record = el_centro();
  const double v = area(record, 40), d = double_area(record, 40);
  CHECK(v == Approx(record.acceleration.area.back()));
  CHECK(d == Approx(record.acceleration.double_area.back() + (40 - 31.18) * v));
  record.start = 2.5;
  const Wave wave = record;
  CHECK(value(wave, 2.5 + 2.04) == Approx(-0.31882 * standard_g));
  CHECK(value(wave, 2.4) == 0);
  CHECK(integral(wave, 42.5) == Approx(v));
  CHECK(second_integral(wave, 42.5) == Approx(d));
  CHECK(end_time(wave) == Approx(33.68));
}

TEST_CASE("peak and scale are not both obeyed", "[loads][record]") {
  Record record;
  record.file = test::in_source("/scenes/records/elcentro_1940_ns.csv");
  record.peak = 1;
  record.scale = 2;
  CHECK_THROWS_WITH(read_record(record, {"scene.lua", 7}), Catch::Contains("scene.lua:7") && Catch::Contains("one of them"));
}

TEST_CASE("the report of a ramp is the one on paper", "[loads][record]") {
  Record record;
  record.acceleration = make_polyline({0, 1, 1.4}, {1, -1, 0});
  const RecordReport r = report(record);
  CHECK(r.true_pgv.value == Approx(0.25));  // at 0.5, where the acceleration changes sign
  CHECK(r.true_pgv.time == Approx(0.5));
  CHECK(r.pgv.value == Approx(-0.2));
  CHECK(r.end_velocity == Approx(-0.2));
  CHECK(r.true_pgd.value == Approx(1.0 / 6));  // v = t - t^2 is 0 at 1: 1/2 - 1/3
  CHECK(r.true_pgd.time == Approx(1));
  CHECK(r.arias == Approx(pi / (2 * standard_g) * (1.0 / 3 + 0.4 / 3)));
  // Int_0^t (1 - 2s)^2 ds = (1 - (1 - 2t)^3) / 6 is 5 % of 1.4 / 3.
  CHECK(r.time_5 == Approx((1 - std::cbrt(1 - 6 * 0.05 * 1.4 / 3)) / 2));
  CHECK(r.time_5 < r.time_95);
}

TEST_CASE("the response spectrum is exact", "[loads][record]") {
  // Long constant acceleration: the oscillator peaks at (1 + exp(-pi z / sqrt(1 - z^2))) times its static deflection.
  const Polyline step = make_polyline({0, 20}, {2, 2});
  const double overshoot = 1 + std::exp(-pi * 0.05 / std::sqrt(1 - 0.0025));
  for (const ResponsePoint& point : response_spectrum(step, {0.1, 0.5, 2}, 0.05))
    CHECK(point.acceleration == Approx(2 * overshoot).epsilon(3e-3));
  // A piece that lasts a year must not take long, and its far end counts.
  CHECK(response_spectrum(make_polyline({0, 3e7}, {0, 5}), {0.02}, 0.05)[0].acceleration == Approx(5).epsilon(1e-3));
  // A half-sine pulse of duration t_d = T / 4 on an undamped oscillator. Shock spectrum of the half-cycle sine pulse for t_d / T < 1/2
  // (Chopra, Dynamics of Structures): 4 (t_d/T) cos(pi t_d/T) / (1 - 4 (t_d/T)^2).
  std::vector<double> times, values;
  for (int i = 0; i <= 2000; ++i) {
    times.push_back(i / 2000.0);
    values.push_back(std::sin(pi * i / 2000.0));
  }
  const double ratio = 0.25;
  const double expected = 4 * ratio * std::cos(pi * ratio) / (1 - 4 * ratio * ratio);
  CHECK(response_spectrum(make_polyline(times, values), {4}, 0)[0].acceleration == Approx(expected).epsilon(4e-3));
}

TEST_CASE("the spectrum begins at the peak of the ground and does not depend on the points", "[loads][record]") {
  const Record record = el_centro();
  const Polyline& a = record.acceleration;
  const std::vector<double> periods{0.02, 0.1, 0.5, 2};
  const auto coarse = response_spectrum(a, periods, 0.05);
  std::vector<double> times, values;  // the same polyline with three points for each point
  for (size_t i = 0; i + 1 < a.times.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      times.push_back(a.times[i] + k * (a.times[i + 1] - a.times[i]) / 3);
      values.push_back(value_inside(a, times.back()));
    }
  const auto fine = response_spectrum(make_polyline(times, values), periods, 0.05);
  for (size_t i = 0; i < periods.size(); ++i) CHECK(fine[i].displacement == Approx(coarse[i].displacement).epsilon(4e-3));
  CHECK(coarse[0].acceleration == Approx(0.31882 * standard_g).epsilon(0.05));
}
