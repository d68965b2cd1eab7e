// Friction between two materials, or of a material with itself: material{ friction_with = ... }.
#include <catch2/catch.hpp>

#include "engine/contact/broad/search.h"
#include "engine/record/format/json.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// A brick on a slope of tan = .35; both materials have a friction of .6.
std::string slope(const std::string& floor, const std::string& brick) {
  return "local b = math.atan(.35) gravity{ 9.81 * math.sin(b), 0, -9.81 * math.cos(b) }\n"
         "material{ name = 'floor', density = 2000, friction = .6" +
         floor +
         " }\n"
         "material{ name = 'brick', density = 1800, friction = .6" +
         brick +
         " }\n"
         "box{ name = 'plane', material = 'floor', size = { 4, 1, .2 }, at = { -1, -.5, -.2 }, fixed = true }\n"
         "box{ name = 'b', material = 'brick', size = { .3, .2, .1 }, at = { 0, -.1, 0 }, free = true }\n"
         "recorder{ name = 'b', quantity = 'displacement', block = 'b', axis = 'x' }\n"
         "analysis{ duration = .4, start = 'rest' } metric('way', 'm', function(run) return run.last('b_ux_rel_m') end)\n";
}

}  // namespace

TEST_CASE("the shear stiffness of debris goes with its normal stiffness", "[scene]") {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(R"(
    material{ name = "plain", density = 2000 }
    material{ name = "soft", density = 2000, kn = 1e9 }
    material{ name = "slippery", density = 2000, kn = 1e9, ks = 0 }
    box{ name = "b", size = { 1, 1, 1 }, at = { 0, 0, 0 }, free = true, material = "soft" }
    analysis{ duration = 1 })",
                                       "scene.lua", {});
  CHECK(scene.materials[0].ks == Approx(0.4 * 5e10));
  CHECK(scene.materials[1].ks == Approx(4e8));
  CHECK(scene.materials[2].ks == 0);
}

TEST_CASE("the friction between two materials is what either of them says of the other, else the smaller", "[lua][contact]") {
  const Scene scene = scene_of("material{ name = 's', density = 2000, friction = .3, friction_with = { s = .1, brick = .9 } }");
  const Material &brick = scene.materials[0], &stone = scene.materials[1];
  CHECK(pair_law(brick, stone).mu == 0.9);
  CHECK(pair_law(stone, brick).mu == 0.9);
  CHECK(pair_law(stone, stone).mu == 0.1);
  CHECK(pair_law(brick, brick).mu == brick.friction);
  Material other = brick;
  other.name = "other";
  CHECK(pair_law(other, stone).mu == 0.3);
}

TEST_CASE("a brick slides down where its material is slippery on that of the floor, by Coulomb's law", "[lua][contact]") {
  Bench bench;
  const auto way = [&](const std::string& floor, const std::string& brick) {
    REQUIRE(bench.run(slope(floor, brick), {"--no-figures", "--force"}) == 0);
    return read_json(bench.out() + "/metrics.json")["metrics"]["way"].get<double>();
  };
  CHECK(std::abs(way("", "")) < 1e-5);
  const double along = 9.81 * std::sin(std::atan(0.35)), across = 9.81 * std::cos(std::atan(0.35));
  for (const double mu : {0.0, 0.1, 0.3}) {
    const std::string with = fmt::format("{}", mu);
    const double expected = 0.5 * (along - mu * across) * 0.4 * 0.4;
    CHECK(way("", ", friction_with = { floor = " + with + " }") == Approx(expected).epsilon(0.01));
    CHECK(way(", friction_with = { brick = " + with + " }", "") == Approx(expected).epsilon(0.01));
  }
  CHECK(std::abs(way("", ", friction_with = { brick = 0 }")) < 1e-5);  // with itself: not on the floor
}

TEST_CASE("mistakes in friction_with name the material, the allowed range and the nearest name", "[lua][errors]") {
  CHECK(mentions(mistakes_in("material{ name = 's', density = 2000, friction_with = { brik = .5 } }"), "did you mean \"brick\"?"));
  CHECK(mentions(mistakes_in("material{ name = 's', density = 2000, friction_with = { brick = -1 } }"), "allowed is 0 to 10"));
  CHECK(mentions(mistakes_in("material{ name = 's', density = 2000, friction_with = { .5 } }"), "by the names of materials"));
  CHECK(mentions(mistakes_in("material{ name = 's', density = 2000, friction_with = .5 }"), "must be a table"));
  CHECK(mentions(mistakes_in("material{ name = 's', density = 2000, friction_with = { t = .5 } }\n"
                             "material{ name = 't', density = 2000, friction_with = { s = .4 } }"),
                 "say it once"));
}
