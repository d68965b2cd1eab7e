#include <catch2/catch.hpp>

#include "engine/analysis/diagnostics.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

// Diagnostics of 1000 steps: `past` steps at `ratio` times their limit, the others at half of it.
RunDiagnostics watched(long past, double ratio, State& s) {
  RunDiagnostics watch;
  s.time.last_dt = 1e-4;
  s.time.step = past;
  update_diagnostics(watch, s, s.time.last_dt / ratio, 1e-3);
  s.time.step = 1000;
  update_diagnostics(watch, s, 2 * s.time.last_dt, 1e-3);
  return watch;
}

}  // namespace

TEST_CASE("steps past their limit count by how many they are and how far out", "[analysis][trust]") {
  State s;
  CHECK_FALSE(stepped_too_far(watched(900, 1.04, s), s));  // within the adaptation of a step
  CHECK_FALSE(stepped_too_far(watched(900, 1.25, s), s));
  CHECK_FALSE(stepped_too_far(watched(5, 1.6, s), s));
  CHECK(stepped_too_far(watched(20, 1.6, s), s));
  CHECK(stepped_too_far(watched(2, 2.45, s), s));
  CHECK_FALSE(stepped_too_far(watched(1, 2.45, s), s));
}

TEST_CASE("the line of trust names each warning with its share, and what was booked as reset", "[analysis][trust]") {
  State s;
  s.energy.reference = 2, s.energy.reset = 3e-4;
  const std::string line = diagnostics_line(diagnostics_of(watched(20, 1.6, s), Model{}, s));
  CHECK_THAT(line, Catch::Contains("energy reset 1.5e-04"));
  CHECK_THAT(line, Catch::Contains("steps with a warning: 2 % dt above its limit"));
  CHECK_THAT(line, !Catch::Contains("deepening"));
  CHECK_THAT(diagnostics_line(Metrics::Diagnostics{}), Catch::Contains("no warning in any step"));
}
