#include "engine/study/study.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace erbs;
using namespace erbs::study;

namespace {

std::optional<double> metric(const StudyResult& result, const std::string& name) {
  for (const auto& [known, value] : result.metrics)
    if (known == name) return value;
  FAIL("no metric " + name);
  return std::nullopt;
}

RunAll answers(std::function<std::optional<double>(double)> of) {
  return [of](const std::vector<double>& xs) {
    std::vector<Answer> out;
    for (const double x : xs) {
      const auto value = of(x);
      out.push_back({x, value, value ? "" : "crashed"});
    }
    return out;
  };
}

Study threshold(double lo, double hi) {
  Study s;
  s.name = "fall";
  s.lo = lo, s.hi = hi, s.rel = 1e-4;
  return s;
}

}  // namespace

TEST_CASE("bisection brackets a threshold, whichever end is the larger", "[study]") {
  const StudyResult up = carry_out(threshold(0, 10), answers([](double x) { return x > 2.7182; }));
  CHECK(up.trouble.empty());
  CHECK(metric(up, "fall") == Approx(2.7182).epsilon(1e-4));
  CHECK(*metric(up, "fall_lo") <= 2.7182);
  CHECK(*metric(up, "fall_hi") >= 2.7182);
  CHECK(*metric(up, "fall_hi") - *metric(up, "fall_lo") <= 1e-4 * *metric(up, "fall_hi"));
  CHECK(metric(up, "fall_failed") == 0.0);
  const StudyResult down = carry_out(threshold(1, 0.1), answers([](double x) { return x < 0.37; }));
  CHECK(metric(down, "fall") == Approx(0.37).epsilon(1e-4));
}

TEST_CASE("bisection ends where the threshold is zero, at an end or between, and where doubles do", "[study]") {
  int runs = 0;
  const auto moves = answers([&](double x) {
    REQUIRE(++runs < 500);
    return x > 0;
  });
  const StudyResult end = carry_out(threshold(0, 1), moves);
  CHECK(end.trouble.empty());
  CHECK(*metric(end, "fall_lo") == 0);
  CHECK(*metric(end, "fall_hi") <= 1e-4 * 1e-3);  // rel of a thousandth of the range
  CHECK(runs < 50);
  runs = 0;
  const StudyResult between = carry_out(threshold(-1, 2), moves);
  CHECK(between.trouble.empty());
  CHECK(std::fabs(*metric(between, "fall")) <= 3e-7);
  CHECK(runs < 60);
  runs = 0;
  Study finest = threshold(-1, 1);
  finest.rel = 1e-12;
  for (const int points : {1, 3, 400}) {
    runs = 0, finest.points = points;
    const StudyResult found = carry_out(finest, points > 100 ? answers([](double x) { return x > 0; }) : moves);
    CHECK(found.trouble.empty());
    CHECK(std::fabs(*metric(found, "fall")) < 1e-11);
  }
}

TEST_CASE("bisection says where its ends are wrong, and goes on past runs that fail", "[study]") {
  CHECK_THAT(carry_out(threshold(4, 10), answers([](double x) { return x > 3; })).trouble,
             Catch::Contains("yes at lo = 4 already; lower it"));
  CHECK_THAT(carry_out(threshold(0, 2), answers([](double x) { return x > 3; })).trouble, Catch::Contains("no at hi = 2 still; raise it"));
  // lo may be the larger end: the way out of the bracket turns
  CHECK_THAT(carry_out(threshold(0.3, 0.1), answers([](double x) { return x < 0.37; })).trouble,
             Catch::Contains("yes at lo = 0.3 already; raise it"));
  CHECK_THAT(carry_out(threshold(1, 0.5), answers([](double x) { return x < 0.37; })).trouble,
             Catch::Contains("no at hi = 0.5 still; lower it"));
  CHECK_THAT(carry_out(threshold(0.1, 1), answers([](double x) { return x < 0.37; })).trouble, Catch::Contains("exchange them"));
  const StudyResult result = carry_out(threshold(0, 10), answers([](double x) -> std::optional<double> {
                                         if (x > 2 && x < 2.6) return std::nullopt;  // 2.5 is the first point inside
                                         return x > 3;
                                       }));
  CHECK(metric(result, "fall") == Approx(3).epsilon(1e-4));
  CHECK(*metric(result, "fall_failed") >= 1);
  const StudyResult dark = carry_out(threshold(0, 10), answers([](double x) -> std::optional<double> {
                                       if (x > 0 && x < 10) return std::nullopt;
                                       return x > 3;
                                     }));
  CHECK_FALSE(metric(dark, "fall"));
  CHECK_THAT(dark.trouble, Catch::Contains("gave an answer") && Catch::Contains("crashed"));
}

TEST_CASE("the order of an error is its slope, known or against the finest run", "[study]") {
  Study s;
  s.kind = Study::Kind::converge;
  s.name = "c";
  s.values = {0.8, 0.4, 0.2, 0.1};
  const StudyResult known = carry_out(s, answers([](double h) { return -3 * std::pow(h, 1.5); }));
  CHECK(metric(known, "c_slope") == Approx(1.5));
  CHECK(metric(known, "c_error") == Approx(3 * std::pow(0.1, 1.5)));
  s.finest = true;
  s.values = {0.8, 0.4, 0.2, 0.001};
  const StudyResult unknown = carry_out(s, answers([](double h) { return 7 + h * h; }));
  CHECK(metric(unknown, "c_slope") == Approx(2).epsilon(1e-4));
  CHECK(metric(unknown, "c_runs") == 4.0);
  const StudyResult failed = carry_out(s, answers([](double h) -> std::optional<double> {
                                         if (h > 0.3) return std::nullopt;
                                         return h;
                                       }));
  CHECK_FALSE(metric(failed, "c_slope"));
  CHECK(metric(failed, "c_failed") == 2.0);
}

TEST_CASE("an ensemble's seeds come again from its seed, and differ with it", "[study]") {
  CHECK(seeds(1, 5) == seeds(1, 5));
  std::vector<double> longer = seeds(1, 5);
  longer.resize(3);
  CHECK(seeds(1, 3) == longer);
  std::set<double> all;
  for (const double seed : {1.0, 2.0, 3.0, 1e9})
    for (const double x : seeds(seed, 100)) {
      CHECK((x == std::floor(x) && x >= 0 && x < 2147483648.0));
      all.insert(x);
    }
  CHECK(all.size() == 400);
  Study s;
  s.kind = Study::Kind::ensemble;
  s.name = "e";
  s.n = 400;
  const StudyResult even = carry_out(s, answers([](double x) -> std::optional<double> { return x / 2147483648.0; }));
  CHECK(metric(even, "e_mean") == Approx(0.5).margin(0.05));
  CHECK(metric(even, "e_deviation") == Approx(1 / std::sqrt(12.0)).margin(0.03));
  CHECK(metric(even, "e_failed") == 0.0);
}

TEST_CASE("every metric of a study is announced", "[study]") {
  for (const auto kind : {Study::Kind::bisect, Study::Kind::converge, Study::Kind::ensemble}) {
    Study s = threshold(0, 1);
    s.kind = kind;
    s.values = {1, 2};
    s.n = 3;
    std::vector<std::string> given;
    for (const auto& [name, value] : carry_out(s, answers([](double x) -> std::optional<double> { return x; })).metrics)
      given.push_back(name);
    CHECK(given == metric_names(s));
  }
}
