// How a push names what falls: the mechanism of the whole, the share of the mass, and what each wall does.
#include <catch2/catch.hpp>
#include <map>

#include "tests/unit/analysis/push.h"

using namespace erbs;
using namespace erbs::lua;

using test::push, test::stone;

TEST_CASE("a push names its mechanism", "[push]") {
  const auto mechanism = [](const std::string& text) {
    const test::Scratch dir("push_name");
    return push(text, dir.path).metrics.capacity->mechanism;
  };
  const auto block = [](const char* size, const char* mu) {
    return stone + "box{ name = 'b', size = " + size + ", at = {-.2, -.2, 0} } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = " + mu +
           " } } analysis{ kind = 'pushover', step = .05, bracket = .05 }";
  };
  CHECK(mechanism(block("{.4, .4, .5}", ".3")) == "sliding");
  // Two beds slide, the upper one ahead of the lower one: what looks like a rotation is none.
  CHECK(mechanism(stone + "column{ blocks = 4, size = {.8, .8, .3} } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .2 } } "
                          "analysis{ kind = 'pushover', step = .05, bracket = .05 }") == "sliding");
  CHECK(mechanism(block("{.4, .4, 1.2}", ".7")) == "overturning");
  // Walls of four courses: friction below thickness over height slides, above it overturns, whatever the proportion.
  for (const double aspect : {1.5, 2.0, 3.0})
    for (const double mu : {0.6 / aspect, 1.6 / aspect}) {
      CAPTURE(aspect, mu);
      const std::string name = mechanism(
          stone + fmt::format("for i = 0, 3 do box{{ name = 'b' .. i, size = {{.3, 1, {0}}}, at = {{-.15, -.5, i * {0}}} }} end "
                              "joint{{ law = dry{{ kn = 1e10, ks = 4e9, mu = {1} }} }} analysis{{ kind = 'tilt', bracket = .005 }}",
                              0.075 * aspect, mu));
      CHECK(name == (mu * aspect < 1 ? "sliding" : "overturning out of plane"));
    }
  CHECK(mechanism(block("{.2, 1.2, 1.2}", ".7")) == "overturning out of plane");
  // A stack of soft beds between planes of symmetry: each bed opens by little, while its sides slide along the planes by far more.
  CHECK(mechanism(stone + "column{ blocks = 12, size = {.8, .8, .4} } joint{ law = dry{ kn = 2e8, ks = 1e8, mu = .7 } } "
                          "for i = -1, 1, 2 do box{ name = 'plane' .. i, group = 'plane', fixed = true, size = {4, .5, 5}, "
                          "at = {-2, i * .65 - .25, 0} } end joint{ between = {'plane', ''}, law = dry{ kn = 1e9, ks = 1e5, mu = 0 } } "
                          "analysis{ kind = 'pushover', step = .02, bracket = .02 }") == "overturning");
  CHECK(mechanism(stone + "box{ name = 'b', size = {.4, .4, 1.2}, at = {-.2, -.2, 0} }"  // 24 kPa of weight
                          "joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 0, c = 0, mu = .7, fc = 25*kPa, Gc = 30 } }"
                          "analysis{ kind = 'pushover', step = .002, bracket = .05 }") == "crushing");
  CHECK(mechanism(R"(
material{ name = "stone", density = 2000, kn = 1e11, ks = 4e10, friction = 3 }
arch{ radius = 2, thickness = .4, width = .5, voussoirs = 9, embrace = 150*deg }
joint{ law = dry{ kn = 1e11, ks = 4e10, mu = 3 } }
analysis{ kind = "pushover", step = .05, bracket = .05 })") == "hinges");
}

TEST_CASE("all of a stack that turns about its foot overturns, the block next to its hinge as well", "[push]") {
  const test::Scratch dir("push_stack");
  const Capacity got = *push(stone +
                                 "column{ blocks = 8, size = {.4, .4, .3} } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .7 } } "
                                 "analysis{ kind = 'pushover', step = .02, bracket = .05 }",
                             dir.path)
                            .metrics.capacity;
  CHECK_THAT(got.course, Catch::StartsWith("overturning of 100 % of the mass: 1 bed and 0 head joints"));
}

TEST_CASE("a wall whose courses all slide on each other slides, though heads part in it", "[push]") {
  const test::Scratch dir("push_courses");
  const Capacity got = *push(stone +
                                 "wall{ brick = { length = .3, width = .15, height = .1 }, length = .9, courses = 8, joint = 0, "
                                 "closer = .05, at = {-.45, -.075, 0}, material = 'stone', quiet = true } "
                                 "joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .6 } } "
                                 "analysis{ kind = 'pushover', step = .05, bracket = .02 }",
                             dir.path)
                            .metrics.capacity;
  CHECK(got.peak.multiplier == Approx(0.6).epsilon(0.03));
  CHECK_THAT(got.course, Catch::StartsWith("sliding of "));
  REQUIRE(got.walls.size() == 1);
  CHECK(got.walls[0].second == "sliding");
}

TEST_CASE("a push tells what each wall does", "[push]") {
  const auto walls = [](const std::string& text) {
    const test::Scratch dir("push_walls");
    const auto pairs = push(text, dir.path).metrics.capacity->walls;
    return std::map<std::string, std::string>(pairs.begin(), pairs.end());
  };
  const auto room = [](const char* direction) {
    return stone +
           "building{ plan = {2.4, 3}, at = {-1.2, -1.5, 0}, brick = { length = .6, width = .3, height = .2 }, courses = 8, joint = 0, "
           "material = 'stone', quiet = true } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .6 } } analysis{ kind = 'pushover', step = "
           ".02, bracket = .05, direction = '" +
           direction + "' }";
  };
  // Along x the walls east and west stand across the push, along y those in the south and north.
  auto found = walls(room("x"));
  CHECK(found["wall_east"].find("out of plane") != std::string::npos);
  CHECK(found["wall_south"] == "diagonal cracks");
  found = walls(room("y"));
  CHECK(found["wall_north"].find("out of plane") != std::string::npos);
  CHECK(found["wall_east"] == "diagonal cracks");
  // In its own plane a long dry wall of high friction cracks in steps; on a smooth foot it slides as one body.
  const auto wall = [](const char* length, const char* mu, const char* direction) {
    return stone + "wall{ brick = { length = .4, width = .2, height = .2 }, length = " + length +
           ", courses = 6, joint = 0, at = {-.6, -.1, 0}, material = 'stone', quiet = true } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = " +
           mu +
           " } } joint{ between = { 'wall', 'wall' }, law = dry{ kn = 1e10, ks = 4e9, mu = .7 } } "
           "analysis{ kind = 'pushover', step = .02, bracket = .05, direction = '" +
           direction + "' }";
  };
  CHECK(walls(wall("1.2", ".7", "x"))["wall"] == "diagonal cracks");
  CHECK(walls(wall("2.4", ".2", "x"))["wall"] == "sliding");
  CHECK(walls(wall("2.4", ".7", "y"))["wall"] == "overturning out of plane");
  CHECK(walls(stone + "box{ name = 'b', size = {.4, .4, .5}, at = {-.2, -.2, 0} } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .3 } } "
                      "analysis{ kind = 'pushover', step = .05, bracket = .05 }")
            .empty());  // no wall
}

TEST_CASE("a scene may expect what a wall does, and no wall that is not there", "[push]") {
  const std::string scene =
      stone +
      "wall{ brick = { length = .4, width = .2, height = .2 }, length = 1.2, courses = 4, joint = 0, at = {-.6, -.1, 0}, "
      "material = 'stone', quiet = true } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .6 } } "
      "analysis{ kind = 'pushover' } expect('capacity.walls.";
  CHECK_NOTHROW(Script(quiet()).load_text(scene + "wall', 'overturning out of plane')", "scene.lua", {}));
  CHECK_THROWS_WITH(Script(quiet()).load_text(scene + "wal', 'sliding')", "scene.lua", {}),
                    Catch::Contains("did you mean \"capacity.walls.wall\""));
}
