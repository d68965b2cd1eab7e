// The command erbs effects from the user's side.
#include <catch2/catch.hpp>

#include "engine/record/format/csv.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

std::string damped_pier(const std::string& analysis = "") {
  return four_bricks() +
         "joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1e5, c = 2e5, mu = .6 } }\ndamping{ mass = 1 }\n"
         "recorder{ name = 't', quantity = 'displacement', block = 'b3' }\n"
         "ground_motion{ wave = sine{ amplitude = 2, frequency = 4 }, direction = 'x' }\nanalysis{ duration = .05" +
         analysis + " }\nmetric('sway', 'm', function(run) return run.peak 't_ux_rel_m' end)\n";
}

}  // namespace

TEST_CASE("effects runs a scene without each of its effects, and keeps what is done", "[program]") {
  Bench bench;
  const std::string scene = bench.scene(damped_pier());
  REQUIRE(bench.erbs({"effects", scene, "-o", bench.out()}) == 0);
  INFO(bench.said);
  const CsvTable table = read_csv(bench.out() + "/effects.csv");
  REQUIRE(table.rows() >= 2);
  CHECK(read_csv(bench.out() + "/results.csv").rows() == table.rows() + 2);  // with the scene as it is, twice
  CHECK(contains(bench.said, "moves %"));
  CHECK(contains(bench.said, "two equal runs of"));
  CHECK(std::filesystem::file_size(bench.folder / "out/effects.svg") > 500);
  CHECK(bench.erbs({"effects", scene, "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "--resume"));
  const std::string before = text_of(bench.folder / "out/effects.csv");
  REQUIRE(bench.erbs({"effects", scene, "-o", bench.out(), "--resume"}) == 0);
  CHECK(text_of(bench.folder / "out/effects.csv") == before);  // no run was made again
}

TEST_CASE("effects of an inaccurate run are shown with a warning", "[program]") {
  Bench bench;
  CHECK(bench.erbs({"effects", bench.scene(damped_pier(", energy_gate = 1e-30")), "-o", bench.out(), "-j", "2"}) == 0);
  INFO(bench.said);
  CHECK(contains(bench.said, "the run of the whole scene is inaccurate"));
  const CsvTable table = read_csv(bench.out() + "/effects.csv");
  REQUIRE(table.find("moves_percent") >= 0);
  CHECK(table.text[std::size_t(table.find("reason"))].front() == "inaccurate");
  CHECK(std::isfinite(table.column("percent").front()));
}

TEST_CASE("a run of effects that fails is a row with its reason, and the scene itself must run", "[program]") {
  Bench bench;
  // Past the limit of the step: every run diverges, and says so.
  const int code = bench.erbs({"effects", bench.scene(damped_pier(", dt = { 1e-2, unstable = true }")), "-o", bench.out()});
  INFO(bench.said);
  CHECK(code == 2);
  CHECK(contains(bench.said, "scene.lua"));
  CHECK(bench.erbs({"effects", bench.scene(damped_pier()), "-o", bench.out(), "--force", "--max-wall", "1ms", "-j", "2"}) == 2);
  CHECK(contains(bench.said, "took longer than max_wall"));
}

TEST_CASE("the option --force leaves alone what no study has written", "[program][sweep]") {
  Bench bench;
  const std::string scene = bench.scene(damped_pier() + "metric('one', '', 1) param('a', 1)\n");
  bench.write("study.lua", "study{ scene = 'scene.lua', vary = { grid{ a = { 1, 2 } } }, collect = { 'time_s' } }");
  std::filesystem::create_directories(bench.out() + "/runs/house");
  std::filesystem::create_directories(bench.out() + "/work");
  const std::vector<std::string> foreign{"runs/house/metrics.json", "runs/notes.txt", "work/draft.txt", "results.csv", "study.json"};
  for (const std::string& file : foreign) bench.write("out/" + file, "of the user\n");
  for (const std::string& verb : {std::string("effects"), std::string("accuracy")}) {
    CHECK(bench.erbs({verb, scene, "-o", bench.out(), "--force"}) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, "holds no results of such runs and is left alone"));
  }
  CHECK(bench.erbs({"sweep", (bench.folder / "study.lua").string(), "-o", bench.out(), "--force"}) == 2);
  CHECK(contains(bench.said, "is no folder of a sweep"));
  for (const std::string& file : foreign) CHECK(text_of(bench.out() + "/" + file) == "of the user\n");
  // Beside results of a study only its own runs go.
  bench.write("out/results.csv", "index,setting,runs,status,reason,study\n");
  bench.write("out/runs/000003_01.log", "of a run\n");
  CHECK(bench.erbs({"effects", scene, "-o", bench.out(), "--force", "-q"}) == 0);
  CHECK_FALSE(std::filesystem::exists(bench.out() + "/runs/000003_01.log"));
  for (const char* file : {"runs/house/metrics.json", "runs/notes.txt", "work/draft.txt"})
    CHECK(text_of(bench.out() + "/" + file) == "of the user\n");
}

TEST_CASE("a mistake in a scene or an option costs no earlier results, --force or not", "[program]") {
  Bench bench;
  const std::string scene = bench.scene(damped_pier() + "metric('one', '', 1)\n");
  REQUIRE(bench.erbs({"accuracy", scene, "-o", bench.out(), "--knob", "time step", "-q"}) == 0);
  const std::string before = text_of(bench.out() + "/results.csv");
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--knob", "tme step"}, {"--quantity", "two"}, {"-D", "x=1"}}) {
    std::vector<std::string> words{"accuracy", scene, "-o", bench.out(), "--force"};
    words.insert(words.end(), more.begin(), more.end());
    CHECK(bench.erbs(words) == 2);
    CHECK(text_of(bench.out() + "/results.csv") == before);
  }
  bench.scene("x =");
  CHECK(bench.erbs({"accuracy", scene, "-o", bench.out(), "--force"}) == 2);
  CHECK(text_of(bench.out() + "/results.csv") == before);
}
