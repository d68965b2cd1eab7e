// What does not stand under its own weight: it falls in the run, not before it.
#include <catch2/catch.hpp>

#include "engine/analysis/start/at_rest.h"
#include "engine/solve/step.h"
#include "lua/language/script.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

Prepared at_start(const std::string& text, const StartTold& told = {}) {
  lua::Script script(lua::Script::Options{.quiet = true});
  const Scene scene = script.load_text("material{ name = 'stone', density = 2400 } " + text, "start.lua", {});
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1, told);
  return run;
}

// A block of 5 m whose centroid lies beyond its foot, over a floor, and a pier with an eccentric cap.
Prepared toppling(const std::string& start, const StartTold& told = {}) {
  return at_start(
      "joint{ law = dry{ kn = 5e9, mu = .6 } }"
      "box{ name = 'floor', group = 'floor', size = { 20, 20, .5 }, at = { -10, -10, -.5 }, fixed = true }"
      "box{ name = 'foot', size = { 1, 1, .3 }, at = { 0, 0, 0 } }"
      "box{ name = 'tall', group = 'tall', size = { 1, 1, 5 }, at = { .6, 0, .3 } }"
      "joint{ between = { 'tall', 'floor' }, none = true }"
      "box{ name = 'pier', size = { 1, 1, 2 }, at = { -6, 0, 0 } } box{ name = 'cap', size = { 1, 1, .5 }, at = { -5.7, 0, 2 } }"
      "analysis{ duration = 1, start = '" +
          start + "' }",
      told);
}

std::size_t index_of(const Model& m, const std::string& name) {
  return std::size_t(std::ranges::find(m.block_name, name) - m.block_name.begin());
}
double tilt(const BlockPoses& pose, std::size_t b) { return Quat(pose.q[b]).angularDistance(Quat::Identity()); }

}  // namespace

TEST_CASE("a block that topples begins the run in its place, and nothing strikes then", "[analysis]") {
  for (const char* start : {"equilibrium", "ramp"}) {
    CAPTURE(start);
    Prepared run = toppling(start);
    const std::size_t tall = index_of(run.model, "tall");
    REQUIRE(run.fallers == std::vector<int>{int(tall)});
    CHECK(tilt(run.state.pose, tall) < 0.02);
    REQUIRE(run.fallen);
    CHECK(tilt(*run.fallen, tall) > 0.5);  // rad, there it lies on the floor
    const BlockVec3 before = run.state.pose.u;
    Solver solver(run.model, run.state, run.range, 1);
    solver.advance_until([&] { return run.state.time.t >= 0.01; });
    for (const char* name : {"foot", "pier", "cap"})  // which bear it, or stand elsewhere
      CHECK((run.state.pose.u[index_of(run.model, name)] - before[index_of(run.model, name)]).norm() < 2e-6);
    CHECK(run.state.motion.v[tall].norm() < 9.81 * 0.01);
    CHECK(run.state.energy.residual_relative < 1e-5);
  }
}

TEST_CASE("blocks of any size that topple begin the run in their place", "[analysis]") {
  for (const double height : {0.2, 1., 10.})
    for (const double kn : {1e8, 1e10, 1e12})
      for (const double over : {0.02, 0.1, 0.3}) {  // of its width, past the edge
        CAPTURE(height, kn, over);
        const double width = 0.2 * height;
        const Prepared run =
            at_start(fmt::format("ground{{ size = {0} }} box{{ name = 'foot', size = {{ {1}, {1}, {1} }}, at = {{ 0, 0, 0 }} }}"
                                 "box{{ name = 'tall', size = {{ {1}, {1}, {2} }}, at = {{ {3}, 0, {1} }} }}"
                                 "joint{{ law = dry{{ kn = {4}, mu = .6 }} }} analysis{{ duration = 1 }}",
                                 20 * height, width, height, width * (0.5 + over), kn));
        CHECK(run.fallen.has_value() == !run.fallers.empty());  // the largest is too slow, under the damping, to be seen to fall
        CHECK(run.state.pose.u[index_of(run.model, "tall")].norm() < 0.2 * width);
      }
}

TEST_CASE("what stands beside it comes to rest as without it", "[analysis]") {
  const Prepared ramped = toppling("ramp"), direct = toppling("equilibrium");  // there Newton's method finds it alone
  for (const char* name : {"pier", "cap"}) {
    const std::size_t b = index_of(ramped.model, name);
    CHECK((ramped.state.pose.u[b] - direct.state.pose.u[b]).norm() < 0.01 * direct.state.pose.u[b].norm());
  }
}

TEST_CASE("a chip that falls at once leaves the pier it was on under its whole weight", "[analysis]") {
  const auto pier = [](const std::string& chip) {
    return at_start(
        "ground{ size = 20 } for i = 0, 5 do box{ name = 'p' .. i, group = 'pier', size = { .5, .5, .5 }, at = { 0, 0, .5 * i } } end"
        " joint{ law = mortar{ kn = 5e9, ft = .1e6, c = .15e6, mu = .6 } } analysis{ duration = 1 } " +
        chip);
  };
  for (const char* thickness : {".005", ".02", ".1"}) {
    CAPTURE(thickness);
    const std::string size = thickness;
    Prepared with = pier("box{ name = 'chip', group = 'chip', size = { " + size + ", .3, " + size +
                         " }, at = { .5, .1, 2.2 } } joint{ between = { 'pier', 'chip' }, law = dry{ kn = 5e9, mu = .6 } }");
    const Prepared alone = pier("");
    const std::size_t top = index_of(alone.model, "p5");
    REQUIRE(with.fallers == std::vector<int>{int(index_of(with.model, "chip"))});
    const Vec3 start = with.state.pose.u[top], settled = alone.state.pose.u[top];
    CHECK((start - settled).norm() < 0.05 * settled.norm());
    Solver solver(with.model, with.state, with.range, 1);
    solver.advance_until([&] { return with.state.time.t >= 0.05; });
    CHECK((with.state.pose.u[top] - start).norm() < 0.05 * settled.norm());
  }
}

TEST_CASE("a thin chip begins the run beside what it falls from, however soft that is", "[analysis]") {
  for (const double kn : {1e8, 1e9, 1e11})
    for (const double thickness : {.002, .02}) {
      CAPTURE(kn, thickness);
      const Prepared run = at_start(
          fmt::format("ground{{ size = 20 }} for i = 0, 19 do box{{ name = 'c' .. i, size = {{.5, .5, .25}}, at = {{0, 0, .25 * i}} }} end "
                      "box{{ name = 'chip', size = {{{0}, .1, .1}}, at = {{.5, .1, 4.85}} }} "
                      "joint{{ law = dry{{ kn = {1}, mu = .7 }} }} analysis{{ duration = 1 }}",
                      thickness, kn));
      REQUIRE(run.fallen);
      const Vec3 chip = run.state.pose.u[index_of(run.model, "chip")], beside = run.state.pose.u[index_of(run.model, "c19")];
      CHECK((chip - beside).norm() < .02 * thickness);
    }
}

TEST_CASE("a stack that leans until a wall bears it begins the run in its place and has not fallen", "[analysis]") {
  const Prepared run = at_start(
      "ground{ size = 20 } for i = 0, 2 do box{ name = 't' .. i, group = 't', size = {.3, .3, .3}, at = {.12 * i, 0, .3 * i} } end "
      "box{ name = 'wall', group = 'w', size = {.5, 1, 1}, at = {.6, -.3, 0}, fixed = true } joint{ between = {'t', 'w'}, none = true } "
      "joint{ law = dry{ kn = 1e9, mu = .6 } } analysis{ duration = 1 }");
  REQUIRE(run.fallen);
  CHECK(run.fallers.empty());
  CHECK(run.state.pose.u[index_of(run.model, "t2")].norm() < .01);
  CHECK((*run.fallen).u[index_of(run.model, "t2")].norm() > .03);
  CHECK(std::ranges::any_of(run.warnings,
                            [](const std::string& w) { return w.starts_with("slides or leans under its own weight until it rests: t"); }));
}

TEST_CASE("what settles with its support stands, however thin it is; what has slid to where it rests does not", "[analysis]") {
  const auto slabs = [](const std::string& more) {
    return at_start(
        "ground{ size = 20 } for i = 0, 7 do box{ name = 'slab' .. i, size = { .5, .5, .02 }, at = { 0, 0, .02 * i } } end "
        "box{ name = 'top', size = { .5, .5, .5 }, at = { 0, 0, .16 } } joint{ law = dry{ kn = 1e7, mu = .6 } } "
        "analysis{ duration = 1, start = 'ramp' } " +
        more);
  };
  const Prepared stack = slabs("");
  const double settled = -stack.state.pose.u[index_of(stack.model, "slab7")].z();
  CHECK(settled > 0.01);  // more than half of its thickness
  CHECK(stack.fallers.empty());
  const Prepared pushed = slabs("force{ block = 'slab7', wave = 8000, direction = 'x' }");
  CHECK(pushed.fallers.size() == 1);  // it has gone from between the others, and the top comes down with it
  CHECK(std::ranges::any_of(pushed.warnings, [](const std::string& w) { return w.starts_with("slides or leans under its own weight"); }));
}

TEST_CASE("the start tells how it comes on, and who hears it may end it", "[analysis]") {
  std::vector<std::string> lines;
  toppling("ramp", [&](const std::string& line) { lines.push_back(line); });
  REQUIRE_FALSE(lines.empty());
  CHECK_THAT(lines.front(), Catch::Contains("before the run, gravity comes slowly: 0.00 of at most "));
  CHECK_THROWS_WITH(toppling("ramp", [](const std::string&) { throw Error("enough"); }), "enough");
}
