#include "engine/study/twin.h"

#include <unistd.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "engine/record/folder/motion_file.h"
#include "tests/support/folder.h"

using namespace erbs;
using namespace erbs::study;

namespace {

// One block whose distance from its reference grows as 1e-9 exp(rate t).
void write_run(const std::string& dir, double rate, double end) {
  std::filesystem::create_directories(dir);
  MotionScene scene;
  scene.shapes.push_back({{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});
  scene.blocks.push_back({"b", "", 0, false, Vec3::Zero(), {0}});
  MotionWriter writer(dir, scene);
  for (int i = 0; 0.1 * i <= end + 1e-9; ++i) {
    const double x = rate > 0 ? 1e-9 * std::exp(rate * 0.1 * i) : 0;
    writer.write({0.1 * i, {float(x), 0, 0, 1, 0, 0, 0}, {}, {}});
  }
}

}  // namespace

TEST_CASE("two runs part when a block stands further apart than asked for", "[study]") {
  const test::Folder folder;
  const std::string dir = folder.path.string();
  write_run(dir + "/a", 0, 2);
  write_run(dir + "/b", 10, 2);
  const auto parted = parting_time(dir + "/a", dir + "/b", 1e-3);
  REQUIRE(parted);
  CHECK(*parted == Approx(std::log(1e6) / 10).epsilon(1e-3));  // interpolation between frames is exact for an exponential
  CHECK_FALSE(parting_time(dir + "/a", dir + "/a", 1e-3));
  write_run(dir + "/c", 10, 1);
  CHECK_FALSE(parting_time(dir + "/a", dir + "/c", 1e-3));
}
