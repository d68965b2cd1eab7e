// Distribution of joint stresses over their area, of joints whose stresses are known.
#include "engine/record/report/stress_histogram.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "engine/base/error.h"
#include "tests/support/folder.h"

using namespace erbs;

namespace {

// A run of three frames and `n` joints of 1 x 1, 1 x 2, 1 x 3, ... m with the stresses of `stress`(frame, joint).
template <class F>
std::string run_of(const test::Folder& dir, int n, bool kept, F&& stress) {
  MotionScene scene;
  const int part = share_shape(scene, {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  scene.blocks = {{"base", "ground", 0, true, {0, 0, -1}, {part}}, {"top", "wall", 0, false, {0, 0, 1}, {part}}};
  for (int j = 0; j < n; ++j) {
    const double side = j + 1;
    scene.joints.push_back({0, 1, {{0, 0, 1}, {1, 0, 1}, {1, side, 1}, {0, side, 1}}, {0, 0, 1}, 0});
  }
  MotionWriter writer(dir.path.string(), scene, kept);
  for (int f = 0; f < 3; ++f) {
    MotionFrame frame{0.5 * f, std::vector<float>(14), std::vector<std::uint8_t>(std::size_t(n)), std::vector<float>(std::size_t(n))};
    for (int j = 0; kept && j < n; ++j) frame.normal_stress.push_back(float(stress(f, j))), frame.shear_stress.push_back(float(7 * f));
    if (kept) frame.force.resize(std::size_t(3 * n)), frame.force_at.resize(std::size_t(3 * n));
    writer.write(frame);
  }
  writer.close();
  return dir.path.string();
}

}  // namespace

TEST_CASE("stresses count by the area of their joints", "[record][histogram]") {
  const test::Folder dir;
  const MotionReader reader(run_of(dir, 3, true, [](int f, int j) { return -1e5 * f * (j + 1); }));
  const StressSample last = stress_sample(reader, "normal_stress", ""), middle = stress_sample(reader, "normal_stress", "0.6");
  CHECK(last.t == 1);
  CHECK(middle.t == 0.5);
  CHECK(last.area[2] == Approx(3));
  CHECK(last.stress[2] == Approx(-6e5));
  CHECK(stress_sample(reader, "shear_stress", "1").stress[0] == Approx(14));
  const StressBins bins = stress_bins({last, middle});
  for (const auto& share : bins.share) CHECK(std::accumulate(share.begin(), share.end(), 0.0) == Approx(1));
  const auto share_at = [&](std::size_t sample, double stress) {
    return bins.share[sample][std::size_t((stress - bins.low) / bins.width + 1e-6)];
  };
  CHECK(share_at(0, -6e5) == Approx(0.5));  // three of six square metres
  CHECK(share_at(0, -2e5) == Approx(1.0 / 6));
  CHECK(share_at(1, -1e5) == Approx(1.0 / 6));
  const plot::Figure figure = stress_figure({last, middle}, "normal_stress");
  REQUIRE(figure.panels.size() == 1);
  CHECK(figure.panels[0].x.label == "normal stress, tension positive [MPa]");
  CHECK(figure.panels[0].series.size() == 2);
}

TEST_CASE("joints without stress, of one stress, or with tension are counted too", "[record][histogram]") {
  for (const double stress : {0.0, 5.0, -3e6, 1e-300}) {
    const test::Folder dir;
    const MotionReader reader(run_of(dir, 2, true, [&](int, int) { return stress; }));
    const StressBins bins = stress_bins({stress_sample(reader, "normal_stress", "")});
    double most = 0;
    for (const double share : bins.share[0]) most = std::max(most, share);
    CHECK(most == Approx(1));
  }
}

TEST_CASE("a histogram says what it lacks", "[record][histogram]") {
  const test::Folder kept, none, old;
  const auto zero = [](int, int) { return 0.0; };
  const MotionReader reader(run_of(kept, 2, true, zero));
  CHECK_THROWS_WITH(stress_sample(reader, "normal_stress", "2.5"), Catch::Contains("outside the run") && Catch::Contains("0 s to 1 s"));
  CHECK_THROWS_WITH(stress_sample(reader, "normal_stress", "0:1"), Catch::Contains("one time"));
  CHECK_THROWS_WITH(stress_sample(reader, "normal_stress", "nan"), Catch::Contains("not a time"));
  CHECK_THROWS_WITH(stress_sample(MotionReader(run_of(none, 0, true, zero)), "normal_stress", ""), Catch::Contains("no joints"));
  CHECK_THROWS_WITH(stress_sample(MotionReader(run_of(old, 2, false, zero)), "normal_stress", ""), Catch::Contains("frame_stress = true"));
}
