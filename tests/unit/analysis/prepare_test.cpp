#include <catch2/catch.hpp>

#include "tests/support/folder.h"
#include "tests/support/small_wall.h"
#include "tests/unit/lua/load.h"
#include "tests/unit/solve/scene_run.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

TEST_CASE("gravity by factorisation and by a damped ramp give the same wall", "[analysis]") {
  Prepared direct, ramped;
  const Scene scene = test::small_wall("analysis{duration=1}");
  direct = prepare(scene, false);
  start_at_rest(scene, direct, 1);
  REQUIRE(direct.equilibrium.converged);
  CHECK(direct.equilibrium.unbalanced < 1e-8);
  Scene slow = scene;
  slow.analysis.start = "ramp";
  ramped = prepare(slow, false);
  start_at_rest(slow, ramped, 2);
  double size = 0, difference = 0;
  for (std::size_t b = 0; b < direct.state.pose.u.size(); ++b) {
    size = std::max(size, direct.state.pose.u[b].norm());
    difference = std::max(difference, (direct.state.pose.u[b] - ramped.state.pose.u[b]).norm());
  }
  CHECK(size > 0);
  CHECK(difference < 1e-3 * size);  // oscillation that remains after the damped ramp
}

TEST_CASE("a wall in equilibrium stays there", "[analysis]") {
  Prepared run;
  const Scene scene = test::small_wall("analysis{duration=1}");
  run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  const BlockVec3 start = run.state.pose.u;
  Solver solver(run.model, run.state, run.range, 1);
  solver.advance_until([&] { return run.state.time.t >= 0.5; });
  for (std::size_t b = 0; b < start.size(); ++b) CHECK((run.state.pose.u[b] - start[b]).norm() < 0.5e-6 * 0.1);
  CHECK(std::all_of(run.state.joints.stage.begin(), run.state.joints.stage.end(), [](JointStage t) { return t == JointStage::intact; }));
}

TEST_CASE("a step past the limit is refused with the reason", "[analysis]") {
  Scene scene = test::small_wall("analysis{duration=1}");
  scene.analysis.dt_fraction = 1.1;
  CHECK_THROWS_WITH(prepare(scene, false), Catch::Contains("1.100 times the limit") && Catch::Contains("unstable"));
  CHECK_NOTHROW(prepare(scene, true));
  for (const char* rule : {"period_tenth", "hart", "limit"}) {
    scene.analysis.dt_rule = rule;
    scene.analysis.dt_fraction = 0.5;
    const Prepared run = prepare(scene, false);
    CHECK(run.state.time.dt > 0);
    CHECK(run.state.time.dt < run.bounds.critical);
  }
}

TEST_CASE("an initial pose that the equilibrium would undo is refused, a velocity is not", "[analysis]") {
  const auto scene = [](const std::string& initial, const std::string& start) {
    Script script(Script::Options{.quiet = true});
    return script.load_text(R"(
      material{ name = "stone", density = 2000 }
      ground{ size = 10, material = "stone" }
      box{ name = "wall", group = "wall", size = {.3, .2, .6}, center = {0, 0, .3}, initial = { )" +
                                initial + R"( } }
      joint{ law = dry{ kn = 1e10, mu = .6 }, between = {"wall", "ground"} }
      analysis{ duration = 1)" + start +
                                " }",
                            "scene.lua");
  };
  for (const char* pose : {"position = {0, 0, 0.001}", "rotation = {0, 5 * deg, 0}, about = {.15, 0, 0}"}) {
    for (const char* start : {"", ", start = 'ramp'"})
      CHECK_THROWS_WITH(prepare(scene(pose, start), false), Catch::Contains("block \"wall\"") && Catch::Contains("start = \"rest\""));
    CHECK_NOTHROW(prepare(scene(pose, ", start = 'rest'"), false));
  }
  CHECK_NOTHROW(prepare(scene("velocity = {.1, 0, 0}", ""), false));
}

TEST_CASE("the extent of a block is that of all its parts, the scale of penetration that of the thinnest", "[analysis]") {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(R"(
    material{ name = "stone", density = 2000 }
    ground{ size = 10, material = "stone" }
    footed_block{ name = "footed", free = true, size = {.25, .5, 1}, foot = .01, at = {0, 0, 0} }
    box{ name = "plain", size = {.3, .2, .1}, center = {2, 0, .05}, rotation = {0, 0, .3}, free = true }
    analysis{ duration = 1 })",
                                       "scene.lua");
  const Model m = prepare(scene, false).model;
  const auto at = [&](const char* name) { return std::size_t(std::ranges::find(m.block_name, name) - m.block_name.begin()); };
  CHECK(m.thickness.at(at("footed")) == Approx(0.25).epsilon(0.01));
  CHECK(m.smallest_edge.at(at("footed")) < 0.01);
  CHECK(m.thickness.at(at("plain")) == Approx(0.1));
  CHECK(m.smallest_edge.at(at("plain")) == m.thickness.at(at("plain")));
}

TEST_CASE("the bounds on the step keep their order", "[analysis]") {
  const Prepared run = prepare(test::small_wall("analysis{duration=1}"), false);
  // K <= 2 blockdiag(K_ii) for springs between pairs, and Cauchy's interlacing: the block bound is exact or up to sqrt 2 too short.
  CHECK(run.bounds.block <= run.bounds.critical * (1 + 1e-9));
  CHECK(run.bounds.critical <= std::sqrt(2.0) * run.bounds.block * (1 + 1e-6));
}

TEST_CASE("dashpots of joints shorten the step to the limit of explicit damping", "[analysis]") {
  const double free = prepare(test::small_wall("analysis{duration=1}"), false).bounds.critical, omega = 2 / free;
  for (const double xi : {0.01, 0.3, 3.0}) {
    const double limit = 2 / omega * (std::sqrt(1 + xi * xi) - xi);
    const Prepared run = prepare(test::small_wall(fmt::format("damping{{stiffness={}}} analysis{{duration=1}}", 2 * xi / omega)), false);
    CHECK(run.bounds.critical == Approx(limit).epsilon(1e-5));
    CHECK(run.bounds.block <= run.bounds.critical * (1 + 1e-6));
    CHECK(run.state.time.dt == Approx(0.9 * run.bounds.critical));
  }
  // With each joint's own damping ratio: b = 2 xi / omega_j.
  const Prepared own = prepare(test::small_wall("damping{joint_ratio=0.1} analysis{duration=1}"), false);
  CHECK(own.bounds.critical < free);
  CHECK(own.bounds.critical > 0.5 * free);
  const Prepared at = prepare(test::small_wall("damping{joint_ratio=0.1, at=100} analysis{duration=1}"), false);
  CHECK(at.model.joint.front().viscous == Approx(0.1 / (pi * 100)));
}

TEST_CASE("a scene whose only moving block is driven runs in tenths of its rows", "[analysis]") {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(R"(
    material{ name = "brick", density = 1800 }
    ground{ size = 4 }
    box{ name = "b", size = { .3, .125, .1 }, at = { 0, 0, 0 } }
    joint{ law = dry{ kn = 1e9, mu = .6 } }
    motion{ block = "b", wave = sine{ amplitude = .01, frequency = 1 }, direction = "x" }
    analysis{ duration = .25, output_dt = .01 })",
                                       "driven.lua");
  Prepared run;
  test::run_to(scene, 1, 0.25, run);
  CHECK(run.state.time.dt == Approx(0.001));
  CHECK(run.state.pose.u[1].x() == Approx(0.01).epsilon(1e-3));
}

TEST_CASE("overlaps and lonely blocks are found together", "[analysis]") {
  const std::string more = R"(
    box{name="inside", size={.25,.125,.1}, at={0.05,0,0.005}, material="brick"}
    box{name="lonely", size={.25,.125,.1}, at={5,0,0}, material="brick"}
    analysis{duration=1})";
  const Scene scene = test::small_wall(more);
  CHECK_THROWS_WITH(prepare(scene, false), Catch::Contains("'inside'") && Catch::Contains("overlap") && Catch::Contains("'lonely'") &&
                                               Catch::Contains("has no joint"));
}

TEST_CASE("a limit of use is held: a coarser step or fewer points are refused with the scene's own reason", "[analysis]") {
  Scene scene = test::small_wall("analysis{duration=1}");
  scene.use_limit.dt_fraction = 0.5;
  scene.use_limit.reason = "it walks";
  CHECK_THROWS_WITH(prepare(scene, false), Catch::Contains("0.900 of the limit") && Catch::Contains("it walks"));
  scene.analysis.dt_fraction = 0.5;
  CHECK_NOTHROW(prepare(scene, false));
  scene.use_limit.points = 1000;
  CHECK_THROWS_WITH(prepare(scene, false), Catch::Contains("good from 1000 on"));
}

TEST_CASE("a ground that stays still is told", "[analysis]") {
  const auto told = [](const std::string& wave) {
    return mentions(prepare(test::small_wall("analysis{duration=1} ground_motion{ wave = " + wave + ", direction = 'x' }"), false).warnings,
                    "this ground_motion is zero from 0 to 1 s");
  };
  CHECK(told("sine{ amplitude = 0, frequency = 2 }"));
  CHECK(told("sine{ amplitude = 1, frequency = 2, start = 3 }"));
  CHECK_FALSE(told("sine{ amplitude = 1, frequency = 1000 }"));
  CHECK_FALSE(told("pulse{ amplitude = 1e4, start = .50003, duration = 1e-4 }"));
}

TEST_CASE("loads that begin after the run, and supports that jump, are told", "[analysis]") {
  const auto told = [](const std::string& load, const std::string& part) {
    return mentions(prepare(test::small_wall("analysis{duration=1} " + load), false).warnings, part);
  };
  const std::string support = "foot", top = "b5_3";
  const auto force = [&](const std::string& wave) { return "force{ block = '" + top + "', direction = 'x', wave = " + wave + " }"; };
  const auto motion = [&](const std::string& wave) { return "motion{ block = '" + support + "', direction = 'x', wave = " + wave + " }"; };
  const std::string late = "begins at 3 s, and the run ends at 1 s";
  CHECK(told(force("sine{ amplitude = 9, frequency = 2, start = 3 }"), late));
  CHECK(told(force("table_wave{ times = { 0, 3, 4 }, values = { 0, 0, 9 } }"), late));
  CHECK(told(motion("pulse{ amplitude = 0.01, start = 3, duration = 1 }"), late));
  CHECK_FALSE(told(force("sine{ amplitude = 9, frequency = 2, start = 0.9 }"), "begins"));
  CHECK_FALSE(told(force("sine{ amplitude = 0, frequency = 2, start = 3 }"), "begins"));

  CHECK(told(motion("sine{ amplitude = 0.01, frequency = 2, phase = pi / 2 }"), "it jumps to 0.01 m at 0 s"));
  CHECK(told(motion("pulse{ amplitude = 0.01, start = 0.5, duration = 9 }"), "it jumps to 0.01 m at 0.5 s"));
  CHECK(told(motion("sine{ amplitude = 0.01, frequency = 2 }"), "starts at once with 0.126 m/s at 0 s"));
  CHECK(told(motion("function(t) return 0.02 * t end"), "starts at once with 0.02 m/s at 0 s"));
  CHECK_FALSE(told(motion("function(t) return 0.02 * t ^ 2 end"), "motion"));
  CHECK_FALSE(told(motion("curve_wave{ times = { 0, 1 }, values = { 0, 0.02 }, hold = true }"), "motion"));
  // A smooth curve swings before its second zero.
  CHECK_FALSE(told(motion("curve_wave{ times = { 0, 1, 2 }, values = { 0, 0, -.3 }, hold = true }"), "it begins at"));
  CHECK_FALSE(told(motion("curve_wave{ times = { 0, .2, .35 }, values = { 0, 0, -.5 }, hold = true }"), "it jumps"));
  CHECK(told(motion("table_wave{ times = { 0, .1 }, values = { 0, .02 } }"), "it starts at once with 0.2 m/s"));
  CHECK(
      told(motion("table_wave{ times = { 0, .1 }, values = { 0, .02 }, hold = false }"), "; it leaps from 0.02 m to 0 at its end, 0.1 s"));
  CHECK_FALSE(told(motion("table_wave{ times = { 0, .1 }, values = { 0, .02 } }"), "leaps"));
  CHECK(told(motion("table_wave{ times = { 0, .1 }, values = { 0, .02 } }"), "; its speed jumps by 0.2 m/s at 0.1 s; a curve_wave"));
  CHECK(told(motion("table_wave{ times = { 0, .8, .9, 1.2 }, values = { 0, 0, .02, .01 } }"), "starts at once with 0.2 m/s at 0.8 s"));
  CHECK(told(motion("table_wave{ times = { 0, .5, .6, .7 }, values = { 0, 0, .02, .01 } }"), "0.3 m/s at 0.6 s (the hardest of 2 such"));
  CHECK_FALSE(told(motion("table_wave{ times = { 0, .5 }, values = { 0, 1e-3 } }"), "speed"));
  CHECK_FALSE(told(motion("curve_wave{ times = { 0, .5, .7 }, values = { 0, .1, -.1 } }"), "motion"));
  CHECK(told(motion("sine{ amplitude = .01, frequency = .01, duration = .25 }"), "motion of block \"foot\": it leaps from"));

  const auto tilt = [](const std::string& axis) {
    return "gravity(g) tilt{ axis = " + axis + ", wave = sine{ amplitude = .1, frequency = 1 } }";
  };
  CHECK(told(tilt("'z'"), "its axis is the line of gravity"));
  CHECK_FALSE(told(tilt("{ .1, 0, 1 }"), "axis"));
  const auto at = [&](const std::string& point) {
    return "force{ block = '" + top + "', direction = 'x', wave = 9, point = " + point + " }";
  };
  CHECK(told(at("{ 9, 9, 9 }"), "m outside of the block"));
}

TEST_CASE("a wall on a table that is tilted from the start is at rest on it", "[analysis]") {
  for (const char* start : {"equilibrium", "ramp"}) {
    CAPTURE(start);
    const Scene scene =
        test::small_wall(std::string("tilt{ axis = 'x', wave = function() return -0.05 end } analysis{duration=1, start='") + start + "'}");
    Prepared run = prepare(scene, false);
    start_at_rest(scene, run, 1);
    const BlockVec3 start_u = run.state.pose.u;
    double leans = 0, moves = 0;
    Solver solver(run.model, run.state, run.range, 1);
    solver.advance_until([&] { return run.state.time.t >= 0.05; });
    for (std::size_t b = 0; b < start_u.size(); ++b) {
      leans = std::max(leans, std::hypot(start_u[b].x(), start_u[b].y()));
      moves = std::max(moves, (run.state.pose.u[b] - start_u[b]).norm());
    }
    CHECK(leans > 1e-8);
    CHECK(moves < 0.01 * leans);
    CHECK(run.model.gravity.x() == 0);
  }
}

TEST_CASE("a scene so far from the origin that pictures of it are coarse is told", "[analysis]") {
  const auto told = [](double x) {
    const std::string place = fmt::format("{{ {}, 0, 0 }}", x);
    const Scene scene = test::small_wall(
        fmt::format("analysis{{ duration = 1 }} box{{ name = 'far', free = true, size = {{ .2, .1, .1 }}, at = {} }}", place));
    return mentions(prepare(scene, false).warnings, "have steps of");
  };
  CHECK_FALSE(told(1000));
  CHECK(told(20000));  // steps of 2.4 mm
}

TEST_CASE("the step follows loads that are faster than the structure", "[analysis]") {
  const auto step = [](const std::string& more) {
    lua::Script script(lua::quiet());
    const Scene scene = script.load_text(R"(
      material { name = "stone", density = 2000 }
      box { name = "floor", size = { 2, 2, .1 }, at = { -1, -1, -.1 }, fixed = true }
      box { name = "b", size = { 1, 1, 1 }, at = { -.5, -.5, 0 } }
      joint { law = mortar { kn = 8e6, ft = 1e9, c = 1e9, mu = .7 } }
      analysis { duration = 1 }
    )" + more,
                                         "scene.lua", {});
    return prepare(scene, false).state.time.dt;
  };
  const double own = step("");
  CHECK(own > 0.005);
  CHECK(step("ground_motion { direction = 'x', wave = sine { amplitude = 1, frequency = 60 } }") == Approx(1.0 / 1200));
  CHECK(step("ground_motion { direction = 'x', wave = sine { amplitude = 1, frequency = 1 } }") == own);
  CHECK(step("ground_motion { direction = 'x', wave = sine { amplitude = 1, frequency = 1e6 } }") == Approx(own / 64));
  CHECK(step("ground_motion { direction = 'x', wave = sine { amplitude = 1, frequency = 60 } } analysis { dt_fraction = .45 }") ==
        Approx(1.0 / 2400));
  CHECK(step("ground_motion { direction = 'x', wave = table_wave { times = { 0, 1e-6, 1 }, values = { 0, 1, 1 } } }") == own);  // a leap
  // Points count by how often they turn back, not by how close they lie.
  const auto points = [&](int n, const std::string& value) {
    return step(
        fmt::format("local t, v = {{}}, {{}} for i = 0, {0} do t[i + 1], v[i + 1] = i / {0}, {1} end "
                    "ground_motion {{ direction = 'x', wave = table_wave {{ times = t, values = v }} }}",
                    n, value));
  };
  CHECK(points(20000, "(i / 20000) ^ 2") == own);
  CHECK(points(20000, "math.sin(40 * math.pi * i / 20000)") == Approx(0.05 / 20).epsilon(0.06));
  CHECK(points(20000, "math.sin(40 * math.pi * i / 20000) + 1e-5 * (i % 2)") == Approx(0.05 / 20).epsilon(0.06));
  CHECK(points(500, "math.sin(160 * math.pi * i / 500)") == Approx(1.0 / 500));  // no finer than they are given
}

TEST_CASE("a bar on a pin swings to any angle with the default step", "[analysis]") {
  for (const double spin : {1.0, 3.35, 6.0}) {
    INFO(spin);
    const std::string scene = fmt::format(R"(
      material {{ name = "s", density = 2000 }}
      box {{ name = "top", size = {{ .2, .2, .2 }}, at = {{ -.1, -.1, 0 }}, fixed = true }}
      box {{ name = "p", size = {{ .2, .2, 1 }}, at = {{ -.1, -.1, -1 }}, initial = {{ spin = {{ 0, {0}, 0 }}, velocity = {{ -.5 * {0}, 0, 0 }} }} }}
      joint {{ law = mortar {{ kn = 1e10, ft = 1000 * MPa, c = 1000 * MPa, mu = .5 }}, rule = "midpoint", points = 1 }}
      analysis {{ duration = 1.5 }}
    )",
                                          spin);
    const test::Folder folder;
    const Metrics m = test::dynamic_run(scene, folder.file("run"), Existing::refuse);
    CHECK(m.diagnostics.energy_residual < 1e-5);  // it diverged past 40 degrees
  }
}
