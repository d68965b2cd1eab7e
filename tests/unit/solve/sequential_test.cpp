// The sequential scheme as a solver of the program: reproducible, resumable, with an honest energy ledger.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "engine/analysis/dynamic.h"
#include "engine/solve/sequential/sweep_feed.h"
#include "lua/language/script.h"
#include "tests/support/small_wall.h"
#include "tests/unit/record/two_bricks.h"
#include "tests/unit/solve/scene_run.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;
using test::dynamic_run;

namespace {

// A pillar that is shaken until it cracks and its bricks come loose.
std::string pillar(const std::string& analysis) {
  return R"(
material{ name = "brick", density = 1800 }
ground{ z = 0, size = 10, material = "brick" }
for i = 0, 3 do
  box{ name = "b" .. i, size = {0.2, 0.1, 0.1}, center = {0, 0, 0.05 + 0.1 * i}, material = "brick", group = "wall" }
end
joint{ law = mortar{ E = 50*MPa, thickness = 10*mm, ft = 0.05*MPa, c = 0.1*MPa, mu = 0.6 } }
ground_motion{ wave = sine{ amplitude = 1.5*g, frequency = 3 }, direction = "x" }
analysis{ duration = 0.25, dt_fraction = 0.02, solver = "sequential", unstable = true, )" +
         analysis + " }\n";
}

Model wall_model(const std::string& order) {
  return prepare(test::small_wall("analysis{duration=1, solver=\"sequential\", order=\"" + order + "\"}"), false).model;
}

}  // namespace

TEST_CASE("a sequential run depends on its seed alone, and one stopped and resumed ends as if never stopped", "[solve][sequential]") {
  const test::Scratch whole("sequential_whole"), parts("sequential_parts");
  for (const char* kind : {"seed = 5", "variant = 'centred', order = 'coloured'", "order = 'fixed', iterations = 3"}) {
    INFO(kind);
    const Metrics expected = dynamic_run(pillar(kind), whole.path, Existing::force);
    CHECK(expected.status == "completed");
    CHECK(expected.energy.at(7).second > 0);   // fracture: joints have cracked
    CHECK(expected.momentum_residual > 1e-6);  // action does not equal reaction, and the residual shows it
    CHECK(dynamic_run(pillar(kind), whole.path, Existing::force).state_hash == expected.state_hash);
    CHECK(dynamic_run(pillar(kind), parts.path, Existing::force, 0.11).status == "stopped");
    const Metrics got = dynamic_run(pillar(kind), parts.path, Existing::resume);
    CHECK(got.state_hash == expected.state_hash);
    CHECK(got.energy == expected.energy);
    CHECK(got.residual_relative == expected.residual_relative);
    CHECK(got.momentum_residual == expected.momentum_residual);
  }
  CHECK(dynamic_run(pillar("seed = 1"), whole.path, Existing::force).state_hash !=
        dynamic_run(pillar("seed = 2"), whole.path, Existing::force).state_hash);
}

// Packs update intact joints incrementally between reference updates; the plain sweep is exact. The largest error comes from resultants,
// which are rotated to first order. It is th^2/2 = 5e-9 of them at a rotation of 1e-4, and energies inherit it until the first bricks are
// loose.
TEST_CASE("joints side by side and blocks in rounds give what the plain sweep gives one by one", "[solve][sequential]") {
  const test::Scratch quick("sequential_quick"), plain("sequential_plain");
  for (const char* kind : {"seed = 5", "variant = 'centred', order = 'coloured'", "order = 'fixed', iterations = 3"}) {
    INFO(kind);
    const Metrics expected = dynamic_run(pillar(kind + std::string(", kernel = 'reference'")), plain.path, Existing::force, 0.11);
    const Metrics got = dynamic_run(pillar(kind), quick.path, Existing::force, 0.11);
    CHECK(got.energy.at(7).second > 0);  // fracture
    CHECK(got.joints_broken == expected.joints_broken);
    for (std::size_t i = 0; i < got.energy.size(); ++i)
      CHECK(got.energy[i].second == Approx(expected.energy[i].second).epsilon(1e-8).margin(1e-8 * expected.energy[3].second));
    CHECK(got.momentum_residual == Approx(expected.momentum_residual).epsilon(1e-8));
  }
}

TEST_CASE("every order lets each block go once; colours part neighbours", "[solve][sequential]") {
  for (const char* order : {"random", "fixed", "coloured"}) {
    const Model model = wall_model(order);
    std::vector<int> got = sweep_order(model, 3, 7), sorted = got;
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> all(std::size_t(model.nblock));
    std::iota(all.begin(), all.end(), 0);
    CHECK(sorted == all);
    CHECK(sweep_order(model, 3, 7) == got);
    CHECK((sweep_order(model, 3, 8) != got) == (std::string(order) == "random"));
    if (std::string(order) != "coloured") continue;
    // Within a run of increasing numbers no two blocks share a joint: colours follow each other.
    std::size_t first = 0;
    for (std::size_t i = 1; i <= got.size(); ++i) {
      if (i < got.size() && got[i] > got[i - 1]) continue;
      for (const Joint& j : model.joint) {
        const auto in = [&](int b) { return std::find(got.begin() + long(first), got.begin() + long(i), b) != got.begin() + long(i); };
        CHECK_FALSE((in(j.a) && in(j.b)));
      }
      first = i;
    }
  }
}

TEST_CASE("the sequential scheme is the leapfrog for blocks that meet none that moves", "[solve][sequential]") {
  const std::string text = R"(
material{ name = "stone", density = 2000 }
box{ name = "base", size = {1, 1, 0.1}, center = {0, 0, -0.05}, fixed = true }
box{ name = "block", size = {0.2, 0.2, 0.2}, center = {0, 0, 0.1}, initial = { velocity = {0.01, 0.02, 0}, spin = {0.1, 0, 0.2} } }
box{ name = "pushed", size = {0.2, 0.2, 0.2}, center = {0.3, 0, 0.1} }
force{ block = "pushed", wave = sine{ amplitude = 50, frequency = 40 }, direction = {1, 0.5, 0}, point = {0.3, 0, 0.2} }
joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1*MPa, c = 1*MPa, mu = 0.6 } }
)";
  const test::Scratch one("sequential_one"), other("sequential_other");
  const Metrics swept =
      dynamic_run(text + "analysis{ duration = 0.05, solver = 'sequential', lazy_rotation = 0 }", one.path, Existing::force);
  const Metrics leapt =
      dynamic_run(text + "analysis{ duration = 0.05, kernel = 'reference', lazy_rotation = 0 }", other.path, Existing::force);
  for (std::size_t i = 0; i < leapt.energy.size(); ++i)
    CHECK(swept.energy[i].second == Approx(leapt.energy[i].second).epsilon(1e-6).margin(1e-12));
  CHECK(swept.residual_relative == Approx(leapt.residual_relative).epsilon(0.01));
  CHECK(swept.momentum_residual == 0);
}

TEST_CASE("a literal sweep feeds energy, and the gate ends a run that did not ask for it", "[solve][sequential]") {
  const std::string text = R"(
analysis{ duration = 0.1, solver = "sequential", start = "rest", unstable = UNSTABLE }
gravity(0)
material{ name = "stone", density = 2000 }
for i = 0, 5 do
  box{ name = "b" .. i, size = {0.2, 0.2, 0.2}, center = {0.2 * i, 0, 0}, initial = { velocity = {1e-6, 0, 0} } }
end
joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1*GPa, c = 1*GPa, mu = 0.6 } }
)";
  for (const bool asked : {false, true}) {
    std::string said = text;
    said.replace(said.find("UNSTABLE"), 8, asked ? "true" : "false");
    Script script(Script::Options{.quiet = true});
    const Scene scene = script.load_text(said, "chain.lua", {});
    const test::Scratch dir("sequential_gate");
    RunOptions options;
    options.directory = dir.path;
    options.existing = Existing::force;
    const RunOutcome outcome = run_dynamic(scene, said, options);
    CHECK((outcome.metrics.status == "completed") == asked);
    CHECK(outcome.trouble.empty() == asked);
    CHECK(outcome.metrics.residual_relative > 0.1);
  }
}

// In a chain between walls, D - K couples neighbours only through k: 2 k / m cos(pi / (n + 1)).
TEST_CASE("what a sweep feeds a chain by", "[solve][sequential]") {
  std::string chain = "gravity(0)\nmaterial{ name = 'stone', density = 2000 }\n";
  for (int i = 0; i <= 11; ++i)
    chain += fmt::format("box{{ name = 'b{0}', size = {{.1, .1, .1}}, center = {{.1 * {0}, 0, 0}}, fixed = {1} }}\n", i,
                         i == 0 || i == 11 ? "true" : "false");
  chain += "joint{ law = mortar{ kn = 1e9, ks = 1e8, ft = 1e9, c = 1e9, mu = 0.6 } }\nanalysis{ duration = 1 }\n";
  Script script(Script::Options{.quiet = true});
  const Prepared run = prepare(script.load_text(chain, "chain.lua", {}), false);
  CHECK(sweep_feed(run.model, run.state) == Approx(2 * 1e7 / 2 * std::cos(3.14159265358979 / 11)).epsilon(1e-6));
}

// The shaking of the pillar is far smaller than the energy input of its own scheme.
TEST_CASE("a sequential run that makes more energy than there is ends as diverged", "[solve][sequential]") {
  const test::Scratch scratch("sequential_runaway");
  std::string text = pillar("seed = 1");
  text.replace(text.find("duration = 0.25, dt_fraction = 0.02"), 35, "duration = 20, dt_fraction = 0.5");
  text.replace(text.find("ft = 0.05*MPa, c = 0.1*MPa"), 26, "ft = 1e9, c = 1e9");  // a broken pillar falls apart and feeds no more energy
  const Metrics got = dynamic_run(text, scratch.path, Existing::force);
  CHECK(got.status == "diverged");
  CHECK(got.time_s < 2);
}
