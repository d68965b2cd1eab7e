// Supports that move, and joint rules whose groups a variant of a scene lacks.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

const std::string ring =
    "local a = arch{ radius = 2, thickness = .3, width = .5, voussoirs = 9, at = {0, 3, 0} }\n"
    "joint{ law = dry{ kn = 1e10, mu = .6 } }\n";

// Displacement (m) that the loads of the scene prescribe for the block at time t.
Vec3 moved(const Scene& scene, const std::string& block, double t) {
  Vec3 sum = Vec3::Zero();
  for (const Load& load : scene.loads)
    if (load.block == block) sum += value(load.wave, t) * load.direction;
  return sum;
}

}  // namespace

TEST_CASE("supports spread by halves, or one of them by the whole", "[lua][supports]") {
  Scene scene = scene_of(ring + "spread{ supports = a.abutments, by = 40*mm, start = 1, duration = 2 }");
  CHECK(scene.loads.size() == 2);
  CHECK(moved(scene, "arch.left", 0.5).norm() == 0);
  CHECK((moved(scene, "arch.left", 5) - Vec3(-0.02, 0, 0)).norm() < 1e-15);
  CHECK((moved(scene, "arch.right", 3) - Vec3(0.02, 0, 0)).norm() < 1e-15);
  CHECK(moved(scene, "arch.right", 2).x() == Approx(0.01));  // half of the way at half of the time
  const double early = 0.1;                                  // share of the duration: 10 x^3 - 15 x^4 + 6 x^5
  CHECK(moved(scene, "arch.right", 1 + 2 * early).x() == Approx(0.02 * 0.00856).epsilon(1e-6));
  scene = scene_of(ring + "spread{ supports = a.abutments, by = 0 }");  // a param that is off
  CHECK(scene.loads.empty());
}

TEST_CASE("only one end spreads, and supports between share it by their place", "[lua][supports]") {
  std::string piers = "joint{ law = dry{ kn = 1e10, mu = .6 } }\n";
  for (int i = 0; i < 4; ++i)
    piers += fmt::format("box{{ name = 'p{}', group = 'foot{}', size = {{1, 1, 1}}, at = {{{}, 5, 0}}, fixed = true }}\n", i, i / 2, 2 * i);
  const Scene last = scene_of(piers + "spread{ supports = {'p0', 'p1', 'p3'}, by = 0.3, ends = 'last', direction = {2, 0, 0} }");
  CHECK(last.loads.size() == 2);
  CHECK(moved(last, "p1", 9).x() == Approx(0.1));
  CHECK(moved(last, "p3", 9).x() == Approx(0.3));
  const Scene first = scene_of(piers + "spread{ supports = {'foot0', 'foot1'}, by = 0.3, ends = 'first' }");
  CHECK(moved(first, "p0", 9).x() == Approx(-0.3));
  CHECK(moved(first, "p1", 9).x() == Approx(-0.3));
  CHECK(moved(first, "p2", 9).norm() == 0);
  const Scene sunk = scene_of(piers + "settle{ supports = {'foot0', 'p3'}, by = 50*mm }\nspread{ supports = {'p0', 'p3'}, by = 10*mm }");
  CHECK((moved(sunk, "p3", 9) - Vec3(0.005, 0, -0.05)).norm() < 1e-15);
  CHECK(moved(sunk, "p1", 9).z() == Approx(-0.05));
}

TEST_CASE("a support moves in the frame it was built in", "[lua][supports]") {
  const Scene scene = scene_of(
      "joint{ law = dry{ kn = 1e10, mu = .6 } }\n"
      "transform{ rotation = {0, 0, 90*deg}, function()\n"
      "  local a = arch{ radius = 2, thickness = .3, width = .5, voussoirs = 9, at = {5, 0, 0} }\n"
      "  spread{ supports = a.abutments, by = 40*mm }\nend }");
  CHECK((moved(scene, "arch.left", 9) - Vec3(0, -0.02, 0)).norm() < 1e-12);
}

TEST_CASE("what a function moves does not stop within the last step of the run", "[lua][supports]") {
  const Scene scene = scene_of(
      "analysis{ duration = 0.5 }\n"
      "box{ name = 'table', size = {1,1,1}, at = {5,0,0}, material = 'brick', free = true }\n"
      "motion{ block = 'table', wave = function(t) return t * t end }\n"
      "force{ block = 'b', wave = function(t) return t end }\n");
  CHECK(value(scene.loads.at(0).wave, 0.5005) == Approx(0.5005 * 0.5005).epsilon(1e-9));
  CHECK(value(scene.loads.at(1).wave, 0.5005) == Approx(0.5));  // a force keeps its last value
}

TEST_CASE("mistakes of moving supports have a place, a cause and a remedy", "[lua][supports]") {
  const auto wrong = [&](const std::string& text) { return mistakes_in(ring + text); };
  CHECK(mentions(wrong("settle{ supports = 'arch.lefd', by = 1*mm }"),
                 "scene.lua:8: settle: supports: no block or group built so far is called "
                 "\"arch.lefd\"; did you mean \"arch.left\"?"));
  CHECK(mentions(wrong("settle{ supports = 'arch.v03', by = 1*mm }"),
                 "block \"arch.v03\" is free; supports are fixed blocks: add fixed = true"));
  CHECK(mentions(wrong("settle{ supports = {}, by = 1*mm }"), "supports names none"));
  CHECK(mentions(wrong("settle{ supports = {'arch.left', 'arch_abutment'}, by = 1*mm }"), "\"arch.left\" is named twice"));
  CHECK(mentions(wrong("settle{ by = 1*mm }"), "\"supports\" is missing"));
  CHECK(mentions(wrong("spread{ supports = 'arch.left', by = 1*mm }"), "at least two"));
  CHECK(mentions(wrong("spread{ supports = a.abutments, by = 1*mm, direction = 'y' }"), "side by side across the direction"));
  CHECK(mentions(wrong("spread{ supports = a.abutments, by = 1*mm, ends = 'left' }"), "both"));
  CHECK(mentions(wrong("spread{ supports = a.abutments, by = 1*mm, direction = {0, 0, 0} }"), "direction"));
  CHECK(mentions(wrong("spread{ supports = a.abutments, by = 1*mm, duration = 0 }"), "duration"));
}

TEST_CASE("an arch whose supports spread by little stands, and its ledger closes", "[lua][supports]") {
  Bench bench;
  CHECK(bench.run("material{ name = 'stone', density = 2400 }\njoint{ law = dry{ kn = 1e9, mu = .8 } }\n"
                  "local a = arch{ radius = 2, thickness = .5, width = .5, voussoirs = 7 }\n"
                  "spread{ supports = a.abutments, by = 20*mm, duration = .5 }\ndamping{ mass = 5 }\n"
                  "gravity(g)\nanalysis{ duration = .7 }\n"
                  "recorder{ name = 'key', quantity = 'displacement', block = a.crown[1], axis = 'z' }\n"
                  "recorder{ name = 'foot', quantity = 'displacement', block = 'arch.right', axis = 'x' }\n"
                  "metric('sinks', 'm', function(run) return -run.last 'key_uz_rel_m' end)\n"
                  "metric('moves', 'm', function(run) return run.last 'foot_ux_rel_m' end)\n"
                  "expect('metrics.moves', 0.01, { abs = 1e-9, source = 'half of the spread' })\n"
                  "expect('metrics.sinks', 0, { between = { 0.005, 0.05 }, source = 'three hinges: rise falls by about span / rise / 4 of "
                  "the spread' })\n"
                  "expect('collapse.collapsed', false, { source = 'thick enough' })\n"
                  "expect('status', 'completed', { source = 'ledger' })\n") == 0);
  INFO(bench.said);
}

TEST_CASE("a mistake in supports is told once, whatever follows from it", "[lua][supports][bad_input]") {
  const std::string feet =
      "for i = 0, 3 do box{ name = 'f' .. i, group = 'feet', fixed = i > 2, size = { .3, .3, .3 }, at = { 5 + i, 0, 0 } } end\n";
  const auto once = [&](const std::string& text, const std::string& part) {
    INFO(text);
    const std::vector<std::string> all = mistakes_in(feet + text);
    CHECK(all.size() == 1);
    CHECK(mentions(all, part));
  };
  once("settle{ supports = {'feet'}, by = .1 }", "block \"f0\" is free, and so are 2 more of \"feet\"");
  once("spread{ supports = {'f3', 'f3'}, by = .1 }", "\"f3\" is named twice");
  once("settle{ supports = {'f3'}, by = .1 } force{ block = 'f3', wave = 1 }", "is fixed and feels none");
}

TEST_CASE("a joint rule may be optional, or name a group that a builder left empty", "[bad_input]") {
  const std::string wall =
      "local w = wall{ length = 2, courses = 4, brick = { length = .3, width = .125, height = .1 }, joint = 0, quiet = true, at = {5, 0, "
      "0}, material = 'brick' }\n"
      "joint{ law = dry{ kn = 1e9, mu = .6 } }\n";
  const auto rule = [](const std::string& group, const std::string& more) {
    return "joint{ between = {'" + group + "', ''}, law = dry{ kn = 1e9, mu = .6 }" + more + " }";
  };
  // A wall without openings has no lintels, but their group is known: no mistake, no warning.
  CHECK(warnings(scene_of(wall + rule("lintel", ""))).empty());
  CHECK(mentions(mistakes_in(wall + rule("lintle", "")), "no block is of group \"lintle\"; did you mean \"lintel\"?"));
  // wall_b resembles wall: a mistake, unless the rule is optional; then a doubt.
  CHECK(mentions(mistakes_in(wall + rule("walls", "")), "optional = true admits a group that this variant of the scene lacks"));
  CHECK(mentions(warnings(scene_of(wall + rule("walls", ", optional = true"))), "so that this rule joins nothing; did you mean \"wall\"?"));
  CHECK(warnings(scene_of(wall + rule("buttress", ", optional = true"))).empty());
  CHECK(mentions(warnings(scene_of(wall + rule("buttress", ""))), "no block is of group \"buttress\""));
}
