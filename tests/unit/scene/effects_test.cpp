// Effects that a scene requires, and the line that requires each.
#include "engine/scene/effects.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// "scene.lua:9" if the effect is on, "" if it is off.
std::string why(const Scene& scene, const std::string& name) {
  for (const Effect& effect : effects_of(scene))
    if (effect.name == name) return effect.on ? effect.because : "";
  FAIL("no effect " << name);
  return {};
}

}  // namespace

TEST_CASE("each effect names the line that called for it", "[scene]") {
  const Scene scene = scene_of(
      "joint{ law = mortar{ E = 1e9, thickness = .01, ft = 1e5, c = 1e5, mu = .6, Gf1 = 5, fc = 1e6, Gc = 3000 } }\n"
      "ground_motion{ wave = 1, direction = {3, 0, 4} }\n"
      "damping{ mass = 2 }\n"
      "box{ name = 'c', size = {1, 1, 1}, at = {5, 0, 0}, free = true }\n"
      "tilt{ wave = .1, axis = 'x' }\n"
      "recorder{ name = 'c', quantity = 'displacement', block = 'c' }\n");
  const auto& joint = scene.joint_rules.at(0).place;
  const auto line = [&](int n) { return Place{joint.file, joint.line + n}.text(); };
  for (const char* name :
       {"softening in tension", "compression plateau", "softening in compression", "rotation of joint frames", "debris contact"})
    CHECK(why(scene, name) == line(0));
  for (const char* name : {"ground x", "ground z"}) CHECK(why(scene, name) == line(1));
  CHECK(why(scene, "mass damping") == line(2));
  CHECK(why(scene, "tilting gravity") == line(4));
  CHECK(why(scene, "recorders") == line(5));
  CHECK(why(scene, "energy ledger") == "every run");
  CHECK(why(scene, "contact dashpots") == scene.materials.at(0).place.text());
  for (const char* name : {"ground y", "softening in shear", "forces on blocks", "moments on blocks", "prescribed motion"})
    CHECK(why(scene, name).empty());
}

TEST_CASE("debris sleeps where the scene says so, and there is any", "[scene][sleep]") {
  const std::string two = "box{ name = 'c', size = {1, 1, 1}, at = {5, 0, 0}, free = true }\n";
  CHECK(why(scene_of(two), "sleep of debris").empty());
  Scene scene = scene_of(two + "analysis{ duration = 1, sleep = true }\n");
  CHECK(why(scene, "sleep of debris") == Place{scene.file, 7}.text());
  Scene without = scene;
  switch_off(without, "sleep of debris");
  CHECK(why(without, "sleep of debris").empty());
  CHECK_FALSE(without.analysis.sleep);
  CHECK(why(scene_of(two + "gravity(0) analysis{ duration = 1, sleep = true }\n"), "sleep of debris").empty());
  scene.blocks.resize(1);
  CHECK(why(scene, "sleep of debris").empty());
}

TEST_CASE("a block alone calls for no contact, a rule of none for no joint", "[scene]") {
  Scene scene = scene_of("joint{ between = {'', ''}, none = true }\ndamping{ mass = 2, scope = 'none' }");
  CHECK(why(scene, "rotation of joint frames").empty());
  CHECK(why(scene, "mass damping").empty());
  scene.blocks.resize(1);
  CHECK(why(scene, "debris contact").empty());
  CHECK(why(scene, "contact dashpots").empty());
}

TEST_CASE("contacts have levels where joints may keep the step short and the solver knows them", "[scene][levels]") {
  const std::string apart = "box{ name = 'c', size = {1, 1, 1}, at = {5, 0, 0}, free = true }\n",
                    two = apart + "joint{ law = dry{ kn = 1e9, mu = .6 } }\n";
  CHECK(why(scene_of(two), "levels of contacts") == "by default");
  CHECK(why(scene_of(apart), "levels of contacts").empty());
  Scene scene = scene_of(two + "analysis{ duration = 1, levels = 4 }\n");
  CHECK(why(scene, "levels of contacts") == Place{scene.file, 8}.text());
  CHECK(one_level_only(scene) == nullptr);
  Scene without = scene;
  switch_off(without, "levels of contacts");
  CHECK(without.analysis.levels == 1);
  CHECK(why(without, "levels of contacts").empty());
  for (const char* one : {"analysis{ duration = 1, solver = 'sequential' }", "analysis{ duration = 1, kernel = 'reference' }",
                          "damping{ joint_ratio = .02, at = 10 }"}) {
    INFO(one);
    CHECK(one_level_only(scene_of(two + one)) != nullptr);
    CHECK(why(scene_of(two + one), "levels of contacts").empty());
  }
}

TEST_CASE("every effect can be switched off, and another name is met with all of them", "[scene]") {
  Scene scene = scene_of("");
  for (const Effect& effect : effects_of(scene)) CHECK_NOTHROW(switch_off(scene, effect.name));
  CHECK_THROWS_WITH(switch_off(scene, "debris contacts"), Catch::Contains("did you mean \"debris contact\"?"));
  CHECK_THROWS_WITH(switch_off(scene, "dashpots"),
                    Catch::Contains("did you mean \"dashpots of joints\"?") && Catch::Contains("only ground x, ground y,"));
}
