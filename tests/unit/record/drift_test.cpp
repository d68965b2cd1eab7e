// Displacement and drift over height, of blocks whose motion is known.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/record/report/drift.h"

using namespace erbs;

namespace {

// `n` courses of two blocks of .5 x .5 x .5 m above a fixed block; block b of course i moves by u(z) along x and v(z) along y.
struct Tower {
  MotionScene scene;
  std::vector<MotionFrame> frames;
  explicit Tower(int n) {
    MotionShape cube;
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis) cube.vertices.push_back(corner >> axis & 1 ? 0.25f : -0.25f);
    scene.shapes = {cube};
    scene.blocks.push_back({"ground", "ground", 0, true, {0, 0, 0.75}, {0}});
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 2; ++k) scene.blocks.push_back({"b", "tower", 0, false, {0.5 * k, 0, 1.25 + 0.5 * i}, {0}});
  }
  template <class U, class V>
  void add(double t, U&& u, V&& v) {
    MotionFrame frame;
    frame.t = t;
    for (const MotionBlock& block : scene.blocks) {
      const double z = block.rest.z() - 1;
      const Vec3 at = block.fixed ? block.rest : Vec3(block.rest + Vec3(u(z), v(z), 0));
      for (const double value : {at.x(), at.y(), at.z(), 1.0, 0.0, 0.0, 0.0}) frame.poses.push_back(float(value));
    }
    frames.push_back(frame);
  }
};

}  // namespace

TEST_CASE("a tower that leans has the same drift at all heights", "[drift]") {
  for (const int courses : {2, 5, 24})
    for (const double lean : {1e-3, 0.02, -0.3}) {
      Tower tower(courses);
      for (const double share : {0.0, 1.0, 0.5})
        tower.add(
            share, [&](double z) { return lean * share * z; }, [&](double z) { return -2 * lean * share * z; });
      const DriftProfile profile = drift_profile(tower.scene, tower.frames, courses);
      REQUIRE(profile.height.size() == std::size_t(courses));
      for (std::size_t i = 0; i < profile.height.size(); ++i) {
        CHECK(profile.height[i] == Approx(0.25 + 0.5 * double(i)));
        // poses are single precision: 1e-7 of some 10 m, over a level of .5 m (.25 m at the ground)
        CHECK(profile.drift[0][i] == Approx(std::abs(lean)).margin(1e-5));
        CHECK(profile.drift[1][i] == Approx(2 * std::abs(lean)).margin(1e-5));
        CHECK(profile.displacement[0][i] == Approx(std::abs(lean) * profile.height[i]).margin(1e-5));
      }
    }
}

TEST_CASE("the drift of a level is that of its own instant, and one brick that falls out does not count", "[drift]") {
  Tower tower(3);
  tower.scene.blocks.push_back({"b", "tower", 0, false, {1, 0, 1.25}, {0}});  // a third block in the lowest course
  tower.add(
      0, [](double z) { return z < 0.5 ? 0.01 : 0.0; }, [](double) { return 0.0; });
  tower.add(
      1, [](double z) { return z > 1 ? -0.02 : 0.0; }, [](double) { return 0.0; });
  tower.frames[1].poses[std::size_t(7 * 7)] += 5;  // thrown out by 5 m
  const DriftProfile profile = drift_profile(tower.scene, tower.frames, 3);
  CHECK(profile.displacement[0][0] == Approx(0.01).margin(1e-5));
  CHECK(profile.drift[0][0] == Approx(0.04).margin(1e-5));
  CHECK(profile.drift[0][1] == Approx(0.02).margin(1e-5));  // at 0 s, between the lower two courses
  CHECK(profile.drift[0][2] == Approx(0.04).margin(1e-5));  // at 1 s
}

TEST_CASE("a level holds as many courses as leave few enough, and nothing that moves is an error", "[drift]") {
  Tower tower(2);
  tower.add(
      0, [](double z) { return 0.1 * z; }, [](double) { return 0.0; });
  const DriftProfile profile = drift_profile(tower.scene, tower.frames, 40);
  CHECK(profile.height.size() == 2);
  CHECK(profile.drift[0][1] == Approx(0.1).margin(1e-5));
  Tower tall(7);
  tall.add(
      0, [](double z) { return 0.1 * z; }, [](double) { return 0.0; });
  const DriftProfile coarse = drift_profile(tall.scene, tall.frames, 3);
  REQUIRE(coarse.height.size() == 3);  // of three, three and one course
  CHECK(coarse.height[0] == Approx(0.75));
  CHECK(coarse.height[2] == Approx(3.25));
  for (const double ratio : coarse.drift[0]) CHECK(ratio == Approx(0.1).margin(1e-5));
  CHECK_THROWS_AS(drift_profile(tower.scene, {}, 4), Error);
  for (MotionBlock& block : tower.scene.blocks) block.fixed = true;
  CHECK_THROWS_AS(drift_profile(tower.scene, tower.frames, 4), Error);
}

TEST_CASE("the figure of drift has a panel for displacement and one for drift", "[drift]") {
  Tower tower(4);
  tower.add(
      0, [](double z) { return 0.1 * z; }, [](double) { return 0.0; });
  DriftProfile profile = drift_profile(tower.scene, tower.frames, 4);
  profile.run = "one";
  const plot::Figure figure = drift_figure({profile, profile}, "note");
  REQUIRE(figure.panels.size() == 2);
  CHECK(figure.panels[0].series.size() == 4);
  CHECK(figure.panels[1].x.label == "largest drift [%]");
  CHECK(figure.panels[1].y.range == figure.panels[0].y.range);
  CHECK_THROWS_AS(drift_figure(std::vector<DriftProfile>(8, profile), ""), Error);
}
