#include "engine/record/results/compare_runs.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/record/results/limits.h"

using namespace erbs;

namespace {

// A displacement that swings and dies away, `later` by so many s and `factor` times as large.
CsvTable histories(const std::string& name, double rate, double later, double factor) {
  CsvTable table;
  table.names = {"time_s", name};
  table.columns.resize(2), table.text.resize(2);
  for (double t = 0; t < 8; t += 1 / rate) {
    table.columns[0].push_back(t);
    table.columns[1].push_back(factor * std::exp(-std::pow(t - later - 3, 2)) * std::sin(9 * (t - later)));
  }
  return table;
}

ColumnErrors compared(const CsvTable& run, const CsvTable& reference, Alignment how) {
  const std::vector<ColumnPair> pairs = pair_columns(run, reference, {}, "reference");
  return errors_of(pairs.front(), find_shift(pairs, how, 2).lag, 2);
}

}  // namespace

TEST_CASE("a shifted measurement in mm has no errors once aligned", "[compare]") {
  for (const double rate : {50.0, 100.0, 240.0})
    for (const double lag : {0.137, -0.137}) {
      CAPTURE(rate, lag);
      const CsvTable run = histories("top_uy_rel_m", 100, lag, 0.01), measured = histories("top_uy_rel_mm", rate, 0, 10);
      CHECK(find_shift(pair_columns(run, measured, {}, "reference"), Alignment::correlation, 2).lag == Approx(lag).margin(0.5 / 100));
      const ColumnErrors e = compared(run, measured, Alignment::correlation);
      CHECK(std::abs(e.peak_error) < 0.02);  // a sample lies up to half a step beside the peak
      CHECK(std::abs(e.rms_error) < 0.01);
      CHECK(std::abs(e.frequency_error) < 0.01);
      CHECK(compared(run, measured, Alignment::none).difference > 0.1);
    }
}

TEST_CASE("a peak of another size is told apart", "[compare]") {
  const ColumnErrors e = compared(histories("u_m", 100, 0, 1.2), histories("u_m", 100, 0, 1), Alignment::none);
  CHECK(e.peak_error == Approx(0.2));
  CHECK(e.rms_error == Approx(0.2));
  CHECK(e.difference < 0.2);
  CHECK(e.correlation == Approx(1));
}

TEST_CASE("a reference without a time or a common column is refused", "[compare]") {
  const CsvTable run = histories("u_m", 100, 0, 1);
  CsvTable other = histories("v_m", 100, 0, 1);
  CHECK_THROWS_WITH(pair_columns(run, other, {}, "r.csv"), Catch::Contains("r.csv:1") && Catch::Contains("--columns"));
  CHECK(pair_columns(run, other, {"u_m=v_m"}, "r.csv").size() == 1);
  CHECK_THROWS_AS(pair_columns(run, other, {"u_m=w_m"}, "r.csv"), Error);
  CHECK_THROWS_AS(pair_columns(run, other, {"u_m"}, "r.csv"), Error);
  other.names[0] = "depth_m";
  CHECK_THROWS_WITH(pair_columns(run, other, {}, "r.csv"), Catch::Contains("no column time_s"));
  CsvTable back = histories("u_m", 100, 0, 1);
  back.columns[0][5] = 0;
  CHECK_THROWS_WITH(pair_columns(run, back, {}, "r.csv"), Catch::Contains("r.csv:7") && Catch::Contains("falls back"));
}

TEST_CASE("a ground motion in common passes no limit on the response", "[compare]") {
  RunComparison comparison;
  comparison.columns.push_back({.name = "ground_ay_m_s2", .peak_error = 0, .correlation = 1});
  const auto judged = [&](const char* limit) {
    return judge(limits_of(limit), [&](const std::string& quantity) { return values_of(comparison, quantity); });
  };
  for (const char* limit : {"peak<5%", "correlation>0.9"})
    CHECK_THROWS_WITH(judged(limit), Catch::Contains("only the motion of the ground in common") && Catch::Contains("--columns"));
  CHECK(judged("shift<1").front().passed);
  CHECK(table_of(comparison).find("only the motion of the ground is compared") != std::string::npos);
  comparison.columns.push_back({.name = "top_uy_rel_m", .peak_error = 0.01, .correlation = 1});
  CHECK(judged("peak<5%").front().passed);
}

TEST_CASE("collapse is compared by time, direction and sequence", "[compare]") {
  const auto fall = [](double time, double x, double y, std::vector<std::string> groups) {
    Json sequence = Json::array();
    for (const std::string& group : groups) sequence.push_back({{"group", group}});
    return Json{{"collapse", {{"collapsed", true}, {"time_s", time}, {"direction", {x, y}}, {"sequence", sequence}}}};
  };
  const Json a = fall(1.5, 1, 0, {"north", "south"}), b = fall(1.2, 0, 1, {"south", "north"});
  const CollapseErrors e = compare_collapse(a, b, 0.1);
  CHECK(e.time == Approx(0.2));
  CHECK(e.direction == Approx(90));
  CHECK_FALSE(e.same_sequence);
  CHECK(compare_collapse(a, a, 0).same_sequence);
  const Json stands{{"collapse", {{"collapsed", false}, {"time_s", nullptr}}}};
  CHECK(std::isinf(compare_collapse(a, stands, 0).time));
  CHECK(compare_collapse(stands, stands, 0).time == 0);
  CHECK_FALSE(compare_collapse(a, Json::object(), 0).known);
  const Json under{{"collapse", {{"collapsed", true}, {"time_s", nullptr}, {"direction", nullptr}}}};  // its weight
  RunComparison both;
  both.collapse = compare_collapse(under, under, 0);
  CHECK_THAT(table_of(both), Catch::Contains("run falls, reference falls\n"));
}

TEST_CASE("params that differ are listed with both values, and those that one run has alone", "[compare]") {
  const auto param = [](const char* name, double value) { return Param{name, value, 1, "", "m", {}}; };
  const std::vector<Param> a{param("height", 2), param("width", 1), param("old", 3)},
      b{param("new", 4), param("width", 1), param("height", 2.5)};
  RunComparison comparison;
  comparison.scenes = SceneDifferences{false, compare_params(a, b)};
  REQUIRE(comparison.scenes->params.size() == 3);
  const std::string text = table_of(comparison);
  CHECK_THAT(text, Catch::Contains("params      height: run 2 m, reference 2.5 m\n            old: run 3 m, reference none\n"
                                   "            new: run none, reference 4 m\n"));
  const Json json = json_of(comparison);
  CHECK(json["same_script"] == true);
  CHECK(json["params"]["height"] == Json{{"run", 2.0}, {"reference", 2.5}, {"unit", "m"}});
  CHECK(json["params"]["old"]["reference"].is_null());
  comparison.scenes = SceneDifferences{true, compare_params(a, a)};
  CHECK_THAT(table_of(comparison), Catch::Contains("the two scripts differ") && Catch::Contains("params      the same"));
  comparison.scenes = SceneDifferences{false, {}, {"param kind = \"dry\""}, {}};  // a param that is a word
  CHECK_THAT(table_of(comparison), Catch::Contains("run         param kind = \"dry\"\n") && !Catch::Contains("the same"));
  CHECK(json_of(comparison)["notes"]["run"] == Json{"param kind = \"dry\""});
}

TEST_CASE("limits are read whole or refused", "[compare]") {
  const std::vector<Limit> limits = limits_of("peak<5%, correlation>0.9");
  REQUIRE(limits.size() == 2);
  CHECK(limits[0].bound == Approx(0.05));
  const auto values = [](const std::string& quantity) {
    return quantity == "peak" ? std::vector<double>{0.01, -0.06} : std::vector<double>{0.95, 0.99};
  };
  const std::vector<Judged> judged = judge(limits, values);
  CHECK_FALSE(judged[0].passed);
  CHECK(judged[0].worst == Approx(0.06));
  CHECK(judged[1].passed);
  CHECK(judged[1].worst == Approx(0.95));
  CHECK_FALSE(judge(limits_of("rms<1"), [](const auto&) { return std::vector<double>{NAN}; })[0].passed);
  for (const char* bad : {"", "peak", "peak<", "peak<x", "peak<5%,", "peek<5%", "<5", "peak<-1", "peak<nan", "peak=5"})
    CHECK_THROWS_WITH(limits_of(bad), Catch::Contains("--expect"));
  CHECK_THROWS_AS(judge(limits, [](const auto&) { return std::vector<double>{}; }), Error);
}
