// Arches and columns built in Lua: blocks meet, masses are right, and wrong arguments are named.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/units.h"
#include "engine/geometry/mass.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// Blocks of the piece, without the common block.
std::vector<Block> blocks_of(const std::string& piece) {
  const Scene scene = scene_of("joint{ law = dry{ kn = 1e10, mu = 0.6 } }\n" + piece);
  return {scene.blocks.begin() + 1, scene.blocks.end()};
}

double volume(const std::vector<Block>& blocks) {
  double sum = 0;
  for (const Block& block : blocks)
    if (!block.fixed) sum += mass_properties(block.parts).volume;
  return sum;
}

}  // namespace

TEST_CASE("a round arch: straight-sided voussoirs between two abutments", "[lua][masonry]") {
  for (const char* axis : {"x", "y"}) {
    const auto blocks =
        blocks_of(fmt::format("arch{{ at = {{9, 9, 9}}, radius = 2, thickness = 0.3, width = 0.5, voussoirs = 9, axis = '{}' }}", axis));
    REQUIRE(blocks.size() == 11);
    CHECK(blocks[0].name == "arch.v01");
    CHECK(blocks[9].fixed);
    CHECK(blocks[9].group == "arch_abutment");
    // N trapezoids of angle d, each 2 R t sin(d/2) cos(d/2) in area.
    CHECK(volume(blocks) == Approx(9 * 2 * 0.3 * std::sin(pi / 9) * 0.5));
    CHECK(mass_properties(blocks[0].parts).centroid[axis[0] - 'x'] < 9);  // the first is on the left
    CHECK(mass_properties(blocks[4].parts).centroid.z() > 10.9);
    CHECK(mass_properties(blocks[9].parts).centroid.z() < 9);
  }
}

TEST_CASE("a pointed arch meets at the crown, a segment leans on its abutments", "[lua][masonry]") {
  const auto pointed = blocks_of("arch{ at = {0, 9, 9}, radius = 2, thickness = 0.2, width = 1, voussoirs = 8, offset = 0.5 }");
  REQUIRE(pointed.size() == 10);
  double top = 0, inner = 0;
  for (const Vec3& v : pointed[3].parts[0].vertices)
    if (std::abs(v.x()) < 1e-12) top = std::max(top, v.z()), inner = inner == 0 ? v.z() : std::min(inner, v.z());
  CHECK(top == Approx(9 + std::sqrt(2.1 * 2.1 - 0.25)));
  CHECK(inner == Approx(9 + std::sqrt(1.9 * 1.9 - 0.25)));
  const auto segment =
      blocks_of("arch{ at = {0, 9, 9}, radius = 2, thickness = 0.2, width = 1, voussoirs = 5, embrace = 100*deg, abutments = false }");
  CHECK(segment.size() == 5);
}

TEST_CASE("columns of boxes and of drums", "[lua][masonry]") {
  const auto boxes = blocks_of("column{ at = {5, 5, 1}, blocks = 3, size = {0.4, 0.5, 0.2}, joint = 0.01 }");
  REQUIRE(boxes.size() == 3);
  CHECK(volume(boxes) == Approx(3 * 0.04));
  CHECK(mass_properties(boxes[2].parts).centroid.z() == Approx(1 + 0.03 + 0.5));
  const auto drums = blocks_of("column{ at = {5, 5, 0}, blocks = 2, diameter = 1, height = 0.5, sides = 12 }");
  CHECK(volume(drums) == Approx(12 * 0.5 * 0.25 * std::sin(pi / 6)));
}

TEST_CASE("mistakes of arches and columns are told together, with their line", "[lua][masonry]") {
  const auto wrong = mistakes_in("arch{ radius = 1, thicknes = 0.1, width = -1, voussoirs = 5.5 }\ncolumn{ blocks = 2 }");
  CHECK(mentions(wrong, "unknown key \"thicknes\"; did you mean \"thickness\"?"));
  CHECK(mentions(wrong, "arch: width = -1 must be above 0 m"));
  CHECK(mentions(wrong, "arch: voussoirs = 5.5 must be a whole number"));
  CHECK(mentions(wrong, "column: give size = { x, y, z }"));
  CHECK(mentions(mistakes_in("arch{ radius = 1, thickness = 0.1, width = 1, voussoirs = 5, offset = 0.2 }"), "even number of voussoirs"));
  CHECK(mentions(mistakes_in("arch{ radius = 1, thickness = 2.5, width = 1, voussoirs = 5 }"), "leaves no opening"));
}

TEST_CASE("the companion of rocking answers in a script", "[lua][rocking]") {
  const Scene scene = scene_of(R"(
local free = rocking{ width = .25, height = 1, theta = .5 * math.atan(.25), duration = 2 }
local table_, lowest = free.amplitudes, rocking_overturning{ width = .4, height = 1.2, from = .9, to = 4, points = 50,
  wave = half_sine{ amplitude = 9.81 * math.atan(1 / 3), frequency = rocking{ width = .4, height = 1.2, duration = 1 }.p / (2 * pi) } }.lowest
param("amplitude", table_[2]) param("impact", free.impacts[1]) param("lowest", lowest)
)");
  CHECK(scene.params[0].value == Approx(0.3867).margin(1e-3));
  CHECK(scene.params[1].value == Approx(0.3492).margin(1e-3));
  CHECK(scene.params[2].value == Approx(1.3680).margin(1e-3));
  CHECK(mentions(mistakes_in("rocking{ duration = 1 }"), "say width and height, or alpha and p"));
  CHECK(mentions(mistakes_in("rocking{ width = 1, height = 2, theta = 0.6, duration = 1 }"), "past alpha"));
}
