// Metric functions are called after the run with a table of its results; expectations are checked against metrics.json.
#include <catch2/catch.hpp>
#include <cmath>

#include "lua/reports/expectations.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

RunResults results() {
  RunResults run;
  run.metrics = Json::parse(
      R"({ "status": "completed", "time_s": 4, "energy": { "residual_relative": 2e-5 }, "collapse": { "collapsed": false, "time_s": null } })");
  run.histories.names = {"time_s", "top_ux_rel_m"};
  run.histories.columns.resize(2);
  run.histories.text.resize(2);
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.01 * i;
    run.histories.columns[0].push_back(t);
    run.histories.columns[1].push_back(0.02 * std::sin(2 * 3.14159265358979 * 2.5 * t));
  }
  run.events.names = {"time_s", "event", "name", "value", "unit"};
  run.events.columns = {{1.5, 2.0}, {NAN, NAN}, {NAN, NAN}, {0.5, 0.1}, {NAN, NAN}};
  run.events.text = {{}, {"fall", "crack"}, {"b", "a | b"}, {}, {"m", "share"}};
  return run;
}

std::vector<MetricValue> evaluate(const std::string& piece) {
  Script script(quiet());
  script.load_text(sound + "\n" + piece, "scene.lua");
  return script.evaluate_metrics(results());
}

double value_of(const std::string& expression) {
  const auto values = evaluate("metric('x', '', function(run) return " + expression + " end)");
  INFO(values.at(0).error);
  REQUIRE(values.at(0).value);
  return *values[0].value;
}

}  // namespace

TEST_CASE("run offers histories, metrics, events and their numbers", "[lua]") {
  CHECK(value_of("run.peak('top_ux_rel_m')") == Approx(0.02));
  // Straight lines with 40 rows per period lose (pi/40)^2/3 of the rms.
  CHECK(value_of("run.rms('top_ux_rel_m')") == Approx(0.02 / std::sqrt(2)).epsilon(3e-3));
  CHECK(value_of("run.frequency('top_ux_rel_m')") == Approx(2.5).epsilon(2e-3));
  CHECK(value_of("run.at('top_ux_rel_m', 99) == nil and run.at('top_ux_rel_m', -1) == nil and 1 or 0") == 1);
  CHECK(value_of("run.at('top_ux_rel_m', 0.1)") == Approx(0.02));
  CHECK(value_of("#run.history('top_ux_rel_m') + #run.time") == 802);
  CHECK(value_of("run.last('time_s')") == Approx(4));
  CHECK(value_of("run.energy.residual_relative + run.metrics.time_s") == Approx(4 + 2e-5));
  CHECK(value_of("run.first_crack.time") == 2.0);
  CHECK(value_of("#run.events") == 2);
  CHECK(value_of("run.collapse.collapsed and 1 or 0") == 0);
}

TEST_CASE("a metric that fails says where, and the others are still there", "[lua]") {
  const auto values = evaluate(
      "metric('a', 'm', 3)\nmetric('b', 'm', function(run)\n return run.peak('topp_ux_rel_m') end)\n"
      "metric('c', '', function(run) return nil end)\nmetric('d', '', function(run) return run.nope.x end)");
  REQUIRE(values.size() == 4);
  CHECK(*values[0].value == 3);
  CHECK(values[1].error == "scene.lua:8: histories.csv has no column \"topp_ux_rel_m\"; did you mean \"top_ux_rel_m\"?");
  CHECK_FALSE(values[2].value);
  CHECK(values[2].error.empty());
  CHECK(contains(values[3].error, "scene.lua:10:"));
}

TEST_CASE("a metric that is no finite number has no value and a warning, and is no failure", "[lua]") {
  const auto values = evaluate(
      "metric('a', 'm', function() return 0/0 end)\nmetric('b', 'm', function() return -1/0 end)\n"
      "metric('c', '', function() return 1 end)");
  REQUIRE(values.size() == 3);
  CHECK_FALSE(values[0].value);
  CHECK(values[0].warning == "scene.lua:6: metric \"a\" is no finite number (0/0?) and has no value; return nil where there is none");
  CHECK_FALSE(values[1].value);
  CHECK(contains(values[1].warning, "scene.lua:7: metric \"b\" is no finite number (a division by 0?)"));
  CHECK(values[2].warning.empty());
  for (const MetricValue& value : values) CHECK(value.error.empty());
}

TEST_CASE("a metric sees those above it, and without a value it is told where they are", "[lua]") {
  const auto values = evaluate(
      "metric('a', '', 2)\nmetric('b', '', function(run) return run.metrics.a end)\n"
      "metric('c', '', function(run) return 2 * run.metrics.a end)\nmetric('d', '', function(run) return run.metrics.nope end)\n"
      "metric('e', '', function(run) return run.metrics.a or 7 end)\nmetric('f', '', function(run) return run.metrics.metrics.a end)\n"
      "metric('g', '', function(run) return run.metrics.metrics.h end)\nmetric('h', '', 1)");
  REQUIRE(values.size() == 8);
  CHECK(values[1].warning ==
        "scene.lua:7: metric \"b\" gave nil and has no value; it asks for metric \"a\": run.metrics.metrics has those above this one that "
        "have a value");
  CHECK(*values[5].value == 2);
  CHECK(contains(values[6].warning, "it asks for metric \"h\""));
  CHECK(contains(values[2].error, "scene.lua:8: attempt to perform arithmetic"));
  CHECK(contains(values[2].error, "; it asks for metric \"a\": run"));
  CHECK((values[3].warning.empty() && values[4].warning.empty()));
  CHECK(*values[4].value == 7);
}

TEST_CASE("a metric reads the run and leaves the scene alone", "[lua]") {
  const auto values = evaluate(
      "metric('a', '', function(run) box{ size = {1, 1, 1}, at = {9, 9, 9}, free = true } return 1 end)\n"
      "metric('b', '', function(run) return sine{ amplitude = 2, frequency = 1 }(.25) end)\n"
      "metric('c', '', function(run) return rocking{ width = .2, height = 1, theta = .05, duration = 1 }.alpha end)");
  CHECK(contains(values[0].error, "box changes the scene, and its run is over"));
  CHECK(*values[1].value == Approx(2));
  CHECK(*values[2].value == Approx(std::atan(0.2)));
}

TEST_CASE("expectations pass and fail as they say", "[lua]") {
  const Scene scene = scene_of(
      "expect('time_s', 4.1, { rel = 0.03 })\nexpect('time_s', 4.1, { rel = 0.02 })\nexpect('time_s', 4.1, { abs = 0.11 "
      "})\nexpect('time_s', 4, { below = true })\n"
      "expect('energy.residual_relative', 1e-4, { below = true })\nexpect('time_s', 3, { above = true })\nexpect('time_s', nil, { between "
      "= {3.9, 4.0} })\n"
      "expect('status', 'completed')\nexpect('status', 'diverged')\nexpect('collapse.collapsed', false)\nexpect('collapse.time_s', "
      "'null')\nexpect('collapse.direction.5', 1, { rel = 1 })\n"
      "expect('collapse.time_s', 1, { rel = 1 })");
  const auto verdicts = judge(scene.expectations, results().metrics);
  std::vector<bool> passed;
  for (const Verdict& verdict : verdicts) passed.push_back(verdict.passed);
  CHECK(passed == std::vector<bool>{true, false, true, false, true, true, true, true, false, true, true, false, false});
  CHECK(verdicts.at(11).got == "no such key");
  CHECK(verdicts.at(12).got == "null");
  CHECK(expects_status(scene, "diverged"));
  const auto back = verdicts_of(Json::parse(to_json(verdicts).dump()));
  CHECK(back.at(1).tolerance == "rel 0.02");
  CHECK(back.at(1).error == "-0.024");
}
