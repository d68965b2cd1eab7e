// A program that is missing is said before the run; what can be made without it is made.
#include <catch2/catch.hpp>

#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

// Calls erbs where PATH finds nothing.
int bare(Bench& bench, const std::vector<std::string>& words) {
  std::vector<std::string> command{"/usr/bin/env", "PATH=" + (bench.folder / "nowhere").string()};
  for (const std::string& word : bench.command(words)) command.push_back(word);
  const int code = wait_for(start(command, (bench.folder / "log").string()));
  bench.said = text_of(bench.folder / "log");
  return code;
}

}  // namespace

TEST_CASE("without gnuplot and ffmpeg a run and its frames are still made", "[program][render]") {
  Bench bench;
  const std::string scene = (bench.folder / "Häuschen 'q\".lua").string();
  std::ofstream(scene) << four_bricks() + "joint{ law = dry{ kn = 1e9, ks = 4e8, mu = .6 } } analysis{ duration = .02, frame_dt = .01 }";
  REQUIRE(bare(bench, {"run", scene, "-o", bench.out()}) == 0);
  CHECK(contains(bench.said, "gnuplot-nox"));
  CHECK(bench.said.find("gnuplot-nox") < bench.said.find("results in"));  // before the run
  CHECK_FALSE(fs::exists(bench.out() + "/histories.svg"));
  REQUIRE(bare(bench, {"render", bench.out(), "--frames", "2", "--size", "160x90"}) == 0);
  CHECK(contains(bench.said, "gnuplot-nox"));
  CHECK(contains(bench.said, "install the package ffmpeg"));
  CHECK(std::distance(fs::directory_iterator(bench.out() + "/frames"), {}) == 2);
  CHECK(bare(bench, {"run", scene, "-o", bench.out(), "--force", "--video"}) == 2);
  CHECK(contains(bench.said, "ffmpeg"));
  REQUIRE(bench.erbs({"render", bench.out(), "--frames", "2", "--size", "160x90", "--force", "--no-figures"}) == 0);
  CHECK(contains(bench.said, "Häuschen__q__corner.mp4"));
}

TEST_CASE("erbs without erbs-render says what belongs beside it", "[program][render]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + "joint{ law = dry{ kn = 1e9, ks = 4e8, mu = .6 } } analysis{ duration = .02 }") == 0);
  const std::string alone = (bench.folder / "erbs").string(), log = (bench.folder / "log").string();
  fs::copy_file(bench.command({}).front(), alone);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"render", bench.out()}, {"run", (bench.folder / "scene.lua").string(), "--video", "--force"}}) {
    std::vector<std::string> command{"/usr/bin/env", "PATH=" + (bench.folder / "nowhere").string(), alone};
    command.insert(command.end(), words.begin(), words.end());
    CHECK(wait_for(start(command, log)) == 2);
    CHECK(contains(text_of(log), "it belongs beside erbs: build or install both"));
  }
}
