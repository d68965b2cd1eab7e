// The report of a block that fell past the ground gives its position, and the size of ground that would have caught it.
#include "engine/model/lost_blocks.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/model/build/build.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

TEST_CASE("a block beyond the ground is told with its place and a ground that reaches below it", "[model]") {
  Script script(quiet());
  const Scene scene = script.load_text(
      "gravity(g)\nmaterial{ name = 'brick', density = 1800 }\nground{ size = 4 }\nanalysis{ duration = 1 }\n"
      "for k, x in ipairs{ 0, 7 } do box{ name = 'b' .. k, size = {.3, .2, .1}, center = {x, -3, .5}, free = true, material = 'brick' } "
      "end",
      "lost.lua");
  Built built = build(scene);
  CHECK(lost_blocks(built.model, built.state).empty());
  built.state.pose.u[2] = Vec3(0.5, 0, -30);
  const std::string said = lost_blocks(built.model, built.state);
  CHECK(contains(said, "1 block fell past the ground"));
  CHECK(contains(said, "'b2' the first of the scene, now at (7.5, -3, -29.5) m"));
  CHECK(contains(said, "ground{ size = 17 } reaches below it"));  // 2 x (7.5 + .1) + 1, rounded up
  built.state.pose.u[1] = Vec3(-20, 0, -30);
  CHECK(contains(lost_blocks(built.model, built.state), "reaches below all of them"));
}

TEST_CASE("a block that slides far down a fixed slope is not lost", "[model]") {
  Script script(quiet());
  const Scene scene = script.load_text(
      "material{ name = 'brick', density = 1800 }\nanalysis{ duration = 1 }\n"
      "transform{ rotation = {0, .6, 0}, function()\n"
      "box{ name = 'slope', size = {20, 2, .2}, center = {0, 0, -.1}, fixed = true }\n"
      "box{ name = 'b', size = {.3, .2, .1}, center = {0, 0, .05}, free = true } end }\n",
      "slope.lua");
  Built built = build(scene);
  built.state.pose.u[1] = Vec3(5 * std::cos(.6), 0, -5 * std::sin(.6));
  CHECK(lost_blocks(built.model, built.state).empty());
  built.state.pose.u[1] = Vec3(15 * std::cos(.6), 0, -15 * std::sin(.6));
  CHECK(contains(lost_blocks(built.model, built.state), "1 block fell past the ground"));
}
