// The three quality settings must rank as promised on the problems of the study. Costs are counted in evaluations of contact points, so
// they are independent of the machine. Errors are those of smooth quantities, which do not jump with the step at which a joint opens or
// slips.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "lua/reading/quality.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

struct Answer {
  double cost = 0, value = 0;  // contact points evaluated; the metric
};

// Runs a scene of the repository alone, without the runs of its own study.
Answer answer(Bench& bench, const std::string& scene, double dt_fraction, int side, const std::string& metric,
              std::vector<std::string> more) {
  std::vector<std::string> words{"run",
                                 test::in_source("/scenes/") + scene,
                                 "-o",
                                 bench.out(),
                                 "--force",
                                 "--no-figures",
                                 "--threads",
                                 "1",
                                 "--rule",
                                 "simpson",
                                 "--dt-fraction",
                                 fmt::format("{}", dt_fraction),
                                 "--points",
                                 std::to_string(side * side)};
  words.insert(words.end(), more.begin(), more.end());
  bench.erbs(words);  // the exit code includes expectations that a partial run does not meet
  INFO(scene << "\n" << bench.said);
  const Json metrics = read_json(bench.out() + "/metrics.json");
  REQUIRE(metrics["status"] == "completed");
  return {metrics["point_updates"].get<double>(), metric.empty() ? 0 : metrics["metrics"][metric].get<double>()};
}

Answer answer(Bench& bench, const std::string& scene, const Quality& q, const std::string& metric, const std::vector<std::string>& more) {
  return answer(bench, scene, q.dt_fraction, q.points, metric, more);
}

}  // namespace

TEST_CASE("draft costs less than standard and standard less than reference on every problem of the study", "[program]") {
  Bench bench;
  const std::pair<const char*, std::vector<std::string>> problems[] = {
      {"accuracy/p1_chain.lua", {}},
      {"accuracy/p2_cantilever.lua", {"--set", "duration=0.1"}},
      {"accuracy/p3_free_rocking.lua", {"--set", "duration=0.1"}},
      {"accuracy/p4_half_sine.lua", {"--set", "duration=0.1", "--study", "least"}},
      {"accuracy/p5_arch.lua", {"--set", "duration=0.05"}},
      {"accuracy/p6_newmark_slip.lua", {"--set", "duration=0.1"}},
      {"accuracy/p7_first_crack.lua", {"--set", "duration=0.01"}},
      {"accuracy/p8_collapse.lua", {"--set", "duration=0.05", "--study", "time", "-D", "noise=1e-5"}},  // laid well: it settles at once
      {"house_quality.lua", {"-D", "span=0.002"}},
  };
  for (const auto& [scene, more] : problems) {
    double cost[3];
    for (int i = 0; i < 3; ++i) cost[i] = answer(bench, scene, qualities[i], "", more).cost;
    INFO(scene);
    CHECK(cost[0] > 0);
    CHECK(cost[0] < cost[1]);
    CHECK(cost[1] < cost[2]);
  }
}

// The step's error falls by (0.9 / 0.25)^2 = 13. The reference is the number on paper, unless joint stiffness and block size dominate its
// error. Then it is the limit of finer steps, of second order: q(h / 2) + (q(h / 2) - q(h)) / 3. Simpson's points are exact in bending.
TEST_CASE("reference is ten times as accurate as standard on the smooth quantities of the study", "[program]") {
  Bench bench;
  struct Problem {
    const char *scene, *metric;
    double exact;  // 0: the limit of fine steps
    std::vector<std::string> more;
  };
  const double chain = pi / std::sqrt(1e9 / 180) / std::sin(3.5 * pi / 17);  // P1: 2 pi / w_4 of eight masses fixed at one end
  const Problem problems[] = {{"accuracy/p1_chain.lua", "period", chain, {}},
                              {"accuracy/p2_cantilever.lua", "frequency", 0, {}},
                              {"house_quality.lua", "sway_rms", 0, {"-D", "span=0.05"}}};
  for (const Problem& p : problems) {
    double exact = p.exact;
    if (exact == 0) {
      const double coarse = answer(bench, p.scene, 1.0 / 8, 3, p.metric, p.more).value;
      const double fine = answer(bench, p.scene, 1.0 / 16, 3, p.metric, p.more).value;
      exact = fine + (fine - coarse) / 3;
    }
    double error[3];
    for (int i = 0; i < 3; ++i) error[i] = std::fabs(answer(bench, p.scene, qualities[i], p.metric, p.more).value / exact - 1);
    INFO(p.scene << ": draft " << error[0] << ", standard " << error[1] << ", reference " << error[2]);
    CHECK(error[1] < 1.01 * error[0]);
    CHECK(error[2] < 0.1 * error[1]);
  }
}
