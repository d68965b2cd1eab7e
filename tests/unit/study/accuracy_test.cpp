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
  Goal q{"x", "m", {}, 0, 0, ""};
  settle_reference(q, 0, all);
  CHECK(q.reference == Approx(1).epsilon(1e-4));
  CHECK(std::fabs(q.reference - 1) < q.uncertainty);
  Goal known{"x", "m", 1.5, 0, 0, ""};
  settle_reference(known, 0, all);
  CHECK(known.reference == 1.5);
  CHECK(known.uncertainty == 0);
  CHECK(*error_of(known, 1.2) == Approx(0.2));
  CHECK_FALSE(error_of(known, std::nullopt));
}

TEST_CASE("slopes are those of each knob's own error, whatever the others leave", "[study]") {
  const std::vector<Measured> all = measurements();
  Goal q{"x", "m", 1.0, 0, 0, ""};
  settle_reference(q, 0, all);
  const auto curves = curves_of(q, 0, all);
  REQUIRE(curves.size() == 2);
  for (const Curve& c : curves) {
    INFO(c.knob);
    REQUIRE(c.slope);
    CHECK(*c.slope == Approx(2).epsilon(0.02));
  }
}

TEST_CASE("the front holds what nothing beats; target and budget find their settings; the sentence names the limit", "[study]") {
  const std::vector<Measured> all = measurements();
  Goal q{"x", "m", 1.0, 0, 0, ""};
  settle_reference(q, 0, all);
  const auto front = pareto(q, 0, all, true);
  REQUIRE(front.size() >= 2);
  for (std::size_t i = 1; i < front.size(); ++i) {
    CHECK(all[front[i]].updates >= all[front[i - 1]].updates);
    CHECK(*error_of(q, all[front[i]].values[0]) < *error_of(q, all[front[i - 1]].values[0]));
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

TEST_CASE("what is run for comparison only is never advised, however well it does", "[study]") {
  std::vector<Measured> all = measurements();
  Goal q{"x", "m", 1.0, 0, 0, ""};
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
