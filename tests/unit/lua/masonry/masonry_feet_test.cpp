// A block on feet: its mass and its feet, joined to what lies below, and wrong arguments named.
#include <catch2/catch.hpp>

#include "engine/analysis/start/prepare.h"
#include "engine/geometry/mass.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

TEST_CASE("a block on feet: volume, centroid and joints at its edges", "[lua][masonry][feet]") {
  for (const char* rocks : {"x", "y", "xy"})
    for (const double foot : {0.004, 0.05, 0.5}) {
      const Scene scene =
          scene_of(fmt::format("ground{{ size = 9 }}\njoint{{ law = dry{{ kn = 1e10, mu = 0.6 }} }}\n"
                               "local it = footed_block{{ size = {{ .4, .6, 1 }}, at = {{ 1, 2, 0 }}, foot = {}, rocks = '{}' }}\n"
                               "metric('share', '', it.share)\nanalysis{{ duration = .1 }}",
                               foot, rocks));
      const Block& block = scene.blocks.back();
      const bool corners = std::string(rocks) == "xy";
      REQUIRE(block.parts.size() == (corners ? 5u : 3u));
      const double share = corners ? 4 * foot * foot : 2 * foot;
      const auto mass = mass_properties(block.parts);
      CHECK(mass.volume == Approx(.24 * (1 - 1e-3 * (1 - share))));
      CHECK(mass.centroid.x() == Approx(1));
      CHECK(mass.centroid.y() == Approx(2));
      const analysis::Prepared run = analysis::prepare(scene, false);
      std::vector<double> areas;
      for (const Joint& joint : run.model.joint)
        if (run.model.block_name[std::size_t(joint.b)] == "block" || run.model.block_name[std::size_t(joint.a)] == "block")
          areas.push_back(joint.type->area);
      REQUIRE(areas.size() == (corners ? 4u : 2u));
      for (const double area : areas) CHECK(area == Approx(.24 * share / double(areas.size())));
    }
}

TEST_CASE("wrong arguments of a block on feet are named with their place", "[lua][masonry][feet]") {
  const auto fails = [](const std::string& keys, const std::string& words) {
    CHECK_THROWS_WITH(scene_of("joint{ law = dry{ kn = 1e10, mu = 0.6 } }\nfooted_block{ " + keys + " }"), Catch::Contains(words));
  };
  fails("", "size is missing");
  fails("size = { 0, 1, 1 }", "above 0 m");
  fails("size = { 1, 1, 1 }, foot = .7", "out of range");
  fails("size = { 1, 1, 1 }, foot = 0", "above 0");
  fails("size = { 1, 1, 1 }, rocks = 'z'", "allowed: x, y, xy");
  fails("size = { 1, 1, 1 }, feet = .1", "unknown key \"feet\"");
}
