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
const std::string period_metric = "metric('period', 's', function(run) return run.period 'block_uz_rel_m' end)\n";
const std::string known_period = "expect('metrics.period', 2 * pi / w, { rel = 0.1 })\n";

std::string with(const std::string& analysis) {
  std::string text = oscillator;
  return text.replace(text.find('@'), 1, analysis);
}

std::string text(const CsvTable& table, const char* column, std::size_t row) { return table.text[std::size_t(table.find(column))][row]; }

// The oscillator with its stiffness and the step as knobs of the scene: its period is measured against a bed that cannot yield, so that
// the error is 1 / sqrt(kn). label: no settings but those of the knobs and the qualities.
std::string with_knob(const std::string& knob) {
  std::string out =
      "local kn, stiff = param('kn', 1e8), param('trouble', 1)\nif stiff == 3 then error('no scene for this value') end\n" + with("");
  for (std::size_t at; (at = out.find("= 1e8,")) != std::string::npos;) out.replace(at, 6, "= kn,");
  for (std::size_t at; (at = out.find("(1e8 /")) != std::string::npos;) out.replace(at, 6, "(kn /");
  return out + period_metric + "expect('metrics.length', 1, { rel = 1 })\n" +
         "metric('length', '', function(run) return 1 + run.period 'block_uz_rel_m' end)\nlabel('quality_only', 'fixed_dt')\n" + knob +
         "\n";
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
  const std::string scene = bench.scene(with("") + period_metric + known_period);
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--target", "0.1%"}) == 0);
  INFO(bench.said);
  CHECK(
      contains(bench.said, "analysis { dt_fraction = 0.0625 }"));  // (w dt)^2 / 24 with w dt = 2 x the fraction: 0.125 still errs by 0.25 %
  CHECK(contains(bench.said, "metrics.period costs"));
  CHECK(contains(bench.said, "further knobs: the scene declares none; write accuracy{ param = ..., values = ... } or --knob"));
  for (const char* name : {"accuracy.csv", "accuracy.svg", "accuracy.png"})
    CHECK(std::filesystem::file_size(bench.folder / "out" / name) > 1000);
  CHECK(std::distance(std::filesystem::directory_iterator(bench.out()), {}) == 5);  // these three, results.csv and runs.csv
  const CsvTable table = read_csv(bench.out() + "/accuracy.csv");
  int steps = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double value = table.column("value")[i], reference = table.column("reference")[i], error = table.column("error")[i];
    if (std::isfinite(error) && reference != 0) CHECK(error == std::fabs(value - reference) / std::fabs(reference));
    steps += text(table, "knob", i) == "time step" && text(table, "quantity", i) == "metrics.period";
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
  const std::string scene = bench.scene(with("") + period_metric + known_period);
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
  CHECK(bench.erbs({"accuracy", bench.scene(with("") + period_metric), "-o", bench.out(), "--target", "often"}) == 2);
}

TEST_CASE("a map of a scene tells what converged and where it goes on", "[program]") {
  Bench bench;
  CHECK(bench.erbs({"accuracy", bench.scene(with("")), "--map", "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "add one"));
  const std::string scene = bench.scene(with(", unstable = false") + period_metric);
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
  REQUIRE(bench.run(with("") + period_metric, {"--force", "--no-figures", "--dt-fraction", "0.1", "--stiffness", "4", "--damping", "0",
                                               "--damping-form", "explicit", "--from", "1"}) == 0);
  const Json metrics = read_json(bench.out() + "/metrics.json");
  CHECK(metrics["metrics"]["period"].get<double>() == Approx(pi / std::sqrt(1e8 / 200)).epsilon(0.05));
  CHECK(contains(text_of(bench.folder / "out/log.txt"), "--stiffness 4"));
}

TEST_CASE("accuracy varies the knobs that a scene declares, and says how far the error falls and what ends it", "[program]") {
  Bench bench;
  const std::string scene = bench.scene(with_knob("accuracy{ param = 'kn', name = 'stiffness', values = { 1e6, 1e8, 1e10, 1e12 } }"));
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--quantity", "length"}) == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, "below "));
  CHECK(contains(bench.said, "\"stiffness\", not step or points, is the error"));
  const std::string words = "stiffness: the error falls with the power ";
  const size_t at = bench.said.find(words);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(bench.said.substr(at + words.size())) == Approx(0.5).margin(0.02));
  const CsvTable table = read_csv(bench.out() + "/accuracy.csv");
  int rows = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (text(table, "knob", i) != "stiffness" || text(table, "quantity", i) != "metrics.length") continue;
    ++rows;
    CHECK(table.column("cpu_s")[i] > 0);
    CHECK(table.column("own_error")[i] == Approx(table.column("error")[i]).epsilon(0.1));  // theory is the limit
    CHECK(contains(text(table, "command", i), "-D kn="));
  }
  CHECK(rows == 4);
  // One knob alone, by its name or its param, and any param from the command line.
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--force", "--knob", "stiffness"}) == 0);
  CHECK_FALSE(contains(bench.said, "quality draft"));
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--force", "--knob", "kn=1e7,1e9"}) == 0);
  CHECK(contains(bench.said, "stiffness 1e+09"));
  CHECK_FALSE(contains(bench.said, "stiffness 1e+06"));
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--force", "-D", "kn=1e9"}) == 0);
  CHECK(contains(bench.said, "stiffness: -D kn=1e9 fixes it  not applicable"));
}

TEST_CASE("several knobs are varied alone and together", "[program]") {
  Bench bench;
  const std::string scene =
      bench.scene("local more = param('more', 1)\n" +
                  with_knob("accuracy{ param = 'kn', values = { 1e6, 1e8, 1e10 } }\naccuracy{ param = 'more', values = { 4, 1 } }"));
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--quantity", "length"}) == 0);
  INFO(bench.said);
  for (const char* name : {"kn 1e+06, more 4", "kn 1e+08, more 4", "kn 1e+10, more 1"}) CHECK(contains(bench.said, name));
  CHECK(read_csv(bench.out() + "/results.csv").rows() == 1 + 4 + 3 + 1 + 2);  // as it is, points, kn, more, together; equal runs once
}

TEST_CASE("a run of accuracy that fails is a row with its reason; after a kill the others are kept", "[program]") {
  Bench bench;
  const std::string scene = bench.scene(with_knob("accuracy{ param = 'trouble', values = { 4, 3, 2 } }"));
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "-j", "1"}) == 0);
  CHECK(contains(bench.said, "no scene for this value"));
  const std::string before = text_of(bench.folder / "out/results.csv");
  // The last row torn, as by a kill.
  std::ofstream(bench.folder / "out/results.csv") << before.substr(0, before.size() - 5);
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--resume"}) == 0);
  CHECK(text_of(bench.folder / "out/results.csv") == before);
  // Another scene under the same name is another study.
  bench.scene(with_knob("accuracy{ param = 'trouble', values = { 4, 2 } }"));
  CHECK(bench.erbs({"accuracy", scene, "-o", bench.out(), "--resume"}) == 2);
  CHECK(contains(bench.said, "replace it with --force"));
}

TEST_CASE("mistakes in the knobs of a scene are told with place and remedy", "[program]") {
  Bench bench;
  const std::pair<const char*, const char*> wrong[] = {
      {"accuracy{ param = 'kx', values = { 1, 2 } }", "there is no param \"kx\" yet; did you mean \"kn\"?"},
      {"accuracy{ param = 'kn', values = {} }", "values must be two numbers or more, from coarse to fine"},
      {"accuracy{ param = 'kn', values = { 1e8 } }", "values must be two numbers or more"},
      {"accuracy{ param = 'kn', values = { 1, 3, 2 } }", "2 follows 3; put them in order"},
      {"accuracy{ param = 'kn', values = { 1, 0 } }", "values must be above zero, and 0 is not"},
      {"accuracy{ param = 'kn' }", "values"},
      {"accuracy{ values = { 1, 2 } }", "param"},
      {"accuracy{ param = 'kn', value = { 1, 2 } }", "did you mean \"values\"?"},
      {"accuracy{ param = 'kn', values = { 1, 2 }, name = 'time step' }", "is a knob of every scene"},
      {"accuracy{ param = 'kn', values = { 1, 2 }, error = 'perio' }", "error = \"perio\" is no metric of the scene"},
      {"accuracy{ param = 'kn', values = { 1, 2 } } accuracy{ param = 'kn', values = { 3, 4 } }", "was given before, at "},
  };
  for (const auto& [call, message] : wrong) {
    CHECK(bench.erbs({"check", bench.scene(with_knob(call))}) == 2);
    INFO(call << "\n" << bench.said);
    CHECK(contains(bench.said, message));
    CHECK(contains(bench.said, "scene.lua:"));
  }
  const std::string scene = bench.scene(with_knob(""));
  const std::pair<const char*, const char*> options[] = {{"stiffnes", "the scene has no such knob"},
                                                         {"kx=1,2", "the scene has no param \"kx\"; did you mean \"kn\"?"},
                                                         {"kn=", "\"\" is no number"},
                                                         {"kn=1,two", "\"two\" is no number"},
                                                         {"kn=1", "values must be two numbers or more"}};
  for (const auto& [knob, message] : options) {
    CHECK(bench.erbs({"accuracy", scene, "-o", bench.out(), "--force", "--knob", knob}) == 2);
    INFO(knob << "\n" << bench.said);
    CHECK(contains(bench.said, message));
  }
}

TEST_CASE("the whole study is one folder of a few files, its tables and its sentence in seconds", "[program]") {
  Bench bench;
  namespace fs = std::filesystem;
  fs::create_directories(bench.folder / "scenes/accuracy");
  bench.write("scenes/accuracy/p1_one.lua", with_knob("accuracy{ param = 'kn', values = { 1e6, 1e8, 1e10 } }"));
  bench.write("scenes/accuracy/p2_two.lua", with_knob(""));
  bench.write("scenes/accuracy/README.md", "<!-- accuracy -->\n<!-- /accuracy -->\n<!-- quality -->\n<!-- /quality -->\n");
  bench.write("README.md", "<!-- accuracy -->\n<!-- /accuracy -->\n");
  REQUIRE(bench.erbs({"accuracy", "--study", (bench.folder / "scenes/accuracy").string(), "-o", bench.out()}) == 0);
  INFO(bench.said);
  CHECK(std::distance(fs::directory_iterator(bench.out()), {}) <= 12);
  for (const char* name : {"accuracy.csv", "accuracy.svg", "accuracy.png", "results.csv"})
    CHECK(fs::file_size(bench.folder / "out" / name) > 500);
  CHECK(contains(text_of(bench.folder / "scenes/accuracy/README.md"), "| `p1_one` | `metrics.length` | theory |"));
  CHECK(contains(text_of(bench.folder / "README.md"), "in seconds of one processor for an error of 1 % and of 0.1 %: `p1_one` 0."));
  CHECK(bench.erbs({"accuracy", "--study", (bench.folder / "scenes").string(), "-o", bench.out(), "--force"}) == 2);
  CHECK(contains(bench.said, "holds no problem"));
}
