// Studies requested by a scene: child processes of the program itself.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "engine/base/system/process.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "lua/reading/family.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

struct StudyRun : Bench {
  double metric(const std::string& name) const {
    const Json metrics = read_json(out() + "/metrics.json");
    const Json* value = find_key(metrics, "metrics." + name);
    REQUIRE(value);
    return value->is_number() ? value->get<double>() : std::nan("");
  }
};

const std::string slope = R"(
local slope = param("slope", 0.1, "of the plane [-]")
local b = math.atan(slope)
material { name = "stone", density = 2000 }
gravity { g * math.sin(b), 0, -g * math.cos(b) }
box { name = "plane", size = { 4, 1, 0.1 }, at = { -1, -0.5, -0.1 }, fixed = true }
box { name = "block", size = { 0.4, 0.4, 0.05 }, at = { 0, -0.2, 0 } }
joint { law = dry { kn = 1e9, mu = param("mu", 0.6) } }
recorder { name = "block", quantity = "displacement", block = "block", axis = "x" }
analysis { duration = 0.1 }
bisect { param = "slope", lo = 0.1, hi = 1, rel = 0.01,
  collapsed_when = function(run) return run.last("block_ux_rel_m") - run.first("block_ux_rel_m") > 1e-6 end }
)";

}  // namespace

TEST_CASE("a block slides where the slope is mu, found by bisection of the scene's own runs", "[lua][study]") {
  StudyRun bench;
  REQUIRE(bench.run(slope + "expect('metrics.collapse_slope', 0.35, { rel = 0.01 })", {"-D", "mu=0.35"}) == 0);
  CHECK(bench.metric("collapse_slope") == Approx(0.35).epsilon(0.01));
  const CsvTable table = read_csv(bench.out() + "/studies/collapse_slope.csv");
  CHECK(double(table.rows()) == bench.metric("collapse_slope_runs"));
  CHECK(table.column("slope")[0] == 0.1);
  CHECK(table.column("answer")[1] == 1);
}

TEST_CASE("functions of studies and metrics use the metrics above them", "[lua][study]") {
  StudyRun bench;
  REQUIRE(bench.run(R"(
    local seed = param("seed", 1)
    material { name = "stone", density = 2000 }
    box { name = "block", size = { 1, 1, 1 }, free = true }
    analysis { duration = 0.01, dt = 1e-3 }
    metric("falls", "", function(run) return run.time_s + seed end)
    metric("twice", "", function(run) return 2 * run.metrics.metrics.falls end)
    metric("spread", "", function(run) return run.metrics.metrics.ensemble_most - run.metrics.metrics.ensemble_least end)
    ensemble { n = 3, seed = 2, value = function(run) return run.metrics.metrics.falls end })",
                    {"-q", "--no-figures"}) == 0);
  CHECK(bench.metric("twice") == 2 * bench.metric("falls"));
  CHECK(bench.metric("ensemble_failed") == 0);
  CHECK(bench.metric("spread") > 0);
}

TEST_CASE("a finished run of a study is not run again, unless the scene has changed", "[lua][study]") {
  StudyRun bench;
  REQUIRE(bench.run(slope) == 0);
  const double found = bench.metric("collapse_slope");
  const std::string study = bench.out() + "/studies/collapse_slope/";
  const auto written = fs::last_write_time(study + "runs/000000_00/metrics.json");
  fs::resize_file(study + "runs.csv", fs::file_size(study + "runs.csv") - 1);  // as if killed while it noted the last run
  fs::remove(study + "results.csv");
  REQUIRE(bench.run(slope, {"--resume"}) == 0);
  CHECK(bench.metric("collapse_slope") == found);
  CHECK(fs::last_write_time(study + "runs/000000_00/metrics.json") == written);
  CHECK(double(read_csv(study + "runs.csv").rows()) == bench.metric("collapse_slope_runs"));
  REQUIRE(bench.run(slope, {"--resume", "-D", "mu=0.3"}) == 0);
  CHECK(bench.metric("collapse_slope") == Approx(0.3).epsilon(0.01));
}

TEST_CASE("a run of a study that fails is a row with its reason, and the others count", "[lua][study]") {
  StudyRun bench;
  const std::string scene = R"(
    local seed = param("seed", 1)
    local x = seed / 2^31
    material { name = "stone", density = 2000 }
    gravity(0)
    box { name = "foot", size = { .4, .4, .1 }, at = { 0, 0, -.1 }, fixed = true }
    box { name = "block", size = { .4, .4, .1 }, at = { 0, 0, 0 }, initial = { velocity = { 0, 0, x } } }
    joint { law = mortar { kn = 1e9, ks = 4e8, ft = 1e9, c = 1e9, mu = 0.6 } }
    if x > 0.8 then error("an unlucky seed") end
    local limit = math.sqrt(2000 * 0.1 / 1e9)
    analysis { duration = x > 0.6 and 2000 * limit or 10 * limit, dt = { x > 0.6 and 10 * limit or 0.1 * limit, unstable = true } }
    ensemble { n = 24, seed = 3, value = function(run) if x < 0.3 then return 0/0 end return x end }
  )";
  REQUIRE(bench.run(scene) == 0);
  const CsvTable table = read_csv(bench.out() + "/studies/ensemble.csv");
  REQUIRE(table.rows() == 24);
  const auto& reasons = table.text[2];
  int failed = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double x = table.column("seed")[i] / 2147483648.0;
    CAPTURE(x, reasons[i]);
    if (x > 0.8) CHECK_THAT(reasons[i], Catch::Contains("an unlucky seed"));
    else if (x > 0.6) CHECK_THAT(reasons[i], Catch::Contains("diverged"));
    else if (x < 0.3) CHECK_THAT(reasons[i], Catch::Contains("no finite number"));
    else CHECK(table.column("answer")[i] == x);
    failed += x > 0.6 || x < 0.3;
  }
  CHECK((failed > 3 && failed < 24));
  CHECK(bench.metric("ensemble_failed") == failed);
  const double mean = bench.metric("ensemble_mean"), deviation = bench.metric("ensemble_deviation");
  CHECK(bench.metric("ensemble_error") == Approx(deviation / std::sqrt(24.0 - failed)));
  REQUIRE(bench.run(scene, {"--force"}) == 0);
  CHECK(bench.metric("ensemble_mean") == mean);
  CHECK(bench.metric("ensemble_deviation") == deviation);
}

TEST_CASE("a function of a study that gives nil is named with its line and remedy", "[lua][study]") {
  StudyRun bench;
  const std::string scene =
      slope.substr(0, slope.find("bisect")) + "metric('way', 'm', function(run) return run.last('block_ux_rel_m') end)\n";
  const auto reason = [&](const std::string& study) {
    CHECK(bench.run(scene + study, {"--force"}) == 2);
    for (const auto& file : fs::directory_iterator(bench.out() + "/studies"))
      if (file.path().extension() == ".csv") return read_csv(file.path().string()).text[2].at(0);
    return std::string("no table");
  };
  CHECK_THAT(
      reason("bisect{ param = 'slope', lo = .1, hi = 1, collapsed_when = function(run) return run.metrics.way end }"),
      Catch::Contains("scene.lua:12: collapsed_when of bisect \"collapse_slope\" gave nil and has no value; return true or false; it "
                      "asks for metric \"way\""));
  CHECK(contains(bench.said, "no answer at an end: at 0.1: "));
  CHECK_THAT(reason("ensemble{ param = 'slope', name = 'few', n = 2, seed = 1, value = function(run) return nil end }"),
             Catch::Contains("value of ensemble \"few\" gave nil and has no value; return a number"));
  CHECK_THAT(reason("converge{ param = 'slope', values = { .2, .1 }, error = function(run) return run.metrics.way + 1 end }"),
             Catch::Contains("attempt to perform arithmetic") && Catch::Contains("asks for metric \"way\""));
}

TEST_CASE("studies of a scene give the same for any number of runs at once, and end runs that take too long", "[lua][study]") {
  StudyRun bench;
  const std::string scene = slope + R"(
    converge { param = "mu", values = { .4, .2, .1 }, error = function(run) return run.last("block_ux_rel_m") + .1 end }
    local seed = param("seed", 1)
    ensemble { n = 5, seed = 2, value = function(run) return run.time_s + seed end })";
  std::string first;
  for (const char* jobs : {"1", "2", "5"}) {
    REQUIRE(bench.run(scene, {"-j", jobs, "--force", "--no-figures"}) == 0);
    std::string all = read_json(bench.out() + "/metrics.json")["metrics"].dump();
    for (const char* name : {"collapse_slope", "converge_mu", "ensemble"}) {
      const CsvTable table = read_csv(bench.out() + "/studies/" + name + ".csv");
      for (std::size_t i = 0; i < table.rows(); ++i) {
        all += fmt::format(" {} {}", table.columns[0][i], table.column("answer")[i]);
        CHECK(fs::exists(bench.out() + "/studies/" + name + "/" + table.text[std::size_t(table.find("run"))][i] + "/metrics.json"));
      }
    }
    if (first.empty()) first = all;
    CHECK(all == first);
  }
  const std::string endless = R"(
    local long = param("long", 0)
    material { name = "stone", density = 2000 }
    box { name = "block", size = { .4, .4, .1 }, at = { 0, 0, 0 }, free = true }
    analysis { duration = long > 1 and 1e6 or .01, stop_after_collapse = 1e6 }
    converge { param = "long", values = { 1, 2 }, value = function(run) return run.time_s end })";
  REQUIRE(bench.run(endless, {"--max-wall", "1s", "--force", "--no-figures"}) == 2);
  CHECK(bench.metric("converge_long_failed") == 1);
  CHECK(bench.said.find("took longer than max_wall = 1 s") != std::string::npos);
}

TEST_CASE("an oscillator's error falls with the square of its step", "[lua][study]") {
  StudyRun bench;
  REQUIRE(bench.run(R"(
    local share = param("share", 0.2)
    gravity(0)
    material { name = "stone", density = 2000 }
    box { name = "foot", size = { .4, .4, .1 }, at = { 0, 0, -.1 }, fixed = true }
    local w, v0 = math.sqrt(1e8 / 200), 1e-3
    box { name = "block", size = { .4, .4, .1 }, at = { 0, 0, 0 }, initial = { velocity = { 0, 0, v0 } } }
    joint { law = mortar { kn = 1e8, ks = 4e7, ft = 1e9, c = 1e9, mu = .6 } }
    recorder { name = "block", quantity = "displacement", block = "block", axis = "z" }
    analysis { duration = 13 / w, dt = share / w, output_dt = 0.1 / w }
    converge { param = "share", values = { .2, .1, .05 }, slope = 1.9, error = function(run)
      local worst = 0
      for i, u in ipairs(run.history "block_uz_rel_m") do worst = math.max(worst, math.abs(u * w / v0 - math.sin(w * run.time[i]))) end
      return worst end })") == 0);
  CHECK(bench.metric("converge_share_slope") == Approx(2).epsilon(0.03));
  CHECK(bench.said.find("1 passed, 0 failed") != std::string::npos);
}

TEST_CASE("a run whose bisection finds no bracket does not end as if it had an answer", "[lua][study]") {
  StudyRun bench;
  CHECK(bench.run(slope, {"-D", "mu=2", "--no-figures"}) == 2);
  INFO(bench.said);
  CHECK(bench.said.find("the verdict is no at hi = 1 still; raise it") != std::string::npos);
  CHECK(bench.said.find("studies without an answer: 1") != std::string::npos);
  CHECK(std::isnan(bench.metric("collapse_slope")));
}

TEST_CASE("mistakes of a study name their place and remedy", "[lua][study]") {
  CHECK(mentions(mistakes_in("bisect { param = 'x', lo = 0, hi = 1 }"), "there is no param \"x\" yet"));
  CHECK(mentions(mistakes_in("param('x', 1) bisect { param = 'x', lo = 1, hi = 1 }"), "lo and hi are the same"));
  CHECK(mentions(mistakes_in("param('x', 1) converge { param = 'x', values = { 1, 2 } }"), "give one of error"));
  CHECK(mentions(mistakes_in("param('x', 1) converge { param = 'x', values = { 0, 2 }, value = function() end }"), "above zero"));
  CHECK(
      mentions(mistakes_in("param('x', 1) bisect { param = 'x', lo = 0, hi = 1 } bisect { param = 'x', lo = 0, hi = 1 }"), "given before"));
  CHECK(mentions(
      mistakes_in("param('x', 1) metric('e_mean', '', 1) ensemble { n = 2, seed = 1, param = 'x', name = 'e', value = function() end }"),
      "answers metric \"e_mean\", which is there already"));
  CHECK(mentions(mistakes_in("param('seed', 1) ensemble { n = 3, seed = 1 }"), "\"value\" is missing"));
  CHECK(mistakes_in("param('x', 1) bisect { param = 'x', lo = 0, hi = 1 } expect('metrics.collapse_x', 1, { rel = 1 })").empty());
}

TEST_CASE("a family is lists of values of params, taken alone and drawn together, the same again and again", "[lua][study]") {
  Script script(quiet());
  script.load_text(sound + "param('kn', 1) param('n', 2) family({ n = { 1, 3 }, kn = { 5, 6, 7 } }, { combinations = 2, seed = 9 })",
                   "scene.lua");
  const ParamFamily& family = script.family();
  REQUIRE(family.values.size() == 2);
  CHECK(family.values[0].first == "kn");  // in order of declaration
  CHECK(family.values[1].second == std::vector<double>{1, 3});
  CHECK(family.combinations == 2);
  CHECK(one_at_a_time(family).size() == 5);
  CHECK(one_at_a_time(family)[4] == Choice{{"n", 3}});
  CHECK(combination(family, 4) == combination(family, 4));
  std::set<Choice> drawn;
  for (int i = 0; i < 100; ++i) drawn.insert(combination(family, i));
  CHECK(drawn.size() == 6);
}

TEST_CASE("a family that names no param, or no numbers, is refused with place and remedy", "[lua][study]") {
  CHECK(mentions(mistakes_in("param('kn', 1) family { nk = { 1 } }"),
                 "scene.lua:6: family: there is no param \"nk\" yet; did you mean \"kn\"?"));
  CHECK(mentions(mistakes_in("param('kn', 1) family { kn = 3 }"), "kn must be a list of finite numbers, such as"));
  CHECK(mentions(mistakes_in("param('kn', 1) family { kn = {} }"), "kn must be a list of finite numbers"));
  CHECK(mentions(mistakes_in("param('kn', 1) family { kn = { 1, 0/0 } }"), "kn must be a list of finite numbers"));
  CHECK(mentions(mistakes_in("param('kn', 1) family { { 1, 2 } }"), "it takes the names of params"));
  CHECK(mentions(mistakes_in("param('kn', 1) family { kn = { 1, 2, 1 } }"), "scene.lua:6: family: kn has 1 twice"));
  CHECK(mentions(mistakes_in("family(3)"), "family takes a table of lists"));
  CHECK(mentions(mistakes_in("param('kn', 1) family { kn = { 1 } } family { kn = { 2 } }"), "one was given before, at scene.lua:6"));
  CHECK(mentions(mistakes_in("param('kn', 1) family({ kn = { 1 } }, { combination = 3 })"), "did you mean \"combinations\"?"));
}
