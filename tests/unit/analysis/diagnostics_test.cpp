#include <catch2/catch.hpp>

#include "engine/analysis/diagnostics.h"
#include "engine/analysis/verdict.h"
#include "tests/support/small_wall.h"

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
  CHECK_THAT(diagnostics_line(Metrics::Diagnostics{}), Catch::Contains("no limit to dt, no warning in any step"));
}

TEST_CASE("a diverged run names the step that the user gave, and the one it had shrunk to", "[analysis][trust]") {
  const Scene scene = test::small_wall("analysis{duration=1, dt=1e-5}");
  Prepared run = prepare(scene, false);
  const Collapse collapse;
  const RunDiagnostics diagnostics;
  const RunSoFar so_far{.scene = scene, .run = run, .collapse = collapse, .diagnostics = diagnostics, .dt_at_start = 1e-5};
  CHECK_THAT(trouble_of(so_far, "diverged"), Catch::Contains("(dt = 1e-05 s, limit "));
  run.state.time.dt = 2.5e-7;
  CHECK_THAT(trouble_of(so_far, "diverged"), Catch::Contains("(dt = 1e-05 s at the start and 2.5e-07 s there, limit "));
}

TEST_CASE("round-off of a block at rest is no divergence, and negative kinetic energy beyond it is", "[analysis][trust]") {
  const Scene scene = test::small_wall("analysis{duration=1}");
  Prepared run = prepare(scene, false);
  const Collapse collapse;
  const RunDiagnostics diagnostics;
  const RunSoFar so_far{.scene = scene, .run = run, .collapse = collapse, .diagnostics = diagnostics, .dt_at_start = 1e-5};
  Energy& e = run.state.energy;
  e.elastic = 1e-13, e.gravity = -2e-13;  // J, of a chip on a stiff bed
  run.state.time.step = 10'000'000;
  for (const auto& [kinetic, expected] : {std::pair{-5e-46, false}, {-1e-18, true}}) {
    long right = 0;
    e.kinetic = kinetic;
    CHECK(diverges(so_far, right) == expected);
  }
}

TEST_CASE("a run whose losses give energy has diverged, though its ledger closes", "[analysis][trust]") {
  const Scene scene = test::small_wall("analysis{duration=1}");
  Prepared run = prepare(scene, false);
  const Collapse collapse;
  const RunDiagnostics diagnostics;
  const RunSoFar so_far{.scene = scene, .run = run, .collapse = collapse, .diagnostics = diagnostics, .dt_at_start = 1e-5};
  Energy& e = run.state.energy;
  e.kinetic = e.reference = 1e6, e.height_flux = 10;  // J
  for (const auto& [step, friction, expected] :
       {std::tuple{100L, 5e5, false}, {100L, -5e4, false}, {100L, -1e6, true}, {50L, -1e6, false}}) {
    long right = 0;
    e.friction = friction, run.state.time.step = step;
    CHECK(diverges(so_far, right) == expected);
  }
  CHECK(diverged_at_end(so_far));  // after 50 steps
  e.kinetic = e.reference = 100, e.friction = -50;
  CHECK(diverged_at_end(so_far));
  e.friction = 0;
  CHECK_FALSE(diverged_at_end(so_far));
}
