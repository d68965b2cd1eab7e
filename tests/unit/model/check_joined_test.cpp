// Detection of joined and loose blocks at rest, on scenes of a few bricks.
#include <catch2/catch.hpp>

#include "engine/analysis/start/prepare.h"
#include "engine/model/build/build.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

Scene scene_with(const std::string& piece) {
  Script script(quiet());
  return script.load_text(
      "material{ name = 'brick', density = 1800 }\nanalysis{ duration = 1 }\n"
      "ground{ size = 4 }\n"
      "joint{ law = dry{ kn = 1e9, mu = .6 }, thickness = param('t', 0) }\n" +
          piece,
      "scene.lua");
}

std::vector<std::string> refused(const Scene& scene) {
  try {
    build(scene);
  } catch (const Errors& errors) { return errors.messages; }
  return {};
}

const std::string stack = "for i = 0, 2 do box{ name = 'b' .. i, size = {.3, .2, .1}, at = {0, 0, lift + .1 * i}, free = loose } end\n";

}  // namespace

TEST_CASE("a joined stack above the ground is refused, unless it says that it is free", "[model]") {
  const auto messages = refused(scene_with("lift, loose = 3*mm, false\n" + stack));
  REQUIRE(messages.size() == 1);
  CHECK(contains(messages[0], "scene.lua:6: the 3 blocks joined to 'b0' have no way to the ground"));
  CHECK(contains(messages[0], "'b0' lies 3 mm above 'ground'"));
  CHECK(refused(scene_with("lift, loose = 3*mm, true\n" + stack)).empty());
  CHECK(refused(scene_with("lift, loose = 0, false\n" + stack)).empty());
  CHECK(refused(scene_with("gravity(0)\nlift, loose = 3*mm, false\n" + stack)).empty());
}

TEST_CASE("a gap to what lies below is that of the faces, on a slope too, and of a single block too", "[model]") {
  const std::string slope =
      "transform{ rotation = {.4, .2, .1}, function()\n"
      "box{ name = 'base', size = {9, 9, .2}, center = {0, 0, 1.9}, fixed = true }\n";
  const auto lifted = refused(scene_with("lift, loose = 2 + 3*mm, false\n" + slope + stack + "end }\n"));
  REQUIRE(lifted.size() == 1);
  CHECK(contains(lifted[0], "'b0' lies 3 mm above 'base'"));
  const auto single = refused(scene_with(slope + "box{ name = 'b', size = {.3, .2, .1}, at = {0, 0, 2 + 4*mm} } end }\n"));
  REQUIRE(single.size() == 1);
  CHECK(contains(single[0], "block 'b' has no joint with any other: 'b' lies 4 mm above 'base'; let a face"));
  const auto beside = refused(scene_with("box{ name = 'b', size = {.3, .2, .1}, at = {50, 0, 0} }\n"));
  REQUIRE(beside.size() == 1);
  CHECK(contains(beside[0], "block 'b' has no joint with any other; let a face"));
}

TEST_CASE("joints across a gap that is not the rule's are counted", "[model]") {
  const auto told = [](const std::string& rule) {
    return build(scene_with(rule + "box{ name = 'a', size = {.3, .2, .1}, at = {0, 0, 4*mm} }\n"
                                   "box{ name = 'b', size = {.3, .2, .1}, at = {0, 0, 106*mm} }\n"))
        .warnings;
  };
  const auto said = told("joint{ law = dry{ kn = 1e9, mu = .6 }, thickness = 4*mm }\n");
  CHECK(mentions(said, "scene.lua:5: 1 joint of this rule bridges a gap of 2 mm, not the 4 mm it says (first between 'a' and 'b')"));
  CHECK_FALSE(mentions(told("joint{ law = dry{ kn = 1e9, mu = .6 }, thickness = 4*mm, tolerance = 2*mm }\n"), "bridge"));
}

TEST_CASE("faces that miss their joint by a little are counted", "[model]") {
  const auto said = build(scene_with("for i = 0, 2 do box{ name = 'b' .. i, size = {.3, .2, .1}, at = {i * .303, 0, 0} } end\n")).warnings;
  CHECK(mentions(said, "2 pairs of blocks face each other across gaps of 3 mm and are not joined (first 'b0' and 'b1')"));
}

TEST_CASE("overlaps that are let be are one warning, their list is for the log", "[model]") {
  const Built built =
      build(scene_with("analysis{ overlap = 'stress_free' }\n"
                       "for i = 0, 2 do\n"
                       "  box{ name = 'a' .. i, size = {.3, .2, .1}, at = {.5*i, 0, 0} }\n"
                       "  box{ name = 'b' .. i, size = {.3, .2, .1}, at = {.5*i, 0, .099} }\n"
                       "end\nbox{ name = 'c', size = {.3, .2, .1}, at = {0, 0, .197} }\n"));
  REQUIRE(built.warnings.size() == 1);
  CHECK(contains(built.warnings[0], "4 pairs of blocks overlap"));
  CHECK(contains(built.warnings[0], "'b0' (scene.lua:8) and 'c' (scene.lua:10) overlap by 2 mm"));
  CHECK(built.notes.size() == 2);
}

TEST_CASE("blocks that their initial pose presses into others are named", "[model]") {
  const auto told = [](const std::string& pose, const std::string& free = "true") {
    return build(scene_with("box{ name = 'a', size = {.3, .2, 1}, at = {0, 0, 0}, free = " + free + ", initial = { " + pose + " } }\n"))
        .warnings;
  };
  const auto said = told("rotation = {0, .1, 0}");  // about the centroid: the lower edge of a sinks in
  CHECK(mentions(said, "scene.lua:5: blocks 'ground' (scene.lua:3) and 'a' (scene.lua:5) overlap by"));
  CHECK(mentions(said, "initial.about"));
  CHECK_FALSE(mentions(told("rotation = {0, .1, 0}, about = {.3, .1, 0}"), "initial"));
  CHECK_FALSE(mentions(told("position = {0, 0, -1e-4}"), "initial"));
  // in a joint a little more, as of bricks laid askew
  CHECK_FALSE(mentions(told("position = {0, 0, -.9*mm}", "false"), "initial"));
  CHECK(mentions(told("position = {0, 0, -2*mm}", "false"), "overlap by 2 mm"));
}

TEST_CASE("two joints of the same blocks have names of their own", "[model]") {
  const Model model =
      build(scene_with("block{ name = 'n', parts = { { vertices = { "
                       "{0,0,0},{.1,0,0},{.1,.1,0},{0,.1,0},{0,0,.1},{.1,0,.1},{.1,.1,.1},{0,.1,.1} } },\n"
                       "  { vertices = { {.2,0,0},{.3,0,0},{.3,.1,0},{.2,.1,0},{.2,0,.1},{.3,0,.1},{.3,.1,.1},{.2,.1,.1} } } } }\n"))
          .model;
  REQUIRE(model.njoint == 2);
  CHECK(model.joint_name(0) == "ground | n");
  CHECK(model.joint_name(1) == "ground | n #2");
}

TEST_CASE("a part with too many corners is refused before the run, with its block and line", "[model]") {
  const Scene scene = scene_with(
      "local ring = {}\nfor i = 1, 130 do ring[i] = { math.cos(i * pi / 65), math.sin(i * pi / 65) } end\n"
      "prism{ name = 'drum', polygon = ring, height = 1 }\n");
  try {
    prepare(scene, false);
    FAIL("it was taken");
  } catch (const Errors& errors) {
    CHECK(contains(errors.messages.at(0),
                   "scene.lua:7: block 'drum': a convex part of it has 260 corners and 132 faces; contact takes up to 256 and 512"));
  }
}

TEST_CASE("a time step longer than the run is refused", "[model]") {
  CHECK_THROWS_WITH(prepare(scene_with("box{ size = {.3, .2, .1}, at = {0, 0, 0} }\nanalysis{ duration = 1e-9 }\n"), false),
                    Catch::Contains("is longer than the duration"));
}
