#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "engine/base/random.h"
#include "engine/base/units.h"
#include "engine/record/format/csv.h"
#include "engine/study/fragility/falls.h"
#include "engine/study/fragility/fragility.h"
#include "tests/support/folder.h"

using namespace erbs;
using namespace erbs::study;

namespace {

double normal_of(Random& random) {
  const double u = 1 - random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * random.uniform());
}

// n cases with lognormal capacities over even levels up to `cap`: incremental, or each run with a case of its own.
std::vector<Interval> drawn(int n, int levels, double cap, double theta, double beta, bool incremental, Random& random) {
  std::vector<Interval> out;
  for (int i = 0; i < n; ++i) {
    double capacity = theta * std::exp(beta * normal_of(random));
    Interval one;
    for (int k = 1; k <= levels; ++k) {
      const double im = cap * k / levels;
      if (!incremental) {
        out.push_back(capacity <= im ? Interval{0, im} : Interval{im, infinite});
        capacity = theta * std::exp(beta * normal_of(random));
      } else if (capacity > im) {
        one.lo = im;
      } else {
        one.hi = im;
        break;
      }
    }
    if (incremental) out.push_back(one);
  }
  return out;
}

struct Coverage {
  double theta = 0, beta = 0, curve = 0, bias_theta = 0, bias_beta = 0;
  int fitted = 0;
};

Coverage coverage(int n, int levels, double cap, double theta, double beta, bool incremental, int draws) {
  Coverage out;
  for (int s = 0; s < draws; ++s) {
    Random random{std::uint64_t(7919 * s + 13)};
    const Fit fit = fit_fragility(drawn(n, levels, cap, theta, beta, incremental, random));
    if (fit.end != FitEnd::fitted) continue;
    ++out.fitted;
    const double im = 0.75 * theta, truth = normal_cdf(std::log(im / theta) / beta);
    out.theta += fit.theta_lo <= theta && theta <= fit.theta_hi;
    out.beta += fit.beta_lo <= beta && beta <= fit.beta_hi;
    out.curve += fit.band(im, -1) <= truth && truth <= fit.band(im, 1);
    out.bias_theta += std::log(fit.theta / theta), out.bias_beta += std::log(fit.beta / beta);
  }
  for (double* x : {&out.theta, &out.beta, &out.curve, &out.bias_theta, &out.bias_beta}) *x /= out.fitted;
  return out;
}

Fit fit_of(std::vector<std::pair<double, double>> intervals) {
  std::vector<Interval> data;
  for (const auto& [lo, hi] : intervals) data.push_back({lo, hi});
  return fit_fragility(data);
}

}  // namespace

TEST_CASE("maximum likelihood finds median and dispersion within its own bands", "[fragility]") {
  // 500 draws: a share of 95 % is met within 3 x 1 %. Capped at 1.2 theta for some: a third of the cases never collapses.
  for (const double theta : {0.3, 2.0})
    for (const double beta : {0.2, 0.5})
      for (const bool incremental : {true, false})
        for (const double cap : {2.5, 1.2}) {
          const Coverage c = coverage(incremental ? 100 : 30, 10, cap * theta, theta, beta, incremental, 500);
          INFO("theta " << theta << " beta " << beta << " incremental " << incremental << " cap " << cap << ": " << c.theta << " "
                        << c.beta);
          CHECK(c.fitted == 500);
          CHECK(c.theta == Approx(0.95).margin(0.03));
          CHECK(c.beta == Approx(0.95).margin(0.03));
          CHECK(c.curve == Approx(0.95).margin(0.03));
          CHECK(std::fabs(c.bias_theta) < 0.02);
          CHECK(std::fabs(c.bias_beta) < 0.04);
        }
}

TEST_CASE("bands of few cases are a little narrow, as the words say", "[fragility]") {
  const Coverage c = coverage(12, 12, 5, 2, 0.5, true, 2000);
  CHECK(c.theta > 0.89);
  CHECK(c.beta > 0.89);
  CHECK(c.theta < 0.95);
}

TEST_CASE("the fit of single runs is the binomial one of Baker", "[fragility]") {
  // Two levels, fractions 2/10 and 7/10: Phi(a + b ln im) meets both, so that a and b follow from the quantiles -.841621 and .524401.
  std::vector<Interval> data;
  for (int i = 0; i < 10; ++i) {
    data.push_back(i < 2 ? Interval{0, 1} : Interval{1, infinite});
    data.push_back(i < 7 ? Interval{0, 2} : Interval{2, infinite});
  }
  const Fit fit = fit_fragility(data);
  REQUIRE(fit.end == FitEnd::fitted);
  CHECK(fit.a == Approx(-0.8416212336).epsilon(1e-6));
  CHECK(fit.b * std::log(2.0) == Approx(0.5244005127 + 0.8416212336).epsilon(1e-6));
  CHECK(fit.log_likelihood == Approx(2 * std::log(0.2) + 8 * std::log(0.8) + 7 * std::log(0.7) + 3 * std::log(0.3)).epsilon(1e-9));
  // The observed information of a binomial probability: var z = p (1 - p) / (n phi(z)^2), at each level on its own.
  const double phi = std::exp(-0.5 * 0.8416212336 * 0.8416212336) / std::sqrt(2 * pi);
  CHECK(fit.var_a == Approx(0.2 * 0.8 / (10 * phi * phi)).epsilon(1e-6));
}

TEST_CASE("narrow brackets of capacities give the moments of their logarithms", "[fragility]") {
  double mean = 0, square = 0;
  std::vector<Interval> data;
  Random random{5};
  for (int i = 0; i < 60; ++i) {
    const double ln = 0.4 * normal_of(random) + 1;
    mean += ln / 60, square += ln * ln / 60;
    data.push_back({std::exp(ln - 1e-4), std::exp(ln + 1e-4)});
  }
  const Fit fit = fit_fragility(data);
  CHECK(std::log(fit.theta) == Approx(mean).epsilon(1e-6));
  CHECK(fit.beta == Approx(std::sqrt(square - mean * mean)).epsilon(1e-5));
  CHECK(std::log(fit.theta_hi / fit.theta) == Approx(1.95996 * fit.beta / std::sqrt(60)).epsilon(1e-4));
  CHECK(std::log(fit.beta_hi / fit.beta) == Approx(1.95996 / std::sqrt(120)).epsilon(1e-4));
}

TEST_CASE("limit cases are told and give no numbers that look like a fit", "[fragility]") {
  const auto check = [](const Fit& fit, FitEnd end, const std::string& said) {
    CHECK(fit.end == end);
    CHECK_THAT(words(fit, "m/s2"), Catch::Contains(said));
    for (const double x : {fit.theta, fit.beta, fit.theta_lo, fit.beta_lo, fit.beta_hi}) CHECK(!std::isnan(x));
  };
  check(fit_of({}), FitEnd::empty, "no run");
  check(fit_of({{1, infinite}, {3, infinite}}), FitEnd::none, "none of 2 collapses up to 3 m/s2: the median lies above");
  CHECK_THAT(words(fit_of({{1, infinite}, {3, infinite}}), "g", 0.1), Catch::Contains("up to 0.3 g:"));
  check(fit_of({{0, 2}, {0, 1}}), FitEnd::all, "from 1 m/s2 on: the median lies below");
  check(fit_of({{1, 2}, {1.2, infinite}, {0, 1.5}}), FitEnd::separated, "up to 1.2 m/s2 and all collapse from 1.5 m/s2");
  check(fit_of({{1, 2}, {1, 2}, {1, 2}}), FitEnd::separated, "too small to be seen");
  check(fit_of({{0, 2}, {2, infinite}}), FitEnd::level, "at 2 m/s2 alone");
  check(fit_of({{1, 2}, {2, 3}, {0, 3}}), FitEnd::level, "at 2 m/s2 alone");
  check(fit_of({{0, 1}, {0, 1}, {1, infinite}, {0, 2}, {2, infinite}, {2, infinite}}), FitEnd::falling, "do not grow");
  CHECK(words(fit_of({{0, 1}, {1, infinite}, {0, 2}, {0, 2}, {2, infinite}}), "").empty());
}

TEST_CASE("fractiles count a collapse as infinite, and a case only as far as it was run", "[fragility]") {
  CHECK(fractile({3, 1, 2}, 0.5) == 2);
  CHECK(fractile({1, 2}, 0.16) == Approx(1.16));
  CHECK(std::isinf(fractile({1, infinite}, 0.5)));
  CHECK(fractile({1, 2, infinite}, 0.5) == 2);
  Group group;
  group.cases = {{"a", {{1, false, {0.1}}, {2, false, {0.3}}}}, {"b", {{1, false, {0.2}}, {2, true, {9}}}}, {"c", {{2, false, {0.5}}}}};
  const auto all = fractiles_of(group, 0);
  REQUIRE(all.size() == 2);
  CHECK(all[0].cases == 3);
  CHECK(all[0].p50 == Approx(0.2));  // .1, .2 and half of .5
  CHECK(all[1].p50 == Approx(0.5));
  CHECK(std::isinf(all[1].p84));
  CHECK(group.cases[1].capacity().lo == 1);
  CHECK(group.cases[1].capacity().hi == 2);
  CHECK(std::isinf(group.cases[0].capacity().hi));
  // A structure that stands again at a higher intensity has the capacity of its first collapse.
  const Case again{"", {{1, false, {}}, {2, true, {}}, {3, false, {}}}};
  CHECK(again.capacity().hi == 2);
  CHECK(group.single_runs().size() == 5);
}

TEST_CASE("runs of one case at one intensity all count", "[fragility]") {
  // Sa of metrics.json may be the same for two scales: one run stands there, the other collapses.
  const Case twice{"", {{1, false, {0.1}}, {2, false, {0.2}}, {2, true, {0.9}}, {3, true, {}}}};
  CHECK(twice.capacity().lo == 1);
  CHECK(twice.capacity().hi == 2);
  const Case damaged{"", {{1, false, {0.1}}, {1, false, {0.3}}, {2, false, {0.5}}}};
  Group group;
  group.cases = {twice, damaged};
  CHECK(group.single_runs().size() == 7);
  const auto all = fractiles_of(group, 0);
  REQUIRE(all.size() == 3);
  CHECK(all[0].p50 == Approx(0.2));  // .1, and the worse of .1 and .3
  CHECK(std::isinf(all[1].p84));
}

TEST_CASE("the tables of a study depend on its rows, not on their order", "[fragility]") {
  Sweep sweep;
  sweep.plan.axes = {{{"motion"}, {{std::string("a")}, {std::string("b")}, {std::string("c")}}, 0, 0, false, {}},
                     {{"pga"}, {{1.0}, {2.0}, {3.0}}, 0, 0, false, {}}};
  sweep.plan.collect = {"collapse.collapsed", "metrics.drift"};
  sweep.plan.fragility = FragilityPlan{"pga", "collapse.collapsed", {}, {"metrics.drift"}, {}, "pga", {}};
  sweep.params = {"motion", "pga_m_s2"};
  sweep.collected = {"collapse.collapsed", "drift_m"};
  std::vector<std::string> rows;
  int index = 0;
  for (const auto& [motion, from] : {std::pair{"a", 2.0}, std::pair{"b", 3.0}, std::pair{"c", 4.0}})
    for (const double pga : {1.0, 2.0, 3.0})
      rows.push_back(csv_line({std::to_string(index++), motion, fmt::format("{}", pga), pga >= from ? "1" : "0",
                               fmt::format("{}", 0.1 * pga), "completed", "", "1", "1", "1", "here", "key"}));
  rows.push_back(csv_line({"9", "c", "2", "nan", "nan", "timeout", "slow", "1", "1", "1", "here", "key"}));
  rows.push_back(csv_line({"10", "c", "3", "0", "0.7", "completed", "", "1", "1", "1", "here", "key"}));  // a second run at one intensity
  rows.push_back(csv_line({"11", "c", "1", "word", "0.7", "completed", "", "1", "1", "1", "here", "key"}));
  const auto tables = [&](const std::vector<std::string>& lines) {
    const test::Folder folder;
    sweep.directory = folder.file("");
    sweep.directory.pop_back();
    std::ofstream(sweep.directory + "/runs.csv") << "head\n" << fmt::format("{}", fmt::join(lines, ""));
    const auto found = write_fragility(sweep, read_groups(sweep));
    REQUIRE(found.size() == 2);
    CHECK(found[0].method == "capacities");
    CHECK(found[0].fit.observations == 3);
    CHECK(found[0].fit.collapsed == 2);
    CHECK(found[1].fit.observations == 10);
    CHECK_THAT(found[0].words, Catch::Contains("1 run left out: no answer") && Catch::Contains("collapse.collapsed has no number there"));
    std::string all;
    for (const char* file : {"fragility.csv", "stripes.csv", "fractiles.csv"}) {
      std::ifstream in(sweep.directory + "/" + file);
      all += std::string(std::istreambuf_iterator<char>(in), {});
    }
    return all;
  };
  const std::string first = tables(rows);
  CHECK_THAT(first, Catch::Contains("theta_pga_m_s2") && Catch::Contains("collapse") && !Catch::Contains("nan"));
  std::reverse(rows.begin(), rows.end());
  CHECK(tables(rows) == first);
}

TEST_CASE("falls of a study: fractiles of the time, mean and concentration of the direction", "[fragility]") {
  const auto run = [](double im, double time, double degrees) {
    return Run{im, true, {}, time, {std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)}};
  };
  Group group;
  group.cases = {{"a", {run(1, 3, 30), run(2, 2, 0)}},
                 {"b", {run(1, 1, -30), run(2, 4, 180)}},
                 {"c", {run(1, 2, 60), Run{2, true, {}}}},  // no direction
                 {"d", {run(1, 4, -60), Run{2, false, {}}}}};
  const std::vector<Falls> falls = falls_of({group});
  REQUIRE(falls.size() == 2);
  CHECK(falls[0].runs == 4);
  CHECK(falls[0].times == std::vector<double>{1, 2, 3, 4});
  CHECK(falls[0].mean_direction() == Approx(0).margin(1e-12));
  CHECK(falls[0].concentration() == Approx((std::cos(pi / 6) + std::cos(pi / 3)) / 2));
  CHECK(quarters(falls[0]) == std::array<double, 4>{0.5, 0.25, 0, 0.25});
  CHECK(falls[1].runs == 4);
  CHECK(falls[1].collapsed == 3);  // one without a time
  CHECK(falls[1].times.size() == 2);
  CHECK(falls[1].concentration() == Approx(0).margin(1e-12));
  CHECK(std::isnan(Falls{}.mean_direction()));
  CHECK(std::isnan(Falls{}.concentration()));
}
