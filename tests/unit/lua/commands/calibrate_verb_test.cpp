// erbs calibrate as a user calls it: what it finds and writes, and mistakes with their place.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <thread>

#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

namespace fs = std::filesystem;

// A block that flies for some milliseconds, with metrics that are known functions of its params.
const std::string decaying_block = R"(
local a, b, ks = param("a", 1, "[m]"), param("b", 1, "[s]"), param("ks", 1, "[Pa/m]")
material{ name = "stone", density = 2000 }
box{ name = "b", size = { .3, .3, .3 }, at = { 0, 0, 5 }, free = true, material = "stone" }
recorder{ name = "b", quantity = "displacement", block = "b", axis = "z" }
analysis{ duration = .02, start = "rest", output_dt = .002 }
for i = 1, 4 do metric("y_" .. i, "m", function() return a * math.exp(-b * i) end) end
metric("slip", "", 1 / ks)
metric("none", "", function() return 0 / 0 end)
)";

std::string study_of(const std::string& stages, const std::string& more = "") {
  return "local keys, values = {}, {}\nfor i = 1, 4 do keys[i], values[i] = 'metrics.y_' .. i, 3 * math.exp(-.4 * i) end\n"
         "calibration{ scene = 'tiny.lua', rel = 1e-5, rounds = 60, stages = { " +
         stages + " },\n  targets = { { label = 'y [m]', keys = keys, values = values } }" + more + " }\n";
}

struct Calibration : Bench {
  Calibration() { write("tiny.lua", decaying_block); }
  int calibrate(const std::string& study, const std::vector<std::string>& more = {}) {
    write("study.lua", study);
    std::vector<std::string> words{"calibrate", (folder / "study.lua").string(), "-o", out()};
    words.insert(words.end(), more.begin(), more.end());
    return erbs(words);
  }
  Json result() const { return read_json(out() + "/calibration.json"); }
};

}  // namespace

TEST_CASE("a calibration finds the params of known values, stage by stage, and draws them", "[calibrate]") {
  Calibration bench;
  REQUIRE(bench.calibrate(study_of(
              "{ raise = { ks = { 1, 1e4, log = true } }, key = 'metrics.slip', below = .01 }, "
              "{ fit = { a = { .1, 10, log = true }, b = { 0, 2 } } }",
              ", history = { column = 'b_uz_rel_m', label = 'fall [m]', t = { 0, .01, .02 }, values = { 0, -.0005, -.002 } }")) == 0);
  const Json found = bench.result();
  CHECK(found["values"]["a"].get<double>() == Approx(3).epsilon(1e-3));
  CHECK(found["values"]["b"].get<double>() == Approx(0.4).epsilon(1e-3));
  const double ks = found["values"]["ks"].get<double>();
  CHECK((ks > 100 && ks < 110));  // slip is 1 / ks; 1 % of four decades wide
  CHECK(found["stages"][0]["kind"] == "raise");
  CHECK(found["rms"].get<double>() < 1e-3);
  CHECK(found["rms_before"].get<double>() > 0.1);
  for (const char* file : {"calibration.svg", "calibration.png", "runs/best/histories.csv", "runs/start/histories.csv"})
    CHECK(fs::exists(bench.out() + "/" + file));
  const CsvTable table = read_csv(bench.out() + "/calibration.csv");
  CHECK(table.rows() == std::size_t(found["runs"].get<int>()));
  CHECK(table.find("y_1_m") > 0);
  CHECK(bench.calibrate(study_of("{ fit = { a = { .1, 10 } } }")) == 2);  // the folder exists
  CHECK(bench.calibrate(study_of("{ fit = { a = { .1, 2 } } }"), {"--force", "-D", "b=.4"}) == 0);
  CHECK(bench.result()["stages"][0]["params"][0]["at_end_of_range"] == true);
  const std::string one = "calibration{ scene = 'tiny.lua', stages = { { fit = { a = { 1, 5 } } } }, targets = { { label = 'y', keys = {";
  REQUIRE(bench.calibrate(one + "'metrics.y_1' }, values = { 1 } } } }", {"--force"}) == 0);
  CHECK_THAT(bench.said, Catch::Contains("no more known values than params") && !Catch::Contains("moves no target"));
  REQUIRE(bench.calibrate(one + "'metrics.slip' }, values = { 1 } } } }", {"--force"}) == 0);
  CHECK_THAT(bench.said, Catch::Contains("moves no target"));
  REQUIRE(bench.calibrate("calibration{ scene = 'tiny.lua', stages = { { fit = { a = { 1, 2 } } } }, targets = { { label = 'y', "
                          "keys = { 'metrics.y_1' }, values = { 1 } } } }",
                          {"--force"}) == 0);  // y_1 = a / e
  CHECK_THAT(bench.said, Catch::Contains("no more known values") && Catch::Contains("at the end of its range: a wider one may fit better"));
}

TEST_CASE("a raised param is bracketed to the share of its range that rel asks for", "[calibrate]") {
  Calibration bench;
  const auto raised = [&](const char* rel) {
    REQUIRE(bench.calibrate(fmt::format("calibration{{ scene = 'tiny.lua', {} stages = {{ {{ raise = {{ ks = {{ 1, 1000 }} }}, "
                                        "key = 'metrics.slip', below = .00301 }} }}, "
                                        "targets = {{ {{ label = 'y', keys = {{ 'metrics.y_1' }}, values = {{ 1 }} }} }} }}",
                                        rel),
                            {"--force"}) == 0);
    const Json bracket = bench.result()["stages"][0]["bracket"];
    const double lo = bracket[0], hi = bracket[1];
    CHECK((lo < 1 / .00301 && hi >= 1 / .00301));
    CHECK(bench.result()["values"]["ks"] == hi);
    return hi - lo;
  };
  CHECK(raised("") <= 20);
  CHECK_THAT(bench.said, Catch::Contains("not yet at"));
  CHECK(raised("rel = 1e-5,") <= .01);
}

TEST_CASE("a calibration says which runs it leaves out, and why", "[calibrate]") {
  Calibration bench;
  bench.write("tiny.lua", decaying_block + "if a > 4 then error('no wall is so high') end\n");
  REQUIRE(bench.calibrate(study_of("{ fit = { a = { .1, 10 } } }"), {"-D", "b=.4"}) == 0);
  CHECK_THAT(bench.said, Catch::Contains("do not give all targets and are left out") && Catch::Contains("no wall is so high") &&
                             Catch::Contains("calibration.csv"));
}

TEST_CASE("two calibrations do not share a folder", "[calibrate]") {
  Calibration bench;
  const std::string study = study_of("{ fit = { a = { .1, 10, log = true }, b = { 0, 2 } } }");
  bench.write("study.lua", study);
  const Child other = start(bench.command({"calibrate", (bench.folder / "study.lua").string(), "-o", bench.out(), "-j", "1"}),
                            (bench.folder / "other").string());
  for (int i = 0; i < 400 && !fs::exists(bench.out() + "/work"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (const char* how : {"--force", "--resume"}) {
    CHECK(bench.calibrate(study, {how}) == 2);
    CHECK_THAT(bench.said, Catch::Contains("under way") && Catch::Contains("-o DIR"));
  }
  CHECK(wait_for(other) == 0);
  CHECK_FALSE(fs::exists(bench.out() + "/work"));
  CHECK(bench.calibrate(study, {"--resume"}) == 0);
}

TEST_CASE("a calibration that was cut off goes on, and ends with the same values", "[calibrate]") {
  Calibration bench;
  const std::string study = study_of(
      "{ raise = { ks = { 1, 1e4, log = true } }, key = 'metrics.slip', below = .01 }, { fit = { a = { .1, 10, log = true }, b = { 0, 2 } "
      "} }");
  REQUIRE(bench.calibrate(study) == 0);
  const Json whole = bench.result();
  const std::string path = bench.out() + "/calibration.csv", table = text_of(path);
  // Half of the table, its last line torn, as a kill may leave it.
  std::ofstream(path) << table.substr(0, table.size() / 2);
  fs::remove(bench.out() + "/calibration.json");
  const std::size_t kept = read_csv(path).rows();
  REQUIRE(bench.calibrate(study, {"--resume"}) == 0);
  CHECK(bench.result() == whole);
  CHECK(text_of(path) == table);
  CHECK(kept > 5);
  CHECK(bench.calibrate(study) == 2);
  CHECK_THAT(bench.said, Catch::Contains("go on with --resume"));
  CHECK(bench.calibrate(study_of("{ fit = { a = { .1, 10 } } }"), {"--resume"}) == 2);
  CHECK_THAT(bench.said, Catch::Contains("holds another calibration"));
}

TEST_CASE("a calibration that is killed within a batch of runs keeps those that had ended", "[calibrate]") {
  Calibration bench;
  const std::string study = study_of("{ fit = { a = { .1, 10, log = true }, b = { 0, 2 } } }");
  REQUIRE(bench.calibrate(study) == 0);
  const Json whole = bench.result();
  const std::string path = bench.out() + "/calibration.csv", table = text_of(path);
  const Child killed = start(bench.command({"calibrate", (bench.folder / "study.lua").string(), "-o", bench.out(), "-j", "2", "--force"}),
                             (bench.folder / "killed").string());
  const std::size_t batch = 17;  // runs of the first round
  const auto rows = [&] { return fs::exists(path) && fs::file_size(path) > 0 ? read_csv(path).rows() : 0; };
  const auto begun = [&] { return !fs::exists(bench.out() + "/calibration.json") && rows() >= 3; };
  for (int i = 0; i < 4000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(killed.pid, SIGKILL);
  wait_for(killed);
  const std::size_t kept = rows();
  CHECK((kept >= 3 && kept < batch));
  REQUIRE(bench.calibrate(study, {"--resume"}) == 0);
  CHECK(bench.result() == whole);
  CHECK(text_of(path) == table);
}

TEST_CASE("mistakes of a calibration are met with place and remedy", "[calibrate]") {
  Calibration bench;
  const auto refused = [&](const std::string& study, const std::string& words) {
    INFO(study);
    CHECK(bench.calibrate(study, {"--force"}) == 2);
    CHECK_THAT(bench.said, Catch::Contains(words));
    CHECK_THAT(bench.said, Catch::Contains("study.lua:"));
  };
  refused(study_of(""), "it fits nothing");
  refused(study_of("{}"), "give fit or raise");
  refused(study_of("{ fit = { c = { 1, 2 } } }"), "no param \"c\"");
  refused(study_of("{ fit = { a = { 2, 1 } } }"), "must be a range");
  refused(study_of("{ fit = { a = { 0, 1, log = true } } }"), "above zero");
  refused(study_of("{ fit = {} }"), "fit names no param");
  refused(study_of("{ raise = { ks = { 1, 2 } } }"), "give key and below");
  refused(study_of("{ raise = { ks = { 1, 2 }, a = { 1, 2 } }, key = 'metrics.slip', below = 1 }"), "raise takes one param");
  refused(study_of("{ fit = { a = { 1, 2 } }, key = 'metrics.slip', below = 1 }"), "belong to raise");
  refused(study_of("{ raise = { ks = { 1, 2 } }, key = 'metrics.slip', below = .01 }"), "stays above 0.01");
  refused(study_of("{ fit = { a = { 1, 2 } } }", ", history = { column = 'x', label = 'x', t = { 1, 0 }, values = { 1, 1 } }"),
          "must rise");
  refused(
      "calibration{ scene = 'tiny.lua', stages = { { fit = { a = { 1, 2 } } } }, targets = { { label = 'y', keys = { 'metrics.y_1' }, "
      "values = { 1, 2 } } } }",
      "as many values as keys");
  refused(
      "calibration{ scene = 'tiny.lua', stages = { { fit = { a = { 1, 2 } } } }, targets = { { label = 'y', keys = { 'metrics.y_9' }, "
      "values = { 1 } } } }",
      "no key \"metrics.y_9\"");
  refused(
      "calibration{ scene = 'tiny.lua', stages = { { fit = { a = { 1, 2 } } } }, targets = { { label = 'y', keys = { 'metrics.none' }, "
      "values = { 1 } } } }",
      "no run gives all targets");
  refused("study{ scene = 'tiny.lua', vary = grid{ a = { 1, 2 } }, collect = { 'metrics.y_1' } }", "run it by erbs sweep");
  bench.write("study.lua", study_of("{ fit = { a = { 1, 2 } } }"));
  CHECK(bench.erbs({"sweep", (bench.folder / "study.lua").string(), "-o", bench.out() + "2"}) == 2);
  CHECK_THAT(bench.said, Catch::Contains("run it by erbs calibrate"));
}
