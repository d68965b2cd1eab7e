// Runs in which beds soften by crushing: the same bits for any number of threads, instruction set, kernel of packs and resume.
#include <catch2/catch.hpp>

#include "engine/record/folder/run_folder.h"
#include "engine/record/format/json.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// Nine pillars under loads that stand more and more eccentric; the first is crushed through within the run, others lose their toe.
const char* eccentric_pillars = R"(
material{ name = "stone", density = 2400, friction = .6 }
box{ name = "floor", group = "floor", size = { 14, 3, 1 }, at = { -1, -1, -1 }, fixed = true }
local load = table_wave{ times = { 0, .1, .25 }, values = { 0, -.9e5, -2e5 }, hold = true }
for i = 0, 8 do
  for k = 1, 2 do box{ name = "p" .. i .. k, group = "wall", size = { 1, 1, 1 }, at = { 1.4 * i, 0, k - 1 } } end
  force{ block = "p" .. i .. 2, direction = "z", wave = load, point = { 1.4 * i + .5 + .04 * i, .5 + .02 * i, 2 } }
end
joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 2e4, c = 5e4, mu = .6, fc = 1.5e5, Gc = 150, damping = .05 }, BEARS }
recorder{ name = "first", quantity = "crushing", blocks = "p01", others = "floor" }
recorder{ name = "last", quantity = "crushing", blocks = "p81", others = "floor" }
metric("first", "", function(run) return run.last("first_crushing") end)
metric("last", "", function(run) return run.last("last_crushing") end)
metric("early", "", function(run)
  for i, t in ipairs(run.time) do if t >= .09 then return run.history("last_crushing")[i] end end
end)
analysis{ duration = .3, dt_fraction = .4, frame_stress = true }
)";

Json metrics_of(const Bench& bench) { return read_json(bench.out() + "/metrics.json"); }

}  // namespace

TEST_CASE("crushing that softens gives the same bits for any threads, after a resume and with points one by one",
          "[crushing][softening][program]") {
  const std::string bears = GENERATE("pressure = 'face'", "pressure = 'points', rule = 'trapezoid', points = 4");
  std::string pillars = eccentric_pillars;
  pillars.replace(pillars.find("BEARS"), 5, bears);
  Bench bench;
  REQUIRE(bench.run(pillars, {"--threads", "1"}) == 0);
  const Json one = metrics_of(bench);
  const std::string frames = text_of(bench.out() + "/histories.csv");
  CHECK(one["metrics"]["first"] > 0.9);
  CHECK(one["metrics"]["last"] > 0);
  CHECK(one["metrics"]["early"] > 0.01);
  CHECK(one["energy"]["residual_relative"] < 1e-3);  // the tolerance of bonded structures
  CHECK(one["energy"]["crushing_J"] > 0.9 * 150);
  for (const char* threads : {"2", "3"}) {
    REQUIRE(bench.run(pillars, {"--threads", threads, "--force"}) == 0);
    CHECK(metrics_of(bench)["state_hash"] == one["state_hash"]);
    CHECK(text_of(bench.out() + "/histories.csv") == frames);
  }
  for (const char* until : {"0.15", "0.24"}) {
    REQUIRE(bench.run(pillars, {"--until", until, "--force"}) == 3);
    REQUIRE(bench.run(pillars, {"--resume"}) == 0);
    CHECK(metrics_of(bench)["state_hash"] == one["state_hash"]);
    CHECK(text_of(bench.out() + "/histories.csv") == frames);
  }
  REQUIRE(bench.run(pillars, {"--set", "kernel=reference", "--force"}) == 0);
  const Json reference = metrics_of(bench);
  // Before pillars tip over, which amplifies round-off.
  CHECK(reference["metrics"]["early"].get<double>() == Approx(one["metrics"]["early"].get<double>()).epsilon(1e-3));
  CHECK(reference["energy"]["crushing_J"].get<double>() == Approx(one["energy"]["crushing_J"].get<double>()).epsilon(0.02));
}
