// Where the time of a run goes: wall_s of metrics.json, and `erbs run --profile`.
#include <catch2/catch.hpp>

#include "engine/record/results/metrics.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

TEST_CASE("the phases of a run sum to its time of solving, and the profile names what limits the step", "[program]") {
  Bench bench;
  const std::string dropped = R"(
    material { name = "m", density = 2000 }
    ground { z = 0, size = 3 }
    for i = 0, 3 do box { name = "b" .. i, size = { .2, .2, .1 }, at = { 0, 0, .11 + i * .12 }, free = true } end
    for i = 0, 1 do box { name = "pier" .. i, group = "pier", size = { .2, .2, .1 }, at = { 2, 0, i * .1 }, fixed = i == 0 } end
    joint { law = mortar { kn = 1e13, ks = 4e12, ft = 1e7, c = 1e7, mu = .6 }, between = { "pier", "pier" } }
    gravity(g)
  )";
  for (const std::string levels : {"1", "3"}) {
    INFO("levels " << levels);
    CHECK(bench.run(dropped + "analysis { duration = .3, levels = " + levels + " }", {"--profile", "--force"}) == 0);
    INFO(bench.said);
    const Json wall = read_metrics(bench.out())["wall_s"];
    double sum = 0;
    for (const char* phase : {"joints", "contact", "search", "integrate", "ledger"}) {
      CHECK(wall[phase].get<double>() >= 0);
      sum += wall[phase].get<double>();
    }
    const double solve = wall["solve"].get<double>();
    CHECK(sum == Approx(solve));
    CHECK(wall["contact"].get<double>() > 0);
    CHECK(wall["integrate"].get<double>() > 0);
    CHECK(solve + wall["setup"].get<double>() + wall["record"].get<double>() <= wall["total"].get<double>() * (1 + 1e-9));
    CHECK(contains(bench.said, "what kept them from being longer"));
    CHECK(contains(bench.said, "contacts"));
    CHECK(contains(bench.said, "contacts of loose blocks act every") == (levels == "3"));
  }
}
