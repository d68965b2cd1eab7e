// erbs sweep as a user calls it: results, resumption after kill -9, failures as rows, mistakes.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <random>
#include <thread>

#include "engine/record/format/csv.h"
#include "tests/unit/lua/commands/study_bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// A block that flies for two milliseconds. trouble: 1 error, 2 NaN, 3 no memory, 4 no end
const std::string troubled_block = R"(
local h, trouble = param("h", 1, "height [m]"), param("trouble", 0)
local motion, side = param("motion", "a.csv"), param("side", "x")
material{ name = "stone", density = 2000 }
box{ name = "b", size = { .3, .3, h }, at = { 0, 0, 5 }, free = true, material = "stone" }
if trouble == 1 then error("no scene for this value") end
if trouble == 3 then string.rep("x", 2^28) end
analysis{ duration = trouble == 4 and 1e6 or .002, start = "rest", stop_after_collapse = 1e6 }
metric("double", "m", function(run) if trouble == 2 then return 0 / 0 end return 2 * h end)
metric("tall", "", function() return h > 1.37 and 1 or 0 end)
)";

struct SweepStudy : test::StudyBench {
  SweepStudy() : StudyBench(troubled_block) {}
  std::string results(const std::string& directory = "") const { return text_of((directory.empty() ? out() : directory) + "/results.csv"); }
  CsvTable table() const { return read_csv(out() + "/results.csv"); }
};

const std::string grid = R"(study{ scene = "tiny.lua", vary = { grid{ h = { 1, 2, 3, 4 } }, latin{ n = 5, trouble = { 10, 20 } } },
  collect = { "metrics.double", "status", "collapse.time_s" } })";
const std::string threshold =
    "study{ scene = 'tiny.lua', bisect = { param = 'h', lo = 1, hi = 2, rel = .001, points = 1, key = 'metrics.tall' }, collect = { "
    "'metrics.double' }, vary = grid{ trouble = { 10, 11 } } }";

}  // namespace

TEST_CASE("a sweep gives a row for each point, the same for any number of runs at once", "[sweep]") {
  SweepStudy study;
  REQUIRE(study.sweep(grid, {"-j", "1"}) == 0);
  const CsvTable table = study.table();
  REQUIRE(table.rows() == 20);
  CHECK(table.names[1] == "h_m");
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK(table.column("index")[i] == double(i));
    CHECK(table.column("h_m")[i] == double(1 + i / 5));
    CHECK(table.column("double_m")[i] == 2 * table.column("h_m")[i]);
  }
  const std::string first = study.results();
  for (const char* jobs : {"2", "3"}) {
    const std::string other = (study.folder / ("j" + std::string(jobs))).string();
    REQUIRE(study.sweep(grid, {"-j", jobs}, other) == 0);
    CHECK(study.results(other) == first);
  }
  CHECK(read_csv(study.out() + "/runs.csv").rows() == 20);
  CHECK(std::filesystem::exists(study.out() + "/runs/000000.json"));
  CHECK_FALSE(std::filesystem::exists(study.out() + "/runs/000000.log"));
  CHECK_FALSE(std::filesystem::exists(study.out() + "/work"));
}

TEST_CASE("a sweep finds a threshold at each point to the width asked for", "[sweep]") {
  SweepStudy study;
  for (const char* points : {"1", "3"}) {
    std::string text = threshold;
    text.replace(text.find("points = 1"), 10, std::string("points = ") + points);
    REQUIRE(study.sweep(text, {"--force"}) == 0);
    const CsvTable table = study.table();
    REQUIRE(table.rows() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(table.column("h_m_lo")[i] <= 1.37);
      CHECK(table.column("h_m_hi")[i] > 1.37);
      CHECK(table.column("h_m_hi")[i] - table.column("h_m_lo")[i] <= .001 * table.column("h_m_hi")[i]);
      CHECK(table.column("double_m")[i] == 2 * table.column("h_m_hi")[i]);
    }
    double runs = 0;
    for (const double n : table.column("runs")) runs += n;
    CHECK(double(read_csv(study.out() + "/runs.csv").rows()) == runs);
  }
}

TEST_CASE("a sweep that is killed at random moments loses nothing", "[sweep]") {
  std::mt19937 random(7);
  for (const std::string& text : {grid, threshold}) {
    SweepStudy study;
    const std::string whole = (study.folder / "whole").string();
    REQUIRE(study.sweep(text, {"-j", "2"}, whole) == 0);
    const std::vector<std::string> words =
        study.command({"sweep", (study.folder / "study.lua").string(), "-o", study.out(), "-j", "2", "--resume"});
    for (int i = 0; i < 5; ++i) {
      const Child child = start(words, (study.folder / "log").string());
      std::this_thread::sleep_for(std::chrono::milliseconds(30 + random() % 250));
      stop_hard(child);
      waitpid(child.pid, nullptr, 0);
    }
    REQUIRE(study.sweep(text, {"-j", "2", "--resume"}) == 0);
    CHECK(study.results() == study.results(whole));
    const CsvTable runs = read_csv(study.out() + "/runs.csv");
    CHECK(runs.rows() >= read_csv(whole + "/runs.csv").rows());
    CHECK(runs.rows() <= read_csv(whole + "/runs.csv").rows() + 10);  // a run whose sweep died before it took note of it
    const auto written = text_of(study.out() + "/runs.csv");
    std::ofstream(study.out() + "/results.csv", std::ios::app) << "3,4,";
    REQUIRE(study.sweep(text, {"--resume"}) == 0);
    CHECK(study.results() == study.results(whole));
    CHECK(text_of(study.out() + "/runs.csv") == written);  // nothing was run again
  }
}

TEST_CASE("a run that fails is a row with its reason, and the others go on", "[sweep]") {
  SweepStudy study;
  REQUIRE(study.sweep("study{ scene = 'tiny.lua', vary = { grid{ trouble = { 0, 1, 2, 3, 4 } } }, collect = { 'metrics.double' }, "
                      "max_wall = '1.5s', memory = '90MB' }",
                      {"-j", "2"}) == 1);
  const CsvTable table = study.table();
  REQUIRE(table.rows() == 5);
  const auto& status = table.text[std::size_t(table.find("status"))];
  const auto& reason = table.text[std::size_t(table.find("reason"))];
  CHECK(status == std::vector<std::string>{"completed", "error", "completed", "memory", "timeout"});
  CHECK(table.column("double_m")[0] == 2);
  for (std::size_t i = 1; i < 5; ++i) CHECK(std::isnan(table.column("double_m")[i]));
  CHECK_THAT(reason[1], Catch::Contains("tiny.lua:6") && Catch::Contains("no scene for this value"));
  CHECK_THAT(reason[2], Catch::Contains("tiny.lua:9: metric \"double\" is no finite number (0/0?) and has no value"));
  CHECK_THAT(reason[3], Catch::Contains("memory = 90 MB"));
  CHECK_THAT(reason[4], Catch::Contains("max_wall = 1.5 s"));
  CHECK_THAT(study.said, Catch::Contains("3 of 5 points failed; the first: row 1"));
  CHECK(std::filesystem::exists(study.out() + "/runs/000001.log"));
  // a memory in which the program itself finds no room
  CHECK(study.sweep("study{ scene = 'tiny.lua', vary = { grid{ h = { 1 } } }, collect = { 'metrics.double' }, memory = '1MB' }",
                    {"--force"}) == 1);
  CHECK(study.table().text[std::size_t(study.table().find("status"))][0] == "memory");
  // no point with an answer
  CHECK(study.sweep("study{ scene = 'tiny.lua', vary = { grid{ trouble = { 1 } } }, collect = { 'metrics.double' } }", {"--force"}) == 1);
}

TEST_CASE("a run that diverges is a row", "[sweep]") {
  SweepStudy study;
  // A chain of two cubes on springs; past its limit of the time step it diverges from 1e-9 m (scenes/verify/v19_past_the_limit.lua).
  study.write("spring.lua", R"(
local excess, kn, edge = param("excess", .5, "of the limit"), 1e9, .1
gravity(0)
material{ name = "brick", density = 1800 }
joint{ law = mortar{ kn = kn, ks = .01 * kn, ft = 1e9, c = 1e9, mu = .6 } }
box{ name = "foot", size = { edge, edge, edge }, at = { 0, 0, -edge }, fixed = true }
for i = 1, 2 do
  box{ name = "c" .. i, size = { edge, edge, edge }, at = { 0, 0, (i - 1) * edge }, initial = i == 2 and { position = { 0, 0, 1e-9 } } or nil }
end
local limit = math.sqrt(1800 * edge / kn) / math.cos(pi / 5)
analysis{ duration = 5000 * limit, dt = { excess * limit, unstable = true }, start = "rest", output_dt = 100 * limit }
)");
  REQUIRE(study.sweep("study{ scene = 'spring.lua', vary = grid{ excess = { .5, 1.05 } }, collect = 'time_s' }") == 1);
  const CsvTable table = study.table();
  const auto& status = table.text[std::size_t(table.find("status"))];
  CHECK(status[0] == "completed");
  CHECK(status[1] == "diverged");
  CHECK_THAT(table.text[std::size_t(table.find("reason"))][1], Catch::Contains("exit code 1"));
  CHECK(std::isnan(table.column("time_s")[1]));
}

TEST_CASE("a bracket whose ends agree is a row that says what to change", "[sweep]") {
  SweepStudy study;
  const auto reason = [&](const std::string& ends) {
    CHECK(study.sweep("study{ scene = 'tiny.lua', bisect = { param = 'h', " + ends + ", key = 'metrics.tall' } }", {"--force"}) == 1);
    const CsvTable table = study.table();
    CHECK(table.text[std::size_t(table.find("status"))][0] == "no bracket");
    return table.text[std::size_t(table.find("reason"))][0];
  };
  CHECK_THAT(reason("lo = 1.5, hi = 2"), Catch::Contains("yes at lo = 1.5 already; lower it"));
  CHECK_THAT(reason("lo = 1, hi = 1.2"), Catch::Contains("no at hi = 1.2 still; raise it"));
  CHECK_THAT(reason("lo = 2, hi = 1"), Catch::Contains("exchange them"));
  CHECK_THAT(reason("lo = 2, hi = 1.5"), Catch::Contains("yes at lo = 2 already; raise it"));
  study.sweep("study{ scene = 'tiny.lua', bisect = { param = 'h', lo = 1, hi = 2, key = 'status' } }", {"--force"});
  CHECK_THAT(study.results(), Catch::Contains("status is the word") && Catch::Contains("completed"));
}

TEST_CASE("mistakes of a study are refused with line and remedy, before any run", "[sweep]") {
  const std::string collect = ", collect = { 'metrics.double' } }";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"study{ scene = 'tiny.lua', vary = grid{ heigth = { 1 } }" + collect, "has no param \"heigth\""},
      {"study{ scene = 'tiny.lua', vary = grid{ hh = { 1 } }" + collect, "did you mean \"h\""},
      {"study{ scene = 'tiny.lua', vary = grid{ h = {} }" + collect, "h has no values"},
      {"study{ scene = 'tiny.lua', vary = grid{}" + collect, "it is empty"},
      {"study{ scene = 'tiny.lua', vary = list{}" + collect, "it is empty"},
      {"study{ scene = 'tiny.lua', vary = list{ { h = 1 }, { trouble = 1 } }" + collect, "give the same params"},
      {"study{ scene = 'tiny.lua', vary = {}" + collect, "vary must be a list"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, title = 'a\\27[31m'" + collect, "title holds control characters"},
      {"study{ scene = 'ti\\10ny.lua', vary = grid{ h = { 1 } }" + collect, "scene holds control characters"},
      {"study{ scene = 'tiny.lua', vary = { 3 }" + collect, "its item 1 must be grid"},
      {"study{ scene = 'tiny.lua'" + collect, "it varies nothing"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } } }", "it collects nothing"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, collect = { 'status', 'time_s', 'status' } }", "\"status\" twice"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, collect = 'capacity.walls.nowhere' }", "has no key"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, collect = 'metrics.doubel' }", "did you mean \"metrics.double\""},
      {"study{ scene = 'tiny.lua', vary = { grid{ h = { 1 } }, grid{ h = { 2 } } }" + collect, "varied twice"},
      {"study{ scene = 'tiny.lua', vary = { perturbations{ n = 2 }, perturbations{ n = 3 } }" + collect, "given twice"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1, 2, 1 } }" + collect, "grid: h = 1 is there twice"},
      {"study{ scene = 'tiny.lua', vary = list{ { h = 1 }, { h = 1 } }" + collect, "list: h = 1 is there twice"},
      {"study{ scene = 'tiny.lua', vary = latin{ n = 300000, motion = { 1, 2 } }" + collect, "takes a word"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 'a' } }" + collect, "takes a number"},
      {"study{ scene = 'tiny.lua', vary = grid{ motion = { 1 } }" + collect, "takes a word"},
      {"study{ scene = 'no.lua', vary = grid{ h = { 1 } }" + collect, "there is no scene"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 0/0 } }" + collect, "finite numbers"},
      {"study{ scene = 'tiny.lua', vary = latin{ n = 0, h = { 1, 2 } }" + collect, "n must be a whole number"},
      {"study{ scene = 'tiny.lua', vary = latin{ n = 3, h = { 2, 1 } }" + collect, "{ lowest, highest }"},
      {"study{ scene = 'tiny.lua', vary = random{ n = 3, h = { 0, 1, log = true } }" + collect, "above zero"},
      {"study{ scene = 'tiny.lua', vary = random{ n = 3 }" + collect, "it varies nothing"},
      {"study{ scene = 'tiny.lua', vary = records{ param = 'motion', files = {}, scale = 'h' }" + collect, "files is empty"},
      {"study{ scene = 'tiny.lua', bisect = { param = 'h', lo = 1, hi = 1 } }", "lo and hi are the same"},
      {"study{ scene = 'tiny.lua', bisect = { param = 'motion', lo = 1, hi = 2 } }", "only a number can be bisected"},
      {"study{ scene = 'tiny.lua', bisect = { param = 'h', lo = 1, high = 2 } }", "\"high\""},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, max_wall = '5 parsec'" + collect, "max_wall must be"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, memory = -1" + collect, "memory must be"},
      {"study{ scene = 'tiny.lua', vary = grid{ h = { 1 } }, keep = 'some'" + collect, "none"},
      {"local x = 1", "no study"},
      {"study{ scene = 'tiny.lua', vary = latin{ n = 2, h = { 2, 1 } }" + collect, "h must be a range"},
      {"material{ name = 's', density = 1 } box{ name = 'b', size = { 1, 1, 1 }, at = { 0, 0, 0 }, material = 's' } study{ scene = "
       "'tiny.lua', vary = grid{ h = { 1 } }" +
           collect,
       "makes no blocks"}};
  SweepStudy study;
  for (const auto& [text, wanted] : cases) {
    INFO(text);
    CHECK(study.sweep(text) == 2);
    CHECK_THAT(study.said, Catch::Contains(wanted));
    if (wanted == "h must be a range") CHECK_THAT(study.said, !Catch::Contains("varies nothing"));
    CHECK_FALSE(std::filesystem::exists(study.out()));
  }
  CHECK(study.sweep(grid, {"-D", "h=2"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("varied by the study, and -D h=2 sets it"));
  CHECK(study.sweep(grid, {"-D", "hight=2"}) == 2);
  CHECK(study.sweep(grid, {"--force", "--resume"}) == 2);
  for (const char* text :
       {"study{ scene = 'tiny.lua' }", "grid{ h = { 1 } }", "study{ scene = 'tiny.lua', vary = latin{ n = 2, h = { 1, 2 } } }"}) {
    CHECK(study.run(text) == 2);
    CHECK_THAT(study.said, Catch::Contains("erbs sweep") && Catch::Contains("scene.lua:1"));
  }
}

TEST_CASE("a folder is taken up by its own study only", "[sweep]") {
  SweepStudy study;
  REQUIRE(study.sweep(grid) == 0);
  CHECK(study.sweep(grid) == 2);
  CHECK_THAT(study.said, Catch::Contains("--resume") && Catch::Contains("--force"));
  CHECK(study.sweep(threshold, {"--resume"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("another study") && Catch::Contains("-o DIR"));
  study.write("tiny.lua", troubled_block + "-- changed\n");
  CHECK(study.sweep(grid, {"--resume"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("the scene, or a file that it reads, has changed"));
  study.write("tiny.lua", troubled_block);
  CHECK(study.sweep(grid + "-- another limit of time is the same study\n", {"--resume"}) == 0);
  // a results file alone, from elsewhere
  const std::string other = (study.folder / "other").string();
  std::filesystem::create_directories(other);
  std::filesystem::copy_file(study.out() + "/results.csv", other + "/results.csv");
  study.write("tiny.lua", troubled_block + "-- changed\n");
  CHECK(study.sweep(grid, {"--resume"}, other) == 2);
  CHECK_THAT(study.said, Catch::Contains("of another study"));
  // a folder of something else
  std::ofstream(study.folder / "mine.txt") << "mine";
  CHECK(study.sweep(grid, {"--force"}, study.folder.string()) == 2);
  CHECK(text_of(study.folder / "mine.txt") == "mine");
}

TEST_CASE("records vary by their files and peaks, and a study has params of its own", "[sweep]") {
  SweepStudy study;
  for (const char* name : {"a.csv", "b.csv"}) study.write(name, "0,0\n0.01,1\n0.02,0\n");
  study.write("tiny.lua",
              troubled_block +
                  "ground_motion{ wave = record{ file = motion, unit = 'm/s2', peak = param('pga', 1, '[m/s2]') }, direction = 'x' }\n");
  const std::string text =
      "study{ scene = 'tiny.lua', vary = records{ param = 'motion', files = { 'a.csv', 'b.csv' }, scale = 'pga', scales = { param('low', "
      ".1) "
      "* g, .2 * g, .3 * g } }, collect = { 'metrics.double' } }";
  REQUIRE(study.sweep(text, {"-D", "low=.05", "-D", "h=3"}) == 0);
  const CsvTable table = study.table();
  REQUIRE(table.rows() == 6);
  CHECK(table.column("pga_m_s2")[3] == Approx(.05 * 9.81));
  CHECK(table.text[std::size_t(table.find("motion"))][3] == "b.csv");
  CHECK(table.column("double_m")[5] == 6);
  study.write("b.csv", "0,0\n0.01,2\n0.02,0\n");
  CHECK(study.sweep(text, {"-D", "low=.05", "-D", "h=3", "--resume"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("has changed"));
  std::filesystem::remove(study.folder / "b.csv");
  CHECK(study.sweep(text, {"--force"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("study.lua:1") && Catch::Contains("b.csv"));
}

TEST_CASE("what stays of each run is as the study asks", "[sweep]") {
  SweepStudy study;
  for (const auto& [keep, folder, metrics] : {std::tuple{"none", false, false}, {"metrics", false, true}, {"all", true, false}}) {
    REQUIRE(study.sweep(
                fmt::format("study{{ scene = 'tiny.lua', vary = grid{{ h = {{ 1 }} }}, collect = 'metrics.double', keep = '{}' }}", keep),
                {"--force"}) == 0);
    CHECK(std::filesystem::exists(study.out() + "/runs/000000/metrics.json") == folder);
    CHECK(std::filesystem::exists(study.out() + "/runs/000000.json") == metrics);
  }
}

TEST_CASE("the ranks of mpirun share a study, and so do the tasks of a job array", "[sweep]") {
  SweepStudy study;
  const std::string alone = (study.folder / "alone").string();
  REQUIRE(study.sweep(grid, {"-j", "1"}, alone) == 0);
  SECTION("mpirun") {
    if (!can_start("mpirun")) {
      WARN("skipped: mpirun is not installed (package openmpi-bin)");
      return;
    }
    for (const auto& [text, ranks] : {std::pair{grid, "1"}, {grid, "2"}, {grid, "3"}, {threshold, "1"}, {threshold, "3"}}) {
      REQUIRE(study.sweep(text, {"-j", "1", "--force"}, alone) == 0);
      std::vector<std::string> words{"mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", ranks};
      for (const auto& word : study.command({"sweep", (study.folder / "study.lua").string(), "-o", study.out(), "--force"}))
        words.push_back(word);
      CHECK(wait_for(start(words, (study.folder / "log").string())) == 0);
      INFO(text_of(study.folder / "log"));
      CHECK(study.results() == study.results(alone));
    }
  }
  SECTION("mpirun, a rank of which is killed") {
    if (!can_start("mpirun")) return;
    study.write("study.lua", grid);
    std::vector<std::string> words{"mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", "2"};
    for (const auto& word : study.command({"sweep", (study.folder / "study.lua").string(), "-o", study.out(), "--force"}))
      words.push_back(word);
    // The second rank ends itself as a node that fails would: without a word, in the midst of the study.
    words.insert(words.begin(), {"timeout", "60"});
    const std::string die = "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then \"$@\" & sleep 0.15; kill -9 $!; kill -9 $$; fi; exec \"$@\"";
    words.insert(words.begin() + 9, {"/bin/sh", "-c", die, "sh"});
    CHECK(wait_for(start(words, (study.folder / "log").string())) != 0);
    REQUIRE(study.sweep(grid, {"--resume"}) == 0);
    CHECK(study.results() == study.results(alone));
  }
  SECTION("tasks of the job that --slurm writes, one of which is killed") {
    REQUIRE(study.sweep(grid, {"--slurm", "-j", "3"}) == 0);
    CHECK_THAT(text_of(study.out() + "/job.sh"), Catch::Contains("#SBATCH --array=0-2"));
    const std::string spaced = (study.folder / "a b").string();
    REQUIRE(study.sweep(grid, {"--slurm"}, spaced) == 0);
    CHECK_THAT(study.said, Catch::Contains("sbatch '" + spaced + "/job.sh'"));
    CHECK_THAT(text_of(spaced + "/job.sh"), Catch::Contains("--output='" + spaced + "/job_logs/%a.log'\n"));
    std::vector<Child> tasks;
    for (const char* task : {"0", "1", "2"})
      tasks.push_back(start({"env", std::string("SLURM_ARRAY_TASK_ID=") + task, "SLURM_PROCID=0", "sh", study.out() + "/job.sh"},
                            (study.folder / "log").string()));
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    stop_hard(tasks[1]);
    waitpid(tasks[1].pid, nullptr, 0);
    CHECK(wait_for(tasks[0]) == 0);
    CHECK(wait_for(tasks[2]) == 0);
    REQUIRE(study.sweep(grid, {"--resume"}) == 0);  // collects
    CHECK(study.results() == study.results(alone));
  }
}

TEST_CASE("a sweep's figure has the labels it is given, and a file for each value of split", "[sweep]") {
  SweepStudy study;
  const std::string common =
      "study{ scene = 'tiny.lua', vary = grid{ h = { 1, 2, 3 }, trouble = { 10, 11 } }, collect = { 'metrics.double' }, ";
  REQUIRE(study.sweep(common + "x = 'height [m]', y = 'twice the height [m]', split = 'trouble' }") == 0);
  const auto exists = [&](const char* file) { return std::filesystem::exists(study.out() + "/" + file); };
  for (const char* file : {"results_trouble_10.svg", "results_trouble_11.svg", "results_trouble_11.png"}) CHECK(exists(file));
  CHECK_FALSE(exists("results.svg"));
  const std::string figure = text_of(study.out() + "/results_trouble_11.svg");
  for (const char* words : {"height [m]", "twice the height [m]", "trouble 11"}) CHECK_THAT(figure, Catch::Contains(words));
  REQUIRE(study.sweep(common + "title = 'both' }", {"--force"}) == 0);  // the figures of before are gone
  CHECK(exists("results.svg"));
  CHECK_FALSE(exists("results_trouble_10.svg"));
  CHECK_THAT(text_of(study.out() + "/results.svg"), Catch::Contains("h [m]"));
  CHECK(study.sweep(common + "split = 'truble' }", {"--force"}) == 2);
  CHECK_THAT(study.said, Catch::Contains("study.lua:1") && Catch::Contains("did you mean \"trouble\""));
}

TEST_CASE("a param that is a word takes it without quotes, and one that is a number does not", "[sweep]") {
  SweepStudy study;
  study.write("b.csv", "0,0\n0.01,1\n");
  const auto run = [&](const std::string& option) { return study.erbs({"check", (study.folder / "tiny.lua").string(), "-D", option}); };
  for (const char* option : {"motion=b.csv", "motion='b.csv'", "motion=\"b.csv\""}) CHECK(run(option) == 0);
  CHECK(run("side=-x") == 0);
  CHECK(run("h=tall") == 2);
  CHECK_THAT(study.said, Catch::Contains("-D h=tall") && Catch::Contains("unknown name"));
  CHECK(run("h=-tall") == 2);
  CHECK_THAT(study.said, Catch::Contains("-D h=-tall") && Catch::Contains("unknown name"));
  CHECK(run("motion=2") == 2);
  CHECK_THAT(study.said, Catch::Contains("takes a word"));
}
