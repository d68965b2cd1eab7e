// The folder of a sweep: who may take it, rows that another program takes away, and what the figure shows.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "engine/record/format/csv.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

// A block that flies for two milliseconds; how = 1: for ever, 2: without an answer.
const std::string flying_block = R"(
local h, how, k = param("h", 1, "height [m]"), param("how", 0), param("k", 10, "pressure [Pa]")
material{ name = "stone", density = 2000 }
box{ name = "b", size = { .3, .3, h }, at = { 0, 0, 5 }, free = true, material = "stone" }
analysis{ duration = how == 1 and 1e6 or .002, start = "rest", stop_after_collapse = 1e6 }
metric("double", "m", function(run) if how == 2 then return 0 / 0 end return 2 * h end)
metric("tall", "", function() return h > 1.37 and 1 or 0 end)
)";

struct FolderStudy : Bench {
  FolderStudy() { write("tiny.lua", flying_block); }
  std::vector<std::string> words(const std::string& study, const std::vector<std::string>& more) const {
    write("study.lua", "study{ scene = 'tiny.lua', " + study + " }");
    std::vector<std::string> all{"sweep", (folder / "study.lua").string(), "-o", out()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  int sweep(const std::string& study, const std::vector<std::string>& more = {"--force"}) { return erbs(words(study, more)); }
  std::string figure(const char* file = "results.svg") const { return text_of(out() + "/" + file); }
  // Waits until results.csv holds so many lines.
  bool wait_for_lines(std::ptrdiff_t lines) const {
    for (int i = 0; i < 600; ++i) {
      const std::string text = text_of(out() + "/results.csv");
      if (std::count(text.begin(), text.end(), '\n') >= lines) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
};

// Three quick points, and one that goes on until it is ended.
std::string with_long_end(const char* most) {
  return std::string(
             "vary = { list{ { how = 0, h = 1 }, { how = 0, h = 2 }, { how = 0, h = 3 }, { how = 1, h = 4 } } }, "
             "collect = { 'metrics.double' }, max_wall = '") +
         most + "'";
}

}  // namespace

TEST_CASE("a folder in which a sweep is under way is not replaced", "[sweep]") {
  FolderStudy study;
  const std::string text = with_long_end("60s");
  const Child other = start(study.command(study.words(text, {"-j", "1"})), (study.folder / "other").string());
  REQUIRE(study.wait_for_lines(4));
  const std::string before = text_of(study.out() + "/results.csv");
  CHECK(study.sweep(text) == 2);
  CHECK_THAT(study.said, Catch::Contains("under way") && Catch::Contains("--resume") && Catch::Contains("-o DIR"));
  CHECK(text_of(study.out() + "/results.csv") == before);
  stop_hard(other);
  waitpid(other.pid, nullptr, 0);
  CHECK(study.sweep("vary = grid{ h = { 1, 2 } }, collect = { 'metrics.double' }") == 0);  // of the dead it is
}

TEST_CASE("rows that another program takes from a sweep are missed, and made again", "[sweep]") {
  FolderStudy study;
  const std::string text = with_long_end("3s");
  const Child other = start(study.command(study.words(text, {"-j", "1"})), (study.folder / "other").string());
  REQUIRE(study.wait_for_lines(4));
  std::filesystem::remove(study.out() + "/results.csv");
  CHECK(wait_for(other) == 2);
  CHECK_THAT(text_of(study.folder / "other"), Catch::Contains("holds 1 of 4") && Catch::Contains("--resume"));
  REQUIRE(study.sweep(text, {"--resume"}) == 1);  // its long end takes too long
  CHECK(read_csv(study.out() + "/results.csv").rows() == 4);
  CHECK(read_csv(study.out() + "/runs.csv").rows() == 4);  // from what it knew of the runs
}

TEST_CASE("a program that is replaced while its sweep is under way ends the sweep with its own runs", "[sweep]") {
  FolderStudy study;
  const auto program = study.folder / "erbs";
  std::filesystem::copy_file(test::in_build("/erbs"), program);
  std::vector<std::string> words = study.words(
      "vary = { list{ { how = 1, h = 1 }, { how = 0, h = 2 }, { how = 0, h = 3 } } }, collect = { 'metrics.double' }, "
      "max_wall = '2s'",
      {"-j", "1"});
  words.insert(words.begin(), program.string());
  const Child sweep = start(words, (study.folder / "log").string());
  for (int i = 0; i < 400 && !std::filesystem::exists(study.out() + "/runs/000000.log"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::filesystem::remove(program);
  std::ofstream(program) << "no program";
  CHECK(wait_for(sweep) == 1);
  const CsvTable table = read_csv(study.out() + "/results.csv");
  CHECK(table.text[std::size_t(table.find("status"))] == std::vector<std::string>{"timeout", "completed", "completed"});
}

TEST_CASE("a figure of two params shows lines, or a map where that reads better", "[sweep]") {
  FolderStudy study;
  const std::string common = "vary = grid{ h = { 1, 2, 3, 4 }, k = { 10, 20, 30 } }, collect = { 'metrics.double' }, ";
  REQUIRE(study.sweep(common) == 0);
  for (const char* words : {"h [m]", "double [m]", "k 10 Pa", "k 30 Pa"}) CHECK_THAT(study.figure(), Catch::Contains(words));
  const std::string binary = "vary = grid{ h = { 1, 1.1, 1.2 }, k = { 10, 20, 30 } }, collect = { 'metrics.tall' }, ";
  REQUIRE(study.sweep(binary) == 0);
  CHECK_THAT(study.figure(), Catch::Contains("k [Pa]") && Catch::Contains("tall = 0"));  // what its one colour means
  REQUIRE(study.sweep("vary = grid{ h = { 1, 2, 3, 4, 5 }, k = { 10, 20, 30, 40, 50 } }, collect = { 'metrics.double' }") == 0);
  CHECK_THAT(study.figure(), Catch::Contains("k [Pa]"));
}

TEST_CASE("a figure says what it leaves out, and shows twins about their mean", "[sweep]") {
  FolderStudy study;
  REQUIRE(study.sweep("vary = grid{ h = { 1, 2, 3 }, how = { 0, 2 } }, collect = { 'metrics.double' }") == 0);
  CHECK_THAT(study.figure(), Catch::Contains("how 2: 3 of 3 without an answer") && Catch::Contains("how 0"));
  std::string many;
  for (int i = 1; i <= 14; ++i) many += fmt::format("{}{}", i > 1 ? ", " : "", 10 * i);
  REQUIRE(study.sweep("vary = grid{ h = { 1, 2 }, k = { " + many + " } }, collect = { 'metrics.double' }") == 0);
  // The longest axis lies along x, so that two lines remain.
  CHECK_THAT(study.figure(), Catch::Contains("k [Pa]") && Catch::Contains("h 2 m"));
  REQUIRE(study.sweep("vary = { grid{ k = { " + many +
                      " }, how = { 0 } }, latin{ n = 15, h = { 1, 2 } } }, collect = { 'metrics.double' }") == 0);
  CHECK_THAT(study.figure(), Catch::Contains("and 2 more in results.csv"));
  // Seeds of perturbations are no quantity, however many: the param lies along x.
  REQUIRE(study.sweep("vary = { perturbations{ n = 6 }, grid{ h = { 1, 2, 3 } } }, collect = { 'metrics.double' }") == 0);
  CHECK_THAT(study.figure(), Catch::Contains("h [m]") && Catch::Contains("mean of the runs") && !Catch::Contains("perturbation"));
}

TEST_CASE("a record that changed is found out beside another of its name", "[sweep]") {
  FolderStudy study;
  study.write("tiny.lua",
              "local motion = param('motion', 'one/a.csv')\nmaterial{ name = 'stone', density = 2000 }\n"
              "box{ name = 'b', size = { .3, .3, 1 }, at = { 0, 0, 5 }, free = true }\n"
              "ground_motion{ wave = record{ file = motion, unit = 'm/s2' } }\n"
              "analysis{ duration = .002, start = 'rest', stop_after_collapse = 1e6 }\n");
  for (const char* side : {"one", "two"}) {
    std::filesystem::create_directories(study.folder / side);
    study.write(std::string(side) + "/a.csv", "0,0\n0.01,1\n0.02,0\n");
  }
  const std::string text = "vary = grid{ motion = { 'one/a.csv', 'two/a.csv' } }, collect = 'status'";
  REQUIRE(study.sweep(text) == 0);
  REQUIRE(study.sweep(text, {"--resume"}) == 0);
  study.write("one/a.csv", "0,0\n0.01,2\n0.02,0\n");
  CHECK(study.sweep(text, {"--resume"}) == 2);
  CHECK(contains(study.said, "has changed"));
}
