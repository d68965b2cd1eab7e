#include "engine/record/results/collapse.h"

#include <catch2/catch.hpp>

#include "engine/analysis/start/prepare.h"
#include "engine/record/results/course.h"
#include "lua/language/script.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

analysis::Prepared prepared(const std::string& text) {
  lua::Script script(lua::Script::Options{.quiet = true});
  return analysis::prepare(script.load_text(text, "supports.lua", {}), false);
}

std::size_t block_of(const Model& model, const std::string& name) {
  return std::size_t(std::ranges::find(model.block_name, name) - model.block_name.begin());
}

}  // namespace

TEST_CASE("a block has fallen below half its thinnest extent from where it started", "[record][collapse]") {
  auto t = test::two_bricks();
  t.state.pose.u[1].z() = -0.02;  // settlement before the start does not count
  Collapse c = watch_collapse(t.model, t.state.pose);
  t.state.pose.u[1].z() = -0.0699;
  CHECK_FALSE(update(c, t.model, t.state.pose, 1.0));
  CHECK(c.fallen_fraction == 0);
  t.state.pose.u[1].z() = -0.0701;
  std::vector<int> newly;
  CHECK(update(c, t.model, t.state.pose, 1.5, &newly));
  CHECK(newly == std::vector<int>{1});
  CHECK(c.fallen_fraction == Approx(0.25));  // 1 kg of the 4 kg of moving mass
  CHECK(c.time == 1.5);
  CHECK_FALSE(update(c, t.model, t.state.pose, 2.0, &newly));  // reported only once
  CHECK(newly.size() == 1);
  CHECK(c.time == 1.5);
}

TEST_CASE("what could rise by a fiftieth of its thinnest extent still moves, unless it has fallen", "[record][collapse]") {
  auto t = test::two_bricks();
  t.model.gravity = {0, 0, -9.81};
  t.state.motion.v.assign(4, Vec3::Zero());
  Collapse c = watch_collapse(t.model, t.state.pose);
  CHECK(moving_fraction(c, t.model, t.state) == 0);
  const double rises = std::sqrt(2 * 9.81 * 0.002);  // m/s: v^2 / 2 g = .02 of .1 m
  t.state.motion.v[2] = Vec3(0.6, 0, 0.8) * 0.999 * rises;
  CHECK(moving_fraction(c, t.model, t.state) == 0);
  t.state.motion.v[2] = Vec3(0.6, 0, -0.8) * 1.001 * rises;
  CHECK(moving_fraction(c, t.model, t.state) == Approx(0.75));  // 3 kg of the 4 kg of moving mass
  t.state.motion.v[0] = Vec3(9, 0, 0);                          // fixed
  CHECK(moving_fraction(c, t.model, t.state) == Approx(0.75));
  t.state.pose.u[2].z() = -0.051;
  CHECK(moving_fraction(c, t.model, t.state) == 0);
  t.state.pose.u[2].z() = 0;
  t.model.gravity.setZero();
  CHECK(moving_fraction(c, t.model, t.state) == 0);
}

TEST_CASE("a block falls along the gravity of its scene", "[record][collapse]") {
  auto t = test::two_bricks();
  t.model.gravity = {5, 0, 0};
  Collapse c = watch_collapse(t.model, t.state.pose);
  t.state.pose.u[1] = Vec3(0.0499, 0, -1);
  CHECK_FALSE(update(c, t.model, t.state.pose, 1.0));
  CHECK(c.fallen_fraction == 0);
  t.state.pose.u[1] = Vec3(0.0501, 0, 1);
  CHECK(update(c, t.model, t.state.pose, 1.5));
  t.model.gravity = {0, -3, -4};  // a slope: sliding down by 0.1 m lowers by 0.06 m
  c = watch_collapse(t.model, test::two_bricks().state.pose);
  t.state.pose.u[1] = Vec3(0, 0.1, 0);
  CHECK_FALSE(update(c, t.model, t.state.pose, 1.0));
  t.state.pose.u[1] = Vec3(0, -0.1, 0);
  CHECK(update(c, t.model, t.state.pose, 1.5));
}

TEST_CASE("the time of a collapse is said as far as it is known: between two looks at the poses", "[record][collapse]") {
  Analysis how;
  how.output_dt = 0.01, how.frame_dt = 0.04;
  CHECK(span_of_event(how, 3.3702) == "between 3.360 and 3.370 s");
  CHECK(span_of_event(how, 0.01) == "between 0.000 and 0.010 s");
  how.output_dt = 0.1, how.frame_dt = 0.04;
  CHECK(span_of_event(how, 0.5) == "between 0.480 and 0.500 s");
  CHECK(span_of_event(how, 0.521) == "between 0.500 and 0.521 s");
  how.output_dt = how.frame_dt = 1e-4;
  CHECK(span_of_event(how, 0.0204) == "between 0.02030 and 0.02040 s");
}

TEST_CASE("what is thrown at the structure has not fallen from it", "[record][collapse]") {
  auto t = test::two_bricks();
  t.state.topology.grounded = {1, 1, 0};
  auto thrown = std::make_shared<Initial>();
  thrown->velocity = Vec3(0, 10, 0);
  t.scene.blocks[1].started = t.scene.blocks[2].started = thrown;  // the first is a part of the structure that sways
  Collapse c = watch_collapse(t.model, t.state.pose);
  c.thrown = thrown_blocks(t.scene, t.model, t.state);
  CHECK(c.thrown == std::vector<std::uint8_t>{0, 0, 1});
  t.state.pose.u[2].z() = -1;
  CHECK_FALSE(update(c, t.model, t.state.pose, 1.0));
  CHECK(c.fallen_fraction == 0);
  CHECK_FALSE(collapse_direction(c, t.model, t.state.pose));
  t.state.pose.u[1].z() = -1;
  CHECK(update(c, t.model, t.state.pose, 2.0));
  CHECK(c.fallen_fraction == 1);  // of the mass of the structure
  t.state.topology.grounded = {1, 0, 0};
  CHECK(thrown_blocks(t.scene, t.model, t.state) == std::vector<std::uint8_t>{0, 0, 0});  // nothing stands that they could be thrown at
}

TEST_CASE("the share that makes a collapse is the scene's", "[record][collapse]") {
  auto t = test::two_bricks();
  t.model.analysis.collapse_fraction = 0.5;
  Collapse c = watch_collapse(t.model, t.state.pose);
  t.state.pose.u[1].z() = -1;
  CHECK_FALSE(update(c, t.model, t.state.pose, 1.0));
  t.state.pose.u[2].z() = -1;
  CHECK(update(c, t.model, t.state.pose, 2.0));
  CHECK(c.fallen_fraction == 1);
}

TEST_CASE("supports that are moved down have not fallen", "[record][collapse]") {
  auto t = test::two_bricks();
  t.model.kind[0] = Kind::driven;
  Collapse c = watch_collapse(t.model, t.state.pose);
  t.state.pose.u[0].z() = -1;
  CHECK_FALSE(update(c, t.model, t.state.pose, 1.0));
  CHECK(c.fallen_fraction == 0);
}

TEST_CASE("what rides on a support that is lowered has not fallen, with a joint or without", "[record][collapse]") {
  analysis::Prepared run = prepared(R"(
    material{ name = "s", density = 2000 } ground{ size = 20 }
    for i = 0, 1 do
      box{ name = "plate"..i, size = {1, 1, .1}, at = {2 * i, 0, 0} }
      motion{ block = "plate"..i, direction = "z", wave = curve_wave{ times = {0, 1}, values = {0, -.3}, hold = true } }
      for k = 0, 2 do box{ name = "b"..i..k, group = i == 0 and "joined" or "loose", size = {.3, .2, .1}, at = {2 * i, 0, .1 + .1 * k}, free = i == 1 } end
    end
    box{ name = "aside", size = {.3, .2, .1}, at = {5, 0, 0}, free = true }
    joint{ law = dry{ kn = 1e9, mu = .6 } }
    gravity(g) analysis{ duration = 1 }
  )");
  const auto block = [&](const std::string& name) { return block_of(run.model, name); };
  Collapse c = watch_collapse(run.model, run.state.pose);
  BlockPoses& pose = run.state.pose;
  for (const char* name : {"plate0", "plate1", "b00", "b01", "b02", "b10", "b11", "b12"}) pose.u[block(name)].z() = -.3;
  update(c, run.model, pose, 1.0);
  CHECK(c.fallen_fraction == 0);
  for (const char* name : {"b02", "b12"}) pose.u[block(name)].z() = -.36;
  std::vector<int> newly;
  CHECK(update(c, run.model, pose, 2.0, &newly));
  CHECK(newly == std::vector<int>{int(block("b02")), int(block("b12"))});
  // A support that is drawn away below its blocks bears them no more: their fall counts from where they stood.
  pose.u[block("plate0")].z() = pose.u[block("plate1")].z() = -1;
  newly.clear();
  update(c, run.model, pose, 2.5, &newly);
  CHECK(newly.size() == 4);
  CHECK(c.fallen_fraction == Approx(6. / 7));
  pose.u[block("aside")].z() = -.06;
  newly.clear();
  update(c, run.model, pose, 3.0, &newly);
  CHECK(newly == std::vector<int>{int(block("aside"))});
}

TEST_CASE("a support that sinks bears what stands on it, not what stands beside it, and nothing that has fallen", "[record][collapse]") {
  analysis::Prepared run = prepared(R"(
    material{ name = "s", density = 2000 }
    for i = 0, 1 do
      box{ name = "foot"..i, size = {.6, .6, .2}, at = {.6 * i, 0, -.2}, fixed = i == 1 or nil }
      box{ name = "a"..i, size = {.6, .6, .6}, at = {.6 * i, 0, 0} }
      box{ name = "top"..i, size = {.2, .2, .2}, at = {.2 + .6 * i, .2, .6}, free = true }
    end
    motion{ block = "foot0", direction = "z", wave = curve_wave{ times = {0, 1}, values = {0, -.25}, hold = true } }
    joint{ law = dry{ kn = 1e9, mu = .6 } }
    gravity(g) analysis{ duration = 1 }
  )");
  const auto block = [&](const std::string& name) { return block_of(run.model, name); };
  Collapse c = watch_collapse(run.model, run.state.pose);
  BlockPoses& pose = run.state.pose;
  for (const char* name : {"foot0", "a0", "top0"}) pose.u[block(name)].z() = -.25;
  update(c, run.model, pose, 1.0);
  CHECK(c.fallen_fraction == 0);
  pose.u[block("a1")].z() = -.35;
  std::vector<int> newly;
  update(c, run.model, pose, 2.0, &newly);
  CHECK(newly == std::vector<int>{int(block("a1"))});
  pose.u[block("top0")].z() = -.36;
  update(c, run.model, pose, 3.0, &newly);
  CHECK(c.fallen[block("top0")]);
  const double before = c.fallen_fraction;
  pose.u[block("foot0")].z() = -1;  // it sinks beside what has fallen from it
  update(c, run.model, pose, 4.0);
  CHECK(c.fallen_fraction >= before);
}

TEST_CASE("the direction is the unit mean, and none where blocks fall every way", "[record][collapse]") {
  auto t = test::two_bricks();
  Collapse c = watch_collapse(t.model, t.state.pose);
  CHECK_FALSE(collapse_direction(c, t.model, t.state.pose));
  t.state.pose.u[1] = Vec3(3, 1, -1);
  t.state.pose.u[2] = Vec3(0, 3, -1);
  update(c, t.model, t.state.pose, 1.0);
  const auto d = collapse_direction(c, t.model, t.state.pose);
  REQUIRE(d);
  CHECK((*d)[0] == Approx(0.6));
  CHECK((*d)[1] == Approx(0.8));
  t.state.pose.u[1] = Vec3(1, 0, -1);
  t.state.pose.u[2] = Vec3(-0.83, 0, -1);  // mean 0.085, mean length 0.915: 0.0929
  CHECK_FALSE(collapse_direction(c, t.model, t.state.pose));
  t.state.pose.u[2] = Vec3(-0.80, 0, -1);  // 0.1 / 0.9: 0.111
  CHECK(collapse_direction(c, t.model, t.state.pose));
  t.state.pose.u[1] = t.state.pose.u[2] = Vec3(1e-17, -1e-17, -1);  // straight down: round-off is no direction
  CHECK_FALSE(collapse_direction(c, t.model, t.state.pose));
}

TEST_CASE("the course of a collapse names groups in the order of their falls", "[record][collapse]") {
  auto t = test::two_bricks();
  Collapse c = watch_collapse(t.model, t.state.pose);
  CHECK(course_of(c, t.model, {"base", "east", "west"}, std::nullopt).text.empty());
  t.state.pose.u[2] = Vec3(2, 0, -1);
  update(c, t.model, t.state.pose, 1.0);
  t.state.pose.u[1] = Vec3(3, 0.1, -1);
  update(c, t.model, t.state.pose, 1.25);
  const Course course = course_of(c, t.model, {"base", "east", "west"}, collapse_direction(c, t.model, t.state.pose));
  REQUIRE(course.groups.size() == 2);
  CHECK(course.groups[0].group == "west");
  CHECK(course.groups[0].time == 1.0);
  CHECK(course.groups[1].time == 1.25);
  CHECK(course.groups[1].share == 1);
  CHECK(course.text.find("west (1.00 s), east (1.25 s); towards +x") != std::string::npos);
  const Course one = course_of(c, t.model, {"base", "east", "west"}, std::nullopt, 1);
  CHECK(one.text.find("west (1.00 s) and 1 more") != std::string::npos);
}
