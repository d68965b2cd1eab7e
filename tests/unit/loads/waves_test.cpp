#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/loads/earlier.h"

using namespace erbs;

namespace {

// One wave of each kind, with jumps at both ends and no round numbers.
std::vector<Wave> examples() {
  Record record;
  record.start = 0.11;
  record.acceleration = make_polyline({0.02, 0.13, 0.9}, {1.0, -2.0, 0.5});
  return {Sine{2, 1.3, 0.4, 0.137, 0.71},
          Sine{2, 1.3, 0.4, -0.33},
          HalfSine{3, 0.9, 0.7, 0.21},
          FullSine{-1.5, 2.1, 1.1, 0.053},
          Pulse{4, 0.317, 0.2},
          Pulse{4, -0.5, 0.8},
          make_table({0.1, 0.4, 0.55}, {1, -3, 2}, false),
          make_table({-0.2, 0.4, 0.55}, {1, -3, 2}, true),
          make_curve({0.1, 0.4, 0.55, 0.9}, {1, -3, 2, 0.7}, false),
          make_curve({-0.2, 0.4, 0.55}, {1, -3, 2}, true),
          record,
          Ricker{2, 0.7, -2.2},
          Ricker{-1, 0.9, -1.5},
          FullCosine{2, 1.7, 0.17},
          MpPulse{0.4, 1.6, 0.9, 1.7, 0.12},
          MpPulse{-0.7, 1.1, -1.2, 2.6, -0.2}};
}

// Integral from t0 to t1 by the midpoint rule on n pieces, from values only.
double summed(const Wave& wave, double t0, double t1, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += value(wave, t0 + (t1 - t0) * (i + 0.5) / n);
  return sum * (t1 - t0) / n;
}

}  // namespace

TEST_CASE("integrals of every wave agree with its values", "[loads]") {
  for (const Wave& wave : examples()) {
    INFO("wave " << wave.index());
    // Tolerance: a jump of height 4 misplaced by half a piece, 4 * 1.5 / 2e5 / 2, twice.
    for (const double t : {0.05, 0.3, 0.6, 1.5}) {
      CHECK(integral(wave, t) == Approx(summed(wave, 0, t, 200000)).margin(3e-5));
      double sum = 0;
      for (int i = 0; i < 4000; ++i) sum += integral(wave, t * (i + 0.5) / 4000) * t / 4000;
      CHECK(second_integral(wave, t) == Approx(sum).margin(1e-6));
    }
    CHECK(integral(wave, 0) == 0);
    CHECK(second_integral(wave, 0) == 0);
  }
}

TEST_CASE("the means of steps add up to the integral, whatever the step and wherever an edge lies", "[loads]") {
  for (const Wave& wave : examples())
    for (const double dt : {1.0 / 7, 0.01, 3.7e-4}) {
      INFO("wave " << wave.index() << " dt " << dt);
      double impulse = 0, t = 0;
      while (t < 1.4) {
        impulse += mean(wave, t, t + dt) * ((t + dt) - t);
        t += dt;
      }
      CHECK(impulse == Approx(integral(wave, t)).margin(1e-12));
    }
}

TEST_CASE("the mean over a microsecond is the value to round-off", "[loads]") {
  // A difference of integrals would err by 1e-16 / 1e-6 = 1e-10 and more.
  const double t = 0.4571;
  for (const Wave& wave : examples()) {
    INFO("wave " << wave.index());
    const double middle = 0.5 * (t + (t + 1e-6));
    CHECK(mean(wave, t, t + 1e-6) == Approx(value(wave, middle)).epsilon(1e-11).margin(1e-14));
    CHECK(mean(wave, t, t) == value(wave, t));
  }
}

TEST_CASE("pulses last as long as their phase leaves", "[loads]") {
  // A half-sine of 2 Hz that starts at 30 deg ends after 150/360 of 0.5 s; its impulse is a / omega (cos psi + 1).
  const HalfSine half{3, 2, pi / 6, 0.25};
  CHECK(end_time(half) == Approx(0.25 + 150.0 / 360 * 0.5));
  CHECK(integral(half, 10) == Approx(3 / (4 * pi) * (std::cos(pi / 6) + 1)));
  CHECK(value(half, 0.25) == Approx(1.5));
  CHECK(value(half, 0.2499999) == 0);
  CHECK(value(half, end_time(half) + 1e-12) == 0);
  const FullSine full{3, 2, 0, 0};
  CHECK(end_time(full) == Approx(0.5));
  CHECK(integral(full, 10) == Approx(0).margin(1e-15));
  CHECK(second_integral(full, 0.5) == Approx(3 * 0.5 / (4 * pi)));  // a T / omega
  CHECK(std::isinf(end_time(Sine{1, 1})));
}

TEST_CASE("pulses leave the ground as their formulas say", "[loads]") {
  const double a = 3, f = 1.6, w = 2 * pi * f;
  const auto leaves = [](const Wave& wave, double v, double d) {
    const double end = end_time(wave);
    CHECK(integral(wave, end) == Approx(v).margin(1e-14));
    CHECK(second_integral(wave, end) == Approx(d).margin(1e-14));
    CHECK(second_integral(wave, end + 2) == Approx(d + 2 * v).margin(1e-13));
  };
  leaves(HalfSine{a, f}, 2 * a / w, pi * a / (w * w));
  leaves(FullSine{a, f}, 0, 2 * pi * a / (w * w));
  leaves(FullCosine{a, f}, 0, 0);
  leaves(Ricker{a, f}, 0, 0);
  for (const double gamma : {1.01, 1.5, 2.0, 2.6, 3.0})
    for (const double nu : {0.0, 0.5 * pi, -0.5 * pi, 1.1}) {
      INFO("gamma " << gamma << " nu " << nu);
      const MpPulse pulse{a, f, nu, gamma};
      leaves(pulse, 0, residual_displacement(pulse));
      CHECK(end_time(pulse) == Approx(gamma / f));
    }
  CHECK(residual_displacement(MpPulse{a, f, 0, 2}) == Approx(0).margin(1e-15));
  CHECK(residual_displacement(MpPulse{a, f, pi / 2, 1.4}) == Approx(0).margin(1e-15));
}

TEST_CASE("the pulse of Mavroeidis and Papageorgiou is the one of their equations", "[loads]") {
  // Velocity by eq. (3), acceleration by eq. (4), written out as there.
  for (const double gamma : {1.2, 2.0, 3.4})
    for (const double nu : {0.0, 0.7, 2.4}) {
      const double A = 0.8, fp = 0.6, start = 0.3, t0 = start + 0.5 * gamma / fp;
      const MpPulse pulse{A, fp, nu, gamma, start};
      CHECK(value(pulse, start) == Approx(0).margin(1e-13));
      for (int i = 0; i <= 40; ++i) {
        const double t = start + gamma / fp * i / 40, x = 2 * pi * fp * (t - t0);
        CHECK(area(pulse, t) == Approx(A * 0.5 * (1 + std::cos(x / gamma)) * std::cos(x + nu)).margin(1e-14));
        if (i < 40)
          CHECK(value(pulse, t) == Approx(-A * pi * fp / gamma *
                                          (std::sin(x / gamma) * std::cos(x + nu) + gamma * std::sin(x + nu) * (1 + std::cos(x / gamma))))
                                       .margin(1e-13));
      }
    }
}

TEST_CASE("a rectangular pulse gives a step its share", "[loads]") {
  const Pulse pulse{5, 0.1, 0.2};
  CHECK(mean(pulse, 0.09, 0.11) == Approx(2.5).epsilon(1e-13));
  CHECK(mean(pulse, 0.299, 0.309) == Approx(0.5).epsilon(1e-12));
  CHECK(mean(pulse, 0, 1) == Approx(1.0).epsilon(1e-14));  // both edges in one step
  CHECK(second_integral(pulse, 1.0) == Approx(5 * 0.2 * 0.8));
}

TEST_CASE("small angles of a sine lose no digits", "[loads]") {
  // The displacement of a sine acceleration near its start is A omega t^3 / 6.
  const Sine wave{1, 1 / (2 * pi)};
  CHECK(second_integral(wave, 1e-4) == Approx(1e-12 / 6).epsilon(1e-8));
  CHECK(second_integral(wave, 0.3) == Approx(0.3 - std::sin(0.3)).epsilon(1e-12));
}

TEST_CASE("a table is linear, ends at zero or is held", "[loads]") {
  const Table zero = make_table({1, 2, 4}, {10, 20, 0}, false), held = make_table({1, 2, 4}, {10, 20, 4}, true);
  CHECK(value(zero, 1.5) == Approx(15));
  CHECK(value(zero, 0.9) == 0);
  CHECK(value(zero, 4.1) == 0);
  CHECK(value(held, 0) == 10);
  CHECK(value(held, 9) == 4);
  CHECK(integral(held, 5) == Approx(10 + 15 + 24 + 4));
  CHECK(integral(zero, 5) == Approx(15 + 20));
  CHECK_THROWS_WITH(make_table({0, 1, 1}, {0, 0, 0}, false), Catch::Contains("point 3"));
  CHECK_THROWS_WITH(make_table({0, 1}, {0, 0, 0}, false), Catch::Contains("2 times but 3 values"));
  CHECK_THROWS_WITH(make_table({0}, {0}, false), Catch::Contains("at least two"));
  CHECK_THROWS_WITH(make_table({0, 1}, {0, NAN}, false), Catch::Contains("point 2"));
}

TEST_CASE("a curve through samples of a motion follows it without jolts", "[loads]") {
  const double w = 2 * pi * 5, h = 1e-3;
  std::vector<double> times, values;
  for (int i = 0; i <= 400; ++i) times.push_back(h * i), values.push_back(0.1 * (1 - std::cos(w * h * i)));
  const Curve curve = make_curve(times, values, false);
  for (double t = 0.001; t < 0.395; t += 1.37e-4) {
    const double d = 2e-5, acceleration = (value(curve, t + d) - 2 * value(curve, t) + value(curve, t - d)) / (d * d);
    CHECK(value(curve, t) == Approx(0.1 * (1 - std::cos(w * t))).margin(1e-9));
    CHECK(acceleration == Approx(0.1 * w * w * std::cos(w * t)).margin(1e-3 * 0.1 * w * w));
  }
  const auto speed = [](const Curve& of, double t) { return (value(of, t + 1e-7) - value(of, t - 1e-7)) / 2e-7; };
  CHECK(speed(curve, 0) == Approx(0).margin(0.05));  // held from its ends on: from rest to rest
  CHECK(value(make_curve({0, 2}, {1, 5}, false), 0.5) == Approx(2));
  const Curve held = make_curve({0, 2}, {1, 5}, true);
  CHECK(value(held, 1) == Approx(3));
  CHECK(speed(held, 0) == Approx(0).margin(1e-5));
  CHECK(speed(held, 2) == Approx(0).margin(1e-5));
  CHECK(value(held, -1) == 1);
  CHECK(value(held, 3) == 5);
  CHECK(value(make_curve({0, 1, 2}, {0, 1, 0}, false), 2.1) == 0);
  CHECK_THROWS_WITH(make_curve({0, 1, 1}, {0, 0, 0}, false), Catch::Contains("point 3"));
}

TEST_CASE("a segment is found in uneven tables", "[loads]") {
  const Polyline line = make_polyline({0, 1e-3, 2e-3, 5, 6, 100}, {0, 1, 2, 3, 4, 5});
  for (size_t i = 0; i + 1 < line.times.size(); ++i) {
    CHECK(segment(line, line.times[i]) == static_cast<int>(i));
    CHECK(segment(line, 0.5 * (line.times[i] + line.times[i + 1])) == static_cast<int>(i));
  }
  CHECK(segment(line, -1) == 0);
  CHECK(segment(line, 1000) == 4);
}

TEST_CASE("an earlier wave is the same one, moved", "[loads]") {
  for (const Wave& wave : examples())
    for (const double t : {-0.3, 0.05, 0.2, 0.41, 0.7, 1.3})
      CHECK(value(earlier(wave, 0.25), t) == Approx(value(wave, t + 0.25)).margin(1e-12));
}
