#include "engine/study/accuracy.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace erbs;
using namespace erbs::study;

namespace {

// value = 1 + a dt^2 + b / n^2, cost ~ n^2 / dt
Measured run(const std::string& knob, double size, double dt, double n) {
  Measured m;
  m.setting.knob = knob, m.setting.name = knob + " at " + std::to_string(size), m.setting.size = size;
  m.values = {1 + 0.1 * dt * dt + 0.02 / (n * n)};
  m.cpu = 1e-3 * n * n / dt, m.updates = 1e3 * n * n / dt;
  return m;
}

std::vector<Measured> measurements() {
  std::vector<Measured> all = {run("", 0, 0.9, 3)};
  for (const double dt : {0.9, 0.5, 0.25, 0.125}) all.push_back(run("time step", dt, dt, 3));
  for (const double n : {3.0, 5.0, 7.0}) all.push_back(run("points, simpson", 1 / n, 0.9, n));
  return all;
}

Goal goal(std::optional<double> expected) {
  Goal q;
  q.name = "x", q.unit = "m", q.expected = expected;
  return q;
}

// A scene with two knobs of its own, a bed and a rate: value = 2 - 0.2 (1e9 / bed)^(1/3) + 3 rate. Theory is 2 (1 + model).
Measured declared(const std::string& knob, double size, double bed, double rate) {
  Measured m;
  m.setting.knob = knob, m.setting.size = size, m.setting.declared = !knob.empty();
  m.setting.name = knob + " " + std::to_string(size);
  m.values = {2 - 0.2 * std::cbrt(1e9 / bed) + 3 * rate};
  m.updates = std::sqrt(bed) / rate, m.cpu = 1e-6 * m.updates;
  return m;
}

std::vector<Measured> two_knobs() {
  const std::vector<double> beds{1e9, 1e11, 1e13, 1e15}, rates{0.1, 0.01, 0.001, 0.0001};
  std::vector<Measured> all{declared("", 0, 1e11, 0.01)};
  for (const double bed : beds) all.push_back(declared("bed", beds.back() / bed, bed, rates.back()));
  for (const double rate : rates) all.push_back(declared("rate", rate / rates.back(), beds.back(), rate));
  for (std::size_t i = 0; i < beds.size(); ++i) {
    Measured m = declared(together_knob, double(beds.size() - i), beds[i], rates[i]);
    m.setting.parts = {all[1 + i].setting.name, all[5 + i].setting.name};
    all.push_back(m);
  }
  return all;
}

}  // namespace

TEST_CASE("Richardson's limit of a known order, and its uncertainty", "[study]") {
  const Limit limit = richardson({{0.1, 3 + 0.01 * 2}, {0.2, 3 + 0.04 * 2}, {0.4, 3 + 0.16 * 2}}, 1);
  CHECK(limit.value == Approx(3));
  CHECK(limit.order == Approx(2));
  CHECK(limit.uncertainty == Approx(0.02));
  CHECK(richardson({{0.1, 5}}, 2).value == 5);
  CHECK(richardson({{0.1, 5}, {0.2, 5}, {0.4, 5}}, 2).value == 5);  // constant values
}

TEST_CASE("the reference adds what is left of each knob, an expectation comes first", "[study]") {
  std::vector<Measured> all = measurements();
  Goal q = goal({});
  settle_reference(q, 0, all);
  CHECK(q.reference == Approx(1).epsilon(1e-4));
  CHECK(std::fabs(q.reference - 1) < q.uncertainty);
  Goal known = goal(1.5);
  settle_reference(known, 0, all);
  CHECK(known.reference == 1.5);
  CHECK(known.uncertainty == 0);
  CHECK(known.own_limit == Approx(q.reference));  // theory and the scene's own limit stand apart
  Measured m = all[0];
  m.values = {1.2};
  CHECK(*error_of(known, 0, m, all) == Approx(0.2));
  CHECK(*own_error_of(known, 0, m, all) == Approx(0.2 / 1.5).epsilon(1e-3));
  m.values = {std::nullopt};
  CHECK_FALSE(error_of(known, 0, m, all));
  CHECK_FALSE(own_error_of(known, 0, m, all));
}

TEST_CASE("slopes are those of each knob's own error, whatever the others leave", "[study]") {
  const std::vector<Measured> all = measurements();
  Goal q = goal(1.0);
  settle_reference(q, 0, all);
  const auto curves = curves_of(q, 0, all);
  REQUIRE(curves.size() == 2);
  for (const study::Curve& c : curves) {
    INFO(c.knob);
    REQUIRE(c.slope);
    CHECK(*c.slope == Approx(2).epsilon(0.02));
  }
}

TEST_CASE("the front holds what nothing beats; target and budget find their settings; the sentence names the limit", "[study]") {
  const std::vector<Measured> all = measurements();
  Goal q = goal(1.0);
  settle_reference(q, 0, all);
  const auto front = pareto(q, 0, all, true);
  REQUIRE(front.size() >= 2);
  for (std::size_t i = 1; i < front.size(); ++i) {
    CHECK(all[front[i]].updates >= all[front[i - 1]].updates);
    CHECK(*error_of(q, 0, all[front[i]], all) < *error_of(q, 0, all[front[i - 1]], all));
  }
  const auto found = cheapest(q, 0, all, 0.01);
  REQUIRE(found);
  CHECK(all[*found].setting.size == 0.25);
  CHECK_FALSE(cheapest(q, 0, all, 1e-6));
  CHECK(best_within(q, 0, all, 1e9) == front.back());
  CHECK_FALSE(best_within(q, 0, all, 1e-9));
  CHECK(what_limits(q, 0, all) ==
        "the points, not the step, are the error");  // the best run has the finest step: error 0.0016 from the step, 0.0022 from the points
  CHECK_THAT(plain_sentence(q, 0, all), Catch::Contains("x costs") && Catch::Contains("the error."));
}

TEST_CASE("a setting whose own error another one cancels is never advised for a target", "[study]") {
  std::vector<Measured> all = measurements();
  Goal q = goal(1.05);  // the scene itself errs by 5 %: its own limit is 1
  settle_reference(q, 0, all);
  Measured lucky = run("lucky", 1, 0.9, 3);
  lucky.values = {1.05}, lucky.updates = 1, lucky.cpu = 1e-6;
  all.push_back(lucky);
  REQUIRE(*error_of(q, 0, lucky, all) < 1e-9);
  CHECK_FALSE(cheapest(q, 0, all, 0.01));
  CHECK(cheapest(q, 0, all, 0.06));
}

TEST_CASE("what is run for comparison only is never advised, however well it does", "[study]") {
  std::vector<Measured> all = measurements();
  Goal q = goal(1.0);
  settle_reference(q, 0, all);
  const auto before = pareto(q, 0, all, true);
  Measured lucky = run("sequential, literal", 1, 0.01, 100);
  lucky.updates = 1, lucky.cpu = 1e-6;
  all.push_back(lucky);
  CHECK(pareto(q, 0, all, true) == std::vector<std::size_t>{all.size() - 1});
  all.back().setting.advised = false;
  CHECK(pareto(q, 0, all, true) == before);
  CHECK(cheapest(q, 0, all, 0.01) != all.size() - 1);
  CHECK(best_within(q, 0, all, 1e9) != all.size() - 1);
}

TEST_CASE("the knobs of a scene: their limits, their fronts, and which of them ends the fall", "[study]") {
  std::vector<Measured> all = two_knobs();
  Goal q = goal(2.0);
  settle_reference(q, 0, all);
  const auto curves = curves_of(q, 0, all);
  REQUIRE(curves.size() == 2);  // all knobs together have no size of their own
  CHECK(curves[0].knob == "bed");
  CHECK(*curves[0].slope == Approx(1.0 / 3).epsilon(0.02));
  CHECK(*curves[1].slope == Approx(1).epsilon(0.02));
  const auto front = pareto(q, 0, all, true);
  CHECK(*error_of(q, 0, all[front.front()], all) > 100 * *error_of(q, 0, all[front.back()], all) / 2);
  const auto ending = ending_of(q, 0, all);
  REQUIRE(ending);
  CHECK(ending->knob == "bed");                         // 0.2 (1e-6)^(1/3) / 2 = 0.1 % too little; the rate gives 0.015 % back
  CHECK(ending->error == Approx(0.001).epsilon(0.03));  // that they cancel in part is no merit
  CHECK(what_limits(q, 0, all) == "\"bed\", not step or points, is the error");
}

TEST_CASE("errors of two knobs that cancel are no accuracy", "[study]") {
  std::vector<Measured> all = two_knobs();
  Measured lucky = declared(together_knob, 9, 1e9, 0.2 / 3);  // -0.2 + 0.2
  lucky.setting.parts = {all[1].setting.name};
  all.push_back(lucky);
  Goal q = goal(2.0);
  settle_reference(q, 0, all);
  CHECK(*lucky.values[0] == Approx(2));
  CHECK(*error_of(q, 0, all.back(), all) == Approx(0.1).epsilon(0.02));
}

TEST_CASE("what no knob removes is the model's, apart from the distance to the own limit", "[study]") {
  std::vector<Measured> all = two_knobs();
  Goal q = goal(2.1);
  settle_reference(q, 0, all);
  const auto ending = ending_of(q, 0, all);
  REQUIRE(ending);
  CHECK(ending->knob.empty());
  CHECK(ending->error == Approx(0.1017 / 2.1).epsilon(1e-3));                     // 2.1 less 2 - 0.2 (1e-6)^(1/3) + 3e-4
  CHECK(*own_error_of(q, 0, all[8], all) == Approx(0.0003 / 2.1).epsilon(0.05));  // the finest rate
  Goal own = goal({});
  settle_reference(own, 0, all);
  CHECK(own.reference == Approx(2).epsilon(1e-4));
  CHECK(own.from == "Richardson in bed and rate");
}

TEST_CASE("a statistic errs by its standard error at least, and its finest run is the reference", "[study]") {
  std::vector<Measured> all;
  for (const double n : {20.0, 5.0, 20.0, 80.0, 320.0}) {
    Measured m = declared(all.empty() ? "" : "twins", all.empty() ? 0 : 320 / n, 1e9, 1);
    m.values = {1 + 0.02 / n}, m.scatter = 0.1 / std::sqrt(n), m.updates = n;
    all.push_back(m);
  }
  all.push_back(all[0]);
  all.back().setting.knob = "time step", all.back().setting.size = 0.5, all.back().values = {1.001};
  Goal q = goal({});
  q.scatters = true;
  settle_reference(q, 0, all);
  CHECK(q.reference == *all[4].values[0]);
  CHECK(q.uncertainty == Approx(0.1 / std::sqrt(320.0)));
  for (const std::size_t i : {0, 2, 5}) CHECK(*error_of(q, 0, all[i], all) == Approx(0.1 / std::sqrt(20.0)).epsilon(0.01));
  const auto curves = curves_of(q, 0, all);
  CHECK(curves[0].knob == "twins");
  CHECK(*curves[0].slope == Approx(0.5).epsilon(0.03));
  const auto ending = ending_of(q, 0, all);
  REQUIRE(ending);
  CHECK(ending->knob == "twins");
  CHECK(ending->error == Approx(0.1 / std::sqrt(320.0)).epsilon(0.01));
}

TEST_CASE("values of a knob go from coarse to fine, above zero", "[study]") {
  CHECK(mistake_in({1, 2}).empty());
  CHECK(mistake_in({2, 1, 0.5}).empty());
  for (const std::vector<double>& wrong :
       {std::vector<double>{}, {1}, {1, 1}, {1, 2, 2}, {1, 2, 1.5}, {1, 0}, {-1, 1}, {1, NAN}, {1, INFINITY}})
    CHECK_FALSE(mistake_in(wrong).empty());
  CHECK(Knob{"kn", "bed", {1e9, 1e10, 1e12}, "", {}}.size(1e9) == Approx(1000));
  CHECK(Knob{"rate", "rate", {0.1, 0.02}, "", {}}.size(0.1) == Approx(5));
}
