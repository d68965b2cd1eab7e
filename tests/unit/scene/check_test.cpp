// Mistakes that are found without a model, on scenes made by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/scene/scene.h"

using namespace erbs;

namespace {

bool mentions(const std::vector<std::string>& messages, const std::string& part) {
  for (const auto& message : messages)
    if (message.find(part) != std::string::npos) return true;
  return false;
}

Scene sound() {
  Scene scene;
  scene.file = "s.lua";
  Material brick;
  brick.name = "brick";
  brick.density = 1800;
  scene.materials = {brick};
  Block block;
  block.name = "a";
  block.group = "wall";
  block.material = 0;
  block.parts = {box_polyhedron({0, 0, 0}, {1, 1, 1})};
  block.place = {"s.lua", 3};
  scene.blocks = {block};
  scene.analysis.duration = 1;
  return scene;
}

}  // namespace

TEST_CASE("a sound scene passes the check", "[scene]") { CHECK(check(sound()).empty()); }

TEST_CASE("an empty scene says what is missing", "[scene]") {
  Scene scene;
  scene.file = "s.lua";
  CHECK(mentions(check(scene), "s.lua: the scene has no blocks; add box{"));
  CHECK(mentions(check(scene), "the run has no duration; add analysis{ duration = 10 }"));
}

TEST_CASE("names must be unique", "[scene]") {
  Scene scene = sound();
  scene.materials.push_back(scene.materials[0]);
  scene.blocks.push_back(scene.blocks[0]);
  CHECK(mentions(check(scene), "material \"brick\" is there twice"));
  CHECK(mentions(check(scene), "s.lua:3: block \"a\" is there twice"));
}

TEST_CASE("shapes that are no solid are named", "[scene]") {
  Scene scene = sound();
  scene.blocks[0].parts.edit()[0].vertices[6].x() = NAN;
  CHECK(mentions(check(scene), "s.lua:3: block \"a\": "));
  scene = sound();
  for (Vec3& v : scene.blocks[0].parts.edit()[0].vertices) v.z() = 0;  // flat
  CHECK(mentions(check(scene), "block \"a\": "));
  scene = sound();
  for (auto& face : scene.blocks[0].parts.edit()[0].faces.edit()) std::reverse(face.begin(), face.end());  // inside out
  CHECK(mentions(check(scene), "block \"a\": "));
  scene = sound();
  scene.blocks[0].parts.edit()[0].faces.edit().pop_back();  // open
  CHECK(mentions(check(scene), "block \"a\": "));
  scene = sound();
  scene.blocks[0].parts.edit()[0].vertices[6] = {0.4, 0.4, 0.4};  // dented
  CHECK(mentions(check(scene), "block \"a\": "));
}

TEST_CASE("parts that share volume are named, parts that touch are not", "[scene]") {
  Scene scene = sound();
  Block& block = scene.blocks[0];
  const auto cube = [](double x) { return box_polyhedron({x, 0, 0}, {x + 1, 1, 1}); };
  block.parts = {cube(0), cube(1), cube(2 - .9e-3)};  // a little askew, as two blocks may be
  CHECK(check(scene).empty());
  block.parts = {cube(0), cube(1 - .01)};
  REQUIRE(check(scene).size() == 1);
  CHECK(mentions(check(scene), "s.lua:3: block \"a\": its parts 1 and 2 overlap by 10 mm, 0.01 of their smaller edge, and what they"));
  CHECK(mentions(check(scene), "cut them so that they only touch"));
  block.parts = {cube(0), cube(1), cube(2 - .01), cube(2)};
  CHECK(mentions(check(scene), "its parts 3 and 4 overlap by 990 mm, 0.99 of their smaller edge (1 more overlap)"));
  block.parts = {cube(0), cube(0)};
  CHECK(mentions(check(scene), "its parts 1 and 2 overlap by 1e+03 mm, 1 of their smaller edge"));
  Polyhedron open = cube(.5);
  Faces::List faces(open.faces.begin(), open.faces.end());
  faces.pop_back();
  open.faces = std::move(faces);
  block.parts = {cube(0), open};  // no solid: its defect is told alone
  CHECK(check(scene).size() == 1);
  CHECK(mentions(check(scene), "part 2: "));
}

TEST_CASE("numbers out of range are named with their range", "[scene]") {
  Scene scene = sound();
  scene.materials[0].density = -1;
  scene.analysis.output_dt = NAN;
  CHECK(mentions(check(scene), "material \"brick\": density is out of range"));
  CHECK(mentions(check(scene), "analysis: output_dt is out of range"));
}

TEST_CASE("loads and joints name what exists", "[scene]") {
  Scene scene = sound();
  Load load;
  load.kind = Load::Kind::force;
  load.block = "aa";
  scene.loads = {load};
  JointRule rule;
  rule.group_a = "wal";
  rule.law = DryFriction{1e9, 4e8, 0.6};
  scene.joint_rules = {rule};
  CHECK(mentions(check(scene), "force: there is no block \"aa\"; did you mean \"a\"?"));
  CHECK(mentions(check(scene), "joint: no block is of group \"wal\"; did you mean \"wall\"?"));
}

TEST_CASE("the trapezoid rule wants both ends of each side", "[scene]") {
  Scene scene = sound();
  JointRule rule;
  rule.place = {"s.lua", 9};
  rule.law = DryFriction{1e9, 4e8, 0.6};
  rule.rule = "trapezoid", rule.points_long = 1, rule.points_short = 3;
  scene.joint_rules = {rule};
  CHECK(mentions(check(scene),
                 "s.lua:9: joint: points = { 1, 3 }, and rule = \"trapezoid\" has a point at each end of a side; give at least"));
  scene.joint_rules[0].points_long = 2;
  CHECK(check(scene).empty());
}

TEST_CASE("a mortar without stiffness is a mistake, a capped or snapping one a warning", "[scene]") {
  Scene scene = sound();
  JointRule rule;
  Mortar mortar;
  mortar.mu = 0.5;
  rule.law = mortar;
  scene.joint_rules = {rule};
  CHECK(mentions(check(scene), "the mortar has no normal stiffness; give kn, or E and the thickness"));
  mortar.kn = mortar.ks = 1e10;
  mortar.c = 1e5;
  mortar.ft = 3e5;  // c / mu = 2e5
  mortar.Gf1 = 1;   // ft^2 / (2 kn) = 4.5
  scene.joint_rules[0].law = mortar;
  CHECK(check(scene).empty());
  CHECK(mentions(warnings(scene), "it is capped there"));
  CHECK(mentions(warnings(scene), "snaps back"));
  mortar.Gf2 = 0.4;  // c^2 / (2 ks) = 0.5
  scene.joint_rules[0].law = mortar;
  CHECK(mentions(warnings(scene), "snaps back in shear"));
  mortar.Gf2 = 0.6;
  mortar.ft = 1e5;  // 0.5 J/m2
  scene.joint_rules[0].law = mortar;
  CHECK(warnings(scene).empty());
}

TEST_CASE("numbers whose unit is hardly meant are warned of, a kind once with a count", "[scene]") {
  Scene scene = sound();
  CHECK(warnings(scene).empty());
  scene.blocks[0].parts = {box_polyhedron({0, 0, 0}, {300, 125, 65})};
  scene.blocks.push_back(scene.blocks[0]);
  scene.materials[0].density = 1.8;
  Mortar mortar;
  mortar.kn = 5000, mortar.ft = 0.1, mortar.c = 0.2, mortar.fc = 2e9;
  JointRule rule;
  rule.law = mortar;
  scene.joint_rules = {rule};
  const std::vector<std::string> said = warnings(scene);
  CHECK(mentions(said, "s.lua:3: block \"a\" is 300 m long (and 1 more like it)"));
  CHECK(mentions(said, "a density of 1.8 kg/m3"));
  CHECK(mentions(said, "normal stiffness is 5000 Pa/m"));
  CHECK(mentions(said, "ft = 0.1 Pa (and 2 more like it)"));
  scene.blocks[0].fixed = scene.blocks[1].fixed = true;
  CHECK_FALSE(mentions(warnings(scene), "m long"));
}

TEST_CASE("keys that another key would have to switch on are told", "[scene]") {
  Scene scene = sound();
  CHECK(warnings(scene).empty());
  scene.analysis.iterations = 4, scene.analysis.seed = 7;
  CHECK(mentions(warnings(scene), "without solver = \"sequential\" there is no use for iterations, seed"));
  scene.analysis.solver = "sequential";
  CHECK(warnings(scene).empty());

  scene.analysis.ramp_time = 2;
  CHECK(mentions(warnings(scene), "takes it only where there is no equilibrium"));
  scene.analysis.start = "rest";
  CHECK(mentions(warnings(scene), "has no ramp: leave it out"));
  scene.analysis.start = "ramp";
  CHECK(warnings(scene).empty());

  Mortar mortar;
  mortar.kn = 1e10, mortar.ks = 4e9, mortar.mu = 0.7, mortar.Gf1 = 10;
  JointRule rule;
  rule.law = mortar;
  scene.joint_rules = {rule};
  CHECK(mentions(warnings(scene), "Gf1 = 10 J/m2 does nothing, since ft = 0"));
}
