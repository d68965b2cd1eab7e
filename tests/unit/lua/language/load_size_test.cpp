// Loads that no structure could mean are mistakes of the scene: the run would only diverge.
#include <catch2/catch.hpp>

#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

TEST_CASE("a load beyond all sense is refused with its line, its size and what is allowed", "[lua][bad_input]") {
  const std::pair<const char*, const char*> list[] = {
      {"ground_motion{ wave = function(t) return 1e300 end, direction = 'x' }",
       "ground_motion: its wave reaches 1e+300 m/s2; at most 1e+06 m/s2 is allowed: check its units"},
      {"ground_motion{ wave = sine{ amplitude = 2e6, frequency = 1 }, direction = 'x' }", "reaches 2e+06 m/s2"},
      {"ground_motion{ wave = pulse{ amplitude = -1e9, start = .0012345, duration = 1e-8 }, direction = 'x' }", "reaches 1e+09 m/s2"},
      {"ground_motion{ wave = table_wave{ times = {0, 9}, values = {0, 1e300} }, direction = 'x' }", "reaches 1e+300 m/s2"},
      {"ground_motion{ wave = mp_pulse{ amplitude = 1e9, frequency = 1, gamma = 2 }, direction = 'x' }", "ground_motion: its wave reaches"},
      {"force{ block = 'b', wave = 1e300, direction = 'x' }", "force: its wave reaches 1e+300 N; at most 1e+15 N is allowed"},
      {"moment{ block = 'b', wave = -1e300, direction = 'x' }", "moment: its wave reaches 1e+300 N m; at most 1e+15 N m is allowed"},
      {"motion{ block = 'b', wave = function(t) return 1e300 * t end, direction = 'x' }", "motion: its wave reaches"},
      {"turning{ block = 'b', wave = function(t) return 1e7 * t end, axis = 'x' }", "at most 1e+06 rad is allowed"},
      {"tilt{ axis = 'x', wave = function(t) return 20 * t end }", "angles are in radians"},
  };
  for (const auto& [piece, part] : list) {
    INFO(piece);
    const auto mistakes = mistakes_in(piece);
    CHECK(mistakes.size() == 1);
    CHECK(mentions(mistakes, part));
    CHECK(mentions(mistakes, "scene.lua:6: "));
  }
  CHECK(mistakes_in("ground_motion{ wave = sine{ amplitude = 1e6, frequency = 1 }, direction = 'x' }").empty());
  CHECK(mistakes_in("force{ block = 'b', wave = 1e15, direction = 'x' }").empty());
}

TEST_CASE("gravity out of range is one mistake", "[lua][bad_input]") {
  for (const char* piece : {"gravity(1e300)", "gravity(-1)", "gravity(0/0)"}) {
    INFO(piece);
    const auto mistakes = mistakes_in(piece);
    CHECK(mistakes.size() == 1);
    CHECK(mentions(mistakes, "scene.lua:6: gravity: "));
  }
}
