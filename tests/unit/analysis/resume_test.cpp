#include <catch2/catch.hpp>

#include "engine/analysis/dynamic.h"
#include "lua/language/script.h"
#include "tests/support/text_of.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

// A pillar that is shaken until its mortar cracks, its joints open and its bricks fall. It uses everything that a checkpoint must store.
const char* const pillar = R"(
material{ name = "brick", density = 1800 }
ground{ z = 0, size = 10, material = "brick" }
for i = 0, 3 do
  box{ name = "b" .. i, size = {0.2, 0.1, 0.1}, center = {0, 0, 0.05 + 0.1 * i}, material = "brick", group = "wall" }
end
joint{ law = mortar{ E = 50*MPa, thickness = 10*mm, ft = 0.05*MPa, c = 0.1*MPa, mu = 0.6 } }
ground_motion{ wave = sine{ amplitude = 1.5*g, frequency = 3 }, direction = "x" }
recorder{ name = "top", quantity = "displacement", block = "b3", axis = "x" }
recorder{ name = "base", quantity = "reaction", axis = "xz" }
analysis{ duration = 0.6 }
)";

// Walls with several kinds of joints that crack one after another. Joints of the walls that fell first are gone by then.
const char* const walls = R"(
material{ name = "brick", density = 1800, friction = 0.6 }
ground{ z = 0, size = 20, material = "brick" }
for i, n in ipairs{9, 6, 4, 2} do
  wall{ name = "w" .. i, at = {0, i * 1.5, 0}, length = 1.25 - 0.1 * i, courses = n,
        brick = {length = 0.3, width = 0.125, height = 0.1}, joint = 10*mm, quiet = true }
end
joint{ law = mortar{ E = 200*MPa, thickness = 10*mm, ft = 0.03*MPa, c = 0.06*MPa, mu = 0.6 }, thickness = 10*mm }
gravity(g)
for i = 0, 5 do
  ground_motion{ wave = half_sine{ amplitude = (0.6 + 0.5 * i)*g, frequency = 6.25, start = 0.16 * i }, direction = "y" }
end
ground_motion{ wave = sine{ amplitude = 0.8*g, frequency = 7 }, direction = "x" }
analysis{ duration = 0.8 }
)";

// Its table leaps back at .5 s, among blocks that ride on it.
const char* const jolt = R"(
material{ name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = 1e9, ks = 4e8 }
box{ name = "table", size = {1, 1, .1}, at = {0, 0, -.1}, fixed = true }
for i = 0, 4 do box{ name = "b" .. i, size = {.3, .2, .1}, at = {.35 + .02 * i, .4, .1 * i}, free = true } end
joint{ law = dry{ kn = 1e10, mu = .6 } }
motion{ block = "table", direction = "x",
        wave = table_wave{ times = {0, .1, .2, .3, .5}, values = {0, 0, .03, -.02, .04}, hold = false } }
analysis{ duration = .8 }
)";

Metrics run(const char* text, const std::string& dir, Existing existing, std::optional<double> until) {
  Script::Options quiet;
  quiet.quiet = true;
  Script script(quiet);
  const Scene scene = script.load_text(text, "scene.lua", {});
  RunOptions options;
  options.directory = dir;
  options.existing = existing;
  options.until = until;
  return run_dynamic(scene, text, options).metrics;
}

// Runs once without a stop, and once with a stop at each of `times` (s).
void stop_and_go(const char* text, const std::vector<double>& times) {
  const test::Scratch whole("resume_whole"), parts("resume_parts");
  const Metrics expected = run(text, whole.path, Existing::refuse, {});
  CHECK(expected.status == "completed");
  CHECK(expected.joints_broken > 0);
  CHECK(expected.equilibrium.iterations > 0);
  Existing existing = Existing::refuse;
  for (const double until : times) {
    const Metrics stopped = run(text, parts.path, existing, until);
    CHECK(stopped.status == "stopped");
    CHECK(stopped.time_s >= until);
    existing = Existing::resume;
    const Metrics again = run(text, parts.path, existing, until);  // already there: takes no step
    CHECK(again.steps == stopped.steps);
    CHECK(again.state_hash == stopped.state_hash);
  }
  const Metrics got = run(text, parts.path, Existing::resume, {});
  CHECK(got.status == "completed");
  CHECK(got.steps == expected.steps);
  CHECK(got.state_hash == expected.state_hash);
  CHECK(got.energy == expected.energy);
  CHECK(got.residual_relative == expected.residual_relative);
  CHECK(got.equilibrium.iterations == expected.equilibrium.iterations);
  CHECK(got.equilibrium.unbalanced == expected.equilibrium.unbalanced);
  for (const char* name : {"/histories.csv", "/energy.csv", "/events.csv"})
    CHECK(test::text_of(parts.path + name) == test::text_of(whole.path + name));
}

}  // namespace

TEST_CASE("a run that is stopped and resumed ends as if never stopped, to the bit", "[analysis][resume]") {
  stop_and_go(pillar, {0.03, 0.172, 0.3201, 0.5});  // intact; cracked and rotating; during release to contact; among falling bricks
}

TEST_CASE("joints that crack after others are gone find the same lanes in a resumed run", "[analysis][resume]") {
  stop_and_go(walls, {0.3, 0.5, 0.7});
}

TEST_CASE("a block that leaps where a run was stopped meets its neighbours in the same step", "[analysis][resume]") {
  const test::Scratch whole("jolt_whole"), parts("jolt_parts");
  const Metrics expected = run(jolt, whole.path, Existing::refuse, {});
  run(jolt, parts.path, Existing::refuse, .5);
  const Metrics got = run(jolt, parts.path, Existing::resume, {});
  CHECK(got.steps == expected.steps);
  CHECK(got.state_hash == expected.state_hash);
  CHECK(got.energy == expected.energy);
}
