// erbs export: all formats of one run say the same to VTK and h5py, and Blender loads its script.
#include <catch2/catch.hpp>

#include "engine/base/system/process.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

namespace {

const std::string dry_and_shaken =
    "joint{ law = dry{ kn = 1*GPa, mu = .6 } }\n"
    "ground_motion{ wave = sine{ amplitude = 9, frequency = 2*Hz }, direction = 'x' }\n";

}  // namespace

TEST_CASE("an exported run is read back by VTK and h5py", "[program][export]") {
  const bool stress = GENERATE(true, false);
  Bench bench;
  REQUIRE(bench.run(four_bricks() + dry_and_shaken + fmt::format("analysis{{ duration = .3, frame_stress = {} }}", stress)) == 0);
  const std::string folder = bench.out() + "/export";
  REQUIRE(bench.erbs({"export", bench.out(), "--format", "gltf,vtu,xdmf,hdf5"}) == 0);
  CHECK(contains(bench.said, "frame_stress = true") == !stress);
  CHECK(bench.erbs({"export", bench.out(), "--format", "hdf5"}) == 2);
  CHECK(contains(bench.said, "--force"));
  std::string stem;
  for (const auto& file : fs::directory_iterator(folder))
    if (file.path().extension() == ".pvd") stem = file.path().stem().string();
  const std::string python = fs::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  if (!can_start(python)) {
    WARN("nothing was read back: it needs python3 with h5py and vtk");
    return;
  }
  const fs::path log = fs::path(bench.out()) / "read_back.txt";
  const int code = wait_for(start({python, test::in_source("/tests/export/read_back.py"), folder, stem}, log));
  INFO(text_of(log));
  CHECK((code != 0 || contains(text_of(log), stress ? "with tractions" : "without tractions")));
  if (code == 77) {
    WARN("nothing was read back: it needs the packages python3-h5py and python3-vtk9");
    return;
  }
  CHECK(code == 0);
}

TEST_CASE("short forms stand for formats, each written once", "[program][export]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + dry_and_shaken + "analysis{ duration = .02 }") == 0);
  REQUIRE(bench.erbs({"export", bench.out(), "--vtk", "--csv", "--format", "csv"}) == 0);
  for (const auto& [ending, there] : {std::pair{".pvd", true}, {".csv", true}, {".glb", false}}) {
    INFO(ending);
    CHECK(fs::exists(bench.out() + "/export/scene" + ending) == there);
  }
  REQUIRE(bench.erbs({"export", bench.out(), "--glb", "-q"}) == 0);
  CHECK(fs::exists(bench.out() + "/export/scene.glb"));
}

TEST_CASE("a span or an instant outside of the run is refused before anything is written, or told", "[program][export][bad_input]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + dry_and_shaken + "analysis{ duration = .3 }") == 0);
  const auto refused = [&](std::vector<std::string> words, const char* why) {
    words.insert(words.begin(), {"export", bench.out()});
    INFO(why);
    CHECK(bench.erbs(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, why));
    CHECK_FALSE(fs::exists(bench.out() + "/export"));
  };
  refused({"--time", "9:12"}, "--time 9:12 holds no frame; the run has 9 frames from 0 s to 0.");
  refused({"--time=-3:-1"}, "--time -3:-1 holds no frame");
  refused({"--time", "0.05:0.07"}, "--time 0.05:0.07 holds no frame");  // between two frames
  refused({"--time", "2:1"}, "is not a span of seconds");
  refused({"--time", "0.1"}, "is not a span of seconds");
  refused({"--format", "gltf,vtu", "--at", "0.1"}, "--at 0.1 chooses the instant of an OBJ file, and none is asked for; add --format obj");
  refused({"--format", "obj", "--at", "7"}, "--at 7 is not within the frames exported");
  refused({"--format", "obj", "--at", "0.02", "--time", "0.1:0.2"}, "--at 0.02 is not within the frames exported");
  CHECK(bench.erbs({"export", bench.out(), "--format", "csv", "--time", "0.1:9"}) == 0);
  CHECK(contains(bench.said, "warning: --time 0.1:9 reaches beyond the run"));
  CHECK(bench.erbs({"export", bench.out(), "--format", "csv", "--time", "0:0.3", "--force"}) == 0);
  CHECK_FALSE(contains(bench.said, "reaches beyond"));
}
