#include "engine/base/correlation.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace erbs;

namespace {

// A wave that grows and dies away, with two frequencies: no period of it looks like another one.
double wave(double t) { return std::exp(-0.5 * std::pow((t - 4) / 1.1, 2)) * (std::sin(7 * t) + 0.5 * std::sin(17 * t + 1)); }

Samples sampled_wave(double rate, double later, double factor = 1) {
  Samples s;
  for (double t = 0; t < 10; t += 1 / rate) s.t.push_back(t), s.y.push_back(factor * wave(t - later));
  return s;
}

}  // namespace

TEST_CASE("a known lag is found to half a sample", "[correlation]") {
  for (const double rate : {25.0, 30.0, 60.0, 100.0, 1000.0})
    for (const double rate_second : {25.0, 100.0, 240.0})
      for (const double lag : {0.137, -0.137, 0.0, 1.5}) {
        CAPTURE(rate, rate_second, lag);
        const Lag found = lag_of(sampled_wave(rate, lag, 3), sampled_wave(rate_second, 0), 3);
        CHECK(found.lag == Approx(lag).margin(0.5 / std::max(rate, rate_second)));
        CHECK(found.correlation > 0.97);
        CHECK_FALSE(found.at_edge);
      }
}

TEST_CASE("a lag beyond the reach is reported", "[correlation]") {
  CHECK(lag_of(sampled_wave(100, 0.5), sampled_wave(100, 0), 0.45).at_edge);
  const Samples constant{{0, 1, 2, 3}, {1, 1, 1, 1}};
  CHECK(std::isnan(lag_of(constant, constant, 1).correlation));
}

TEST_CASE("the first motion is where the signal leaves its first value", "[correlation]") {
  const Samples ramp{{0, 1, 2, 3}, {5, 5, 15, 25}};
  CHECK(first_motion(ramp, 0.1) == Approx(1.2));
  CHECK(std::isnan(first_motion({{0, 1}, {2, 2}})));
}

TEST_CASE("a lag below zero is said as earlier", "[base]") {
  CHECK(lag_text(0.3) == "0.3000 s later");
  CHECK(lag_text(-0.3) == "0.3000 s earlier");
}
