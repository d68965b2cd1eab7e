// A motion file that is not of the run beside it, or is cut off: every verb that reads it refuses it, and writes nothing.
#include <catch2/catch.hpp>
#include <set>

#include "lua/page/page.h"
#include "lua/program/options.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

std::string shaken_pier() {
  return "local peak = param(\"peak\", .1, \"\")\n" + four_bricks() + R"(joint{ law = dry{ kn = 1e9, ks = 4e8, mu = .6 } }
ground_motion{ wave = sine{ amplitude = peak * g, frequency = 3 }, direction = "y" }
analysis{ duration = .1, frame_dt = .02, frame_stress = true }
recorder{ name = "top", quantity = "displacement", block = "b3" })";
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) files.insert(entry.path().string());
  return files;
}

// All verbs that read the frames of a run.
void check_refused(Bench& bench, const std::string& run, const std::string& other, const std::string& reason) {
  const std::string place = (bench.folder / "place").string();
  const std::vector<std::vector<std::string>> calls{{"render", run, "--frames", "2", "--size", "160x90", "--no-figures"},
                                                    {"render", run, "--svg", "--stills", ".05", "--no-figures"},
                                                    {"report", run, "-o", place + ".html"},
                                                    {"export", run, "--format", "gltf", "-o", place},
                                                    {"export", run, "--format", "vtu", "-o", place},
                                                    {"plot", run, "--drift", "-o", place + ".svg"},
                                                    {"plot", run, "--histogram", "normal_stress", "-o", place + ".svg"},
                                                    {"compare", run, other, "-o", place},
                                                    {"compare", other, run, "-o", place}};
  const std::set<std::string> before = files_in(bench.folder);
  for (const std::vector<std::string>& words : calls) {
    CAPTURE(words[0], words[2]);
    if (words[0] == "report" && report_page().script.empty()) {
      WARN("report left out: the packages of its page were absent when this was built; sh .ci/setup installs them");
      continue;
    }
    CHECK(bench.erbs(words) == int(exit_usage));
    INFO(bench.said);
    CHECK(contains(bench.said, "motion.h5"));
    CHECK(contains(bench.said, reason));
    std::set<std::string> after = files_in(bench.folder);
    after.erase((bench.folder / "log").string());
    std::set<std::string> known = before;
    known.erase((bench.folder / "log").string());
    CHECK(after == known);
  }
}

}  // namespace

TEST_CASE("a motion file of other params or cut off is refused by every verb that reads it", "[bad_input][program][render]") {
  Bench bench;
  const std::string weak = (bench.folder / "weak").string(), strong = (bench.folder / "strong").string();
  const std::string scene = bench.scene(shaken_pier());
  for (const auto& [run, peak] : {std::pair(weak, ".1"), {strong, ".2"}})
    REQUIRE(bench.erbs({"run", scene, "-D", std::string("peak=") + peak, "-o", run, "-q", "--no-figures"}) == 0);
  fs::rename(weak + "/motion.h5", bench.folder / "own.h5");
  fs::copy_file(strong + "/motion.h5", weak + "/motion.h5");
  check_refused(bench, weak, strong, "it is of another run");
  fs::remove(weak + "/motion.h5");
  fs::copy_file(bench.folder / "own.h5", weak + "/motion.h5");
  fs::resize_file(weak + "/motion.h5", fs::file_size(weak + "/motion.h5") / 2);
  check_refused(bench, weak, strong, "run the scene again");
}
