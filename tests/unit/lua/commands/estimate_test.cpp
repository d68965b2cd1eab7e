// Estimate of run time by erbs check: a range that widens if joints may open, and narrows if there are none.
#include <catch2/catch.hpp>

#include "engine/model/build/build.h"
#include "lua/program/estimate.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

Cost cost_of(const std::string& law, bool debris = true) {
  Script script(quiet());
  const Scene scene = script.load_text(
      "material{ name = 'brick', density = 1800 }\nground{}\ngravity(g)\nanalysis{ duration = 1 }\n" + law +
          "\nwall{ length = 3, courses = 10, joint = 0, quiet = true, brick = { length = .3, width = .125, height = .1 } }",
      "wall.lua");
  return estimated_cost(build(scene).model, 1000, debris);
}

}  // namespace

TEST_CASE("the estimate of a run's time is a range by what its joints may do", "[lua][estimate]") {
  const Cost dry = cost_of("joint{ law = dry{ kn = 1e10, mu = .6 } }"),
             mortar = cost_of("joint{ law = mortar{ kn = 1e10, ft = 1e5, c = 1e5, mu = .6 } }");
  CHECK(dry.least == mortar.least);
  CHECK(dry.most > 10 * dry.least);
  CHECK(dry.cracked == 0);
  CHECK(mortar.cracked > 5 * mortar.least);
  CHECK(mortar.most > mortar.cracked);
  CHECK(contains(cost_text(dry), "if it rocks, slides or falls"));
  CHECK(contains(cost_text(mortar), "if all joints are cracked) to "));
  CHECK(cost_of("joint{ law = mortar{ kn = 1e10, ft = 1e5, c = 1e5, mu = .6 } }", false).most == mortar.cracked);
}

TEST_CASE("blocks without joints fall or lie in a heap", "[lua][estimate]") {
  Script script(quiet());
  const Scene scene = script.load_text(
      "material{ name = 'brick', density = 1800 }\nground{}\nanalysis{ duration = 1 }\n"
      "for k = 1, 50 do box{ size = {.3, .2, .1}, at = {0, 0, k}, free = true, material = 'brick' } end",
      "heap.lua");
  const Cost cost = estimated_cost(build(scene).model, 1000, true);
  CHECK(cost.least > 0);
  CHECK(cost.most < 9 * cost.least);
}
