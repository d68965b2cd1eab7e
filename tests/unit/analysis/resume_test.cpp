#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "engine/analysis/dynamic.h"
#include "lua/script.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

// A pillar that is shaken until its mortar cracks, its joints open and its bricks fall: everything a checkpoint has to carry.
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

std::string slurp(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Metrics run(const std::string& dir, Existing existing, std::optional<double> until) {
  Script::Options quiet;
  quiet.quiet = true;
  Script script(quiet);
  const Scene scene = script.load_text(pillar, "pillar.lua", {});
  RunOptions options;
  options.directory = dir;
  options.existing = existing;
  options.until = until;
  return run_dynamic(scene, pillar, options).metrics;
}

}  // namespace

TEST_CASE("a run that is stopped and resumed ends as if never stopped, to the bit", "[analysis][resume]") {
  const test::Scratch whole("resume_whole"), parts("resume_parts");
  const Metrics expected = run(whole.path, Existing::refuse, {});
  CHECK(expected.status == "completed");
  CHECK(expected.joints_broken > 0);
  // still whole; cracked and turning; while joints are handed over; among falling bricks
  Existing existing = Existing::refuse;
  for (const double until : {0.03, 0.172, 0.3201, 0.5}) {
    const Metrics stopped = run(parts.path, existing, until);
    CHECK(stopped.status == "stopped");
    CHECK(stopped.time_s >= until);
    existing = Existing::resume;
  }
  const Metrics got = run(parts.path, Existing::resume, {});
  CHECK(got.status == "completed");
  CHECK(got.steps == expected.steps);
  CHECK(got.state_hash == expected.state_hash);
  CHECK(got.energy == expected.energy);
  CHECK(got.residual_relative == expected.residual_relative);
  for (const char* name : {"/histories.csv", "/energy.csv", "/events.csv"}) CHECK(slurp(parts.path + name) == slurp(whole.path + name));
}
