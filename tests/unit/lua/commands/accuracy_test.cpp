// The command erbs accuracy from the user's side.
#include <catch2/catch.hpp>

#include "engine/record/format/csv.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// A block oscillating on an elastic joint: its exact period is known, and its error is proportional to dt^2.
const std::string oscillator = R"(-- A block on a bed.
gravity(0)
material { name = "stone", density = 2000 }
box { name = "foot", size = { .4, .4, .1 }, at = { 0, 0, -.1 }, fixed = true }
local w, v0 = math.sqrt(1e8 / 200), 1e-3
box { name = "block", size = { .4, .4, .1 }, at = { 0, 0, 0 }, initial = { velocity = { 0, 0, v0 } } }
joint { law = mortar { kn = 1e8, ks = 4e7, ft = 1e9, c = 1e9, mu = .6 } }
recorder { name = "block", quantity = "displacement", block = "block", axis = "z" }
analysis { duration = 65 / w, output_dt = 1e-9, start = "rest" @ }
)";
const std::string period = "metric('period', 's', function(run) return run.period 'block_uz_rel_m' end)\n";
const std::string known = "expect('metrics.period', 2 * pi / w, { rel = 0.1 })\n";

std::string with(const std::string& analysis) {
  std::string text = oscillator;
  return text.replace(text.find('@'), 1, analysis);
}

}  // namespace

TEST_CASE("accuracy of a metric that fails, or of none, says so, and by what errors are measured", "[program]") {
  Bench bench;
  const std::string brief = four_bricks() +
                            "joint{ law = dry{ kn = 1e9, mu = .6 } }\nanalysis{ duration = .002 }\nlabel('quality_only', 'fixed_dt')\n"
                            "recorder{ name = 't', quantity = 'displacement', block = 'b3' }\n";
  CHECK(bench.erbs({"accuracy", bench.scene(brief + "metric('m', 'm', function(run) error('boom') end)"), "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "metrics.m: no run gave a value; the first that failed says: exit code 2: "));
  CHECK(contains(bench.said, "boom"));
  CHECK(bench.erbs({"accuracy", bench.scene(brief + "metric('m', 'm', function(run) return nil end)"), "-o", bench.out(), "--force"}) == 1);
  CHECK(contains(bench.said, "the metric returned none: look at its function"));
  CHECK(bench.erbs({"accuracy", bench.scene(brief + "metric('m', 'm', function(run) return run.last 't_uz_rel_m' end)"), "-o", bench.out(),
                    "--force"}) == 0);
  CHECK(contains(bench.said, "To measure by a known value write expect(\"metrics.m\", VALUE, { rel = 0.01 })."));
}

TEST_CASE("accuracy tells slopes, a target's setting and what it costs; its table is reproducible", "[program]") {
  Bench bench;
  const std::string scene = bench.scene(with("") + period + known);
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--target", "0.1%"}) == 0);
  INFO(bench.said);
  CHECK(
      contains(bench.said, "analysis { dt_fraction = 0.0625 }"));  // (w dt)^2 / 24 with w dt = 2 x the fraction: 0.125 still errs by 0.25 %
  CHECK(contains(bench.said, "metrics.period costs"));
  CHECK(contains(bench.said, "param(\"unit\", 1)  not applicable"));
  for (const char* name : {"accuracy.csv", "accuracy.svg", "accuracy.png"})
    CHECK(std::filesystem::file_size(bench.folder / "out" / name) > 1000);
  CHECK(std::distance(std::filesystem::directory_iterator(bench.out()), {}) == 4);  // these three, and the folder of the runs
  const CsvTable table = read_csv(bench.out() + "/accuracy.csv");
  int steps = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double value = table.column("value")[i], reference = table.column("reference")[i], error = table.column("error")[i];
    if (std::isfinite(error) && reference != 0) CHECK(error == std::fabs(value - reference) / std::fabs(reference));
    steps += table.text[0][i] == "time step" && table.text[2][i] == "metrics.period";
  }
  CHECK(steps == 6);
  const std::string words = "time step: the error falls with the power ";
  const size_t at = bench.said.find(words);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(bench.said.substr(at + words.size())) == Approx(2).margin(0.15));
  CHECK(bench.erbs({"accuracy", scene, "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "--resume"));
  CHECK(bench.erbs({"accuracy", scene, "-o", bench.out(), "--resume", "--target", "1e-9%"}) == 4);
  CHECK(contains(bench.said, "no setting reaches it"));
  CHECK_FALSE(contains(bench.said, "did not fit"));
}

TEST_CASE("runs of accuracy that do not fit into the time of all are told, and made later", "[program]") {
  Bench bench;
  const std::string scene = bench.scene(with("") + period + known);
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--within", "1ms"}) == 0);  // the first two have begun by then
  CHECK(contains(bench.said, "not run: the time limit of the study was reached"));
  CHECK(contains(bench.said, "--resume makes them"));
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--resume", "--within", "0"}) == 0);
  CHECK_FALSE(contains(bench.said, "not run"));
}

TEST_CASE("accuracy of a scene without a number says what to add", "[program]") {
  Bench bench;
  CHECK(bench.erbs({"accuracy", bench.scene(with("")), "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "add a metric"));
  CHECK(bench.erbs({"accuracy", bench.scene(with("") + period), "-o", bench.out(), "--target", "often"}) == 2);
}

TEST_CASE("a map of a scene tells what converged and where it goes on", "[program]") {
  Bench bench;
  CHECK(bench.erbs({"accuracy", bench.scene(with("")), "--map", "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "add one"));
  const std::string scene = bench.scene(with(", unstable = false") + period);
  REQUIRE(bench.erbs({"accuracy", scene, "--map", "--budget", "1s", "-o", bench.out()}) == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, "--resume --budget 60m continues"));
  CHECK(contains(bench.said, "; 0 contradict theory"));
  for (const char* name : {"map.csv", "map.svg", "map.png"}) CHECK(std::filesystem::file_size(bench.folder / "out" / name) > 1000);
  CHECK(bench.erbs({"accuracy", scene, "--map", "-o", bench.out()}) == 2);
  CHECK(bench.erbs({"accuracy", scene, "--map", "--resume", "--budget", "1s", "-o", bench.out()}) == 0);
  CHECK(contains(text_of(bench.folder / "out/map.csv"), "bounded so far"));
}

TEST_CASE("a window of a record, other stiffness and other damping from the command line", "[program]") {
  Bench bench;
  REQUIRE(bench.run(with("") + period, {"--force", "--no-figures", "--dt-fraction", "0.1", "--stiffness", "4", "--damping", "0",
                                        "--damping-form", "explicit", "--from", "1"}) == 0);
  const Json metrics = read_json(bench.out() + "/metrics.json");
  CHECK(metrics["metrics"]["period"].get<double>() == Approx(pi / std::sqrt(1e8 / 200)).epsilon(0.05));
  CHECK(contains(text_of(bench.folder / "out/log.txt"), "--stiffness 4"));
}
