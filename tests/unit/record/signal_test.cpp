#include "engine/record/results/signal.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"

using namespace erbs;

namespace {

struct Column {
  std::vector<double> t, y;
};

template <class F>
Column column(int n, double dt, F&& f) {
  Column c;
  for (int i = 0; i < n; ++i) c.t.push_back(i * dt), c.y.push_back(f(i * dt));
  return c;
}

}  // namespace

TEST_CASE("the peak keeps its sign and its time", "[record][signal]") {
  const SamplePeak p = peak({0, 1, 2, 3}, {1, -5, 4, 5});
  CHECK(p.value == -5);
  CHECK(p.time == 1);
  CHECK(std::isnan(peak({}, {}).value));
  CHECK(peak({0, 1, 2}, {std::nan(""), 0, 0}).time == 1);
  CHECK_THROWS_AS(peak({0}, {1, 2}), Error);
}

TEST_CASE("the mean is exact for lines between samples, the rms for what they do not resolve as well", "[record][signal]") {
  for (const double dt : {0.01, 0.004, 0.0005}) {
    const Column c = column(int(5 / dt), dt, [](double t) { return 2 * std::sin(2 * pi * 56.3 * t + 0.3); });
    CHECK(rms(c.t, c.y) == Approx(std::sqrt(2.0)).epsilon(0.01));
  }
  CHECK(rms({0, 1, 4}, {3, -3, 3}) == 3);  // uneven samples
  CHECK(mean({0, 1, 4}, {0, 1, 4}) == Approx(2.0).epsilon(1e-14));
}

TEST_CASE("the dominant frequency of a sine between bins is right to a thousandth of 1/T", "[record][signal]") {
  for (const double f : {3.0, 3.137, 7.77}) {
    const Column c = column(1001, 0.01, [&](double t) { return 5 + 2 * std::sin(2 * pi * f * t + 0.3); });
    CHECK(dominant_frequency(c.t, c.y) == Approx(f).margin(1e-3 / 10));
  }
}

TEST_CASE("the spectrum's peak is the amplitude, the larger of two sines dominates", "[record][signal]") {
  const Column c = column(2000, 0.01, [](double t) { return 0.5 * std::sin(2 * pi * 4 * t) + 2 * std::sin(2 * pi * 9 * t); });
  CHECK(dominant_frequency(c.t, c.y) == Approx(9).margin(1e-3));
  const Spectrum s = spectrum(c.t, c.y);
  double at4 = 0, at9 = 0;
  for (std::size_t i = 0; i < s.frequency.size(); ++i) {
    if (std::abs(s.frequency[i] - 4) < 0.1) at4 = std::max(at4, s.amplitude[i]);
    if (std::abs(s.frequency[i] - 9) < 0.1) at9 = std::max(at9, s.amplitude[i]);
  }
  CHECK(at4 == Approx(0.5).epsilon(0.01));  // scalloping loss of a Hann window with 4 x padding: below 1 %
  CHECK(at9 == Approx(2.0).epsilon(0.01));
}

TEST_CASE("a band holds the peaks in it, not the flank of one outside", "[record][signal]") {
  const Column c = column(1001, 0.005, [](double t) { return std::sin(2 * pi * 3.3 * t) + 0.05 * std::sin(2 * pi * 12 * t); });
  CHECK(dominant_frequency(c.t, c.y) == Approx(3.3).margin(1e-3));
  CHECK(dominant_frequency(c.t, c.y, 3.6, 20) == Approx(12).margin(2e-2));
}

TEST_CASE("uneven columns and constants", "[record][signal]") {
  Column c = column(800, 0.01, [](double t) { return std::sin(2 * pi * 5 * t); });
  for (std::size_t i = 1; i + 1 < c.t.size(); i += 2) c.t[i] += 0.003, c.y[i] = std::sin(2 * pi * 5 * c.t[i]);
  CHECK(dominant_frequency(c.t, c.y) == Approx(5).margin(2e-3));
  CHECK(std::isnan(dominant_frequency(c.t, std::vector<double>(c.t.size(), 3.0))));
  CHECK(std::isnan(dominant_frequency({0, 1}, {0, 1})));
}

TEST_CASE("crossings and period", "[record][signal]") {
  CHECK(crossings({0, 1, 2, 3}, {-1, 3, 1, -1}) == std::vector<double>{0.25, 2.5});
  CHECK(crossings({0, 1, 2, 3}, {-1, 3, 1, -1}, 0, true) == std::vector<double>{0.25});
  CHECK(crossings({0, 1, 2, 3, 4}, {-1, 0, 0, 1, 0}) == std::vector<double>{1});  // stays on zero, then goes on: one crossing
  CHECK(crossings({0, 1, 2}, {1, 0, 1}).empty());                                 // touches zero
  const Column c = column(1000, 0.01, [](double t) { return std::sin(2 * pi * t / 0.73 + 1); });
  CHECK(period(c.t, c.y) == Approx(0.73).epsilon(1e-4));
}
