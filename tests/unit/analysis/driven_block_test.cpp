#include <catch2/catch.hpp>
#include <cmath>

#include "engine/analysis/dynamic.h"
#include "engine/base/units.h"
#include "engine/record/format/csv.h"
#include "tests/unit/lua/load.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;

// A brick falls and rocks beside a stiff joint, so that levels of contacts change the step all the time, and once more at the end.
TEST_CASE("the acceleration of a driven block is that of its wave, whatever the steps about it", "[analysis][recorder]") {
  const std::string text = R"(
material{ name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = 1e8, ks = 4e7 }
ground{ size = 40, material = "brick" }
box{ name = "foot", size = { .3, .125, .1 }, at = { -1, 0, 0 }, group = "wall" }
box{ name = "loose", size = { .3, .125, .1 }, at = { 0, 0, .03 }, free = true, initial = { rotation = { .1, .1, 0 } } }
box{ name = "table", size = { 1, 1, .1 }, center = { 10, 0, 3 }, free = true }
joint{ law = dry{ kn = 1e12, mu = 0.6 }, between = { "wall", "ground" } }
motion{ block = "table", wave = sine{ amplitude = .02, frequency = 3 }, direction = "x" }
analysis{ duration = .2, start = "rest", levels = 4, output_dt = .001 }
recorder{ name = "table", quantity = "acceleration", block = "table", axis = "x" }
)";
  lua::Script script(lua::quiet());
  Scene scene = script.load_text(text, "scene.lua", {});
  const test::Scratch dir("driven_block");
  RunOptions options;
  options.directory = dir.path;
  CHECK(run_dynamic(std::move(scene), text, options).metrics.status == "completed");
  const CsvTable table = read_csv(dir.path + "/histories.csv");
  const std::vector<double>&t = table.columns.front(), &a = table.columns[std::size_t(table.find("table_ax_rel_m_s2"))];
  REQUIRE(t.size() > 190);
  const double w = 6 * pi, largest = 0.02 * w * w;
  // The first row has the jump from rest to the speed of the sine. 1e-6: differences of positions over steps of 1e-5 s.
  for (std::size_t i = 1; i < t.size(); ++i) CHECK(std::abs(a[i] + largest * std::sin(w * t[i])) < 1e-6 * largest);
}
