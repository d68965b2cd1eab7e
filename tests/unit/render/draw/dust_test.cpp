// Dust: blows are found where a block hits something, and nowhere in free flight or in rest.
#include "render/draw/dust.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/units.h"
#include "render/draw/draw.h"
#include "render/image/compare.h"
#include "render/run/framing.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// A cube of 0.2 m that falls from `height` (m) on the ground at z = 0, and stays there. Two more stay where they are, joined to each other.
MotionScene cubes() {
  MotionScene scene;
  MotionShape cube;
  for (int i = 0; i < 8; ++i)
    for (const float v : {i & 1 ? 0.1F : -0.1F, i & 2 ? 0.1F : -0.1F, i & 4 ? 0.1F : -0.1F}) cube.vertices.push_back(v);
  cube.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const int part = share_shape(scene, cube);
  for (int i = 0; i < 3; ++i) scene.blocks.push_back({"b", "", 0, false, {1.0 * i, 0, 0.1}, {part}});
  scene.joints.push_back({1, 2, {{0.1, -0.1, -0.1}, {0.1, 0.1, -0.1}, {0.1, 0.1, 0.1}}, {1, 0, 0}, 0});
  return scene;
}

std::vector<Impact> fall(double height, double dt) {
  const MotionScene scene = cubes();
  ImpactFinder finder(scene);
  for (double t = 0; t < 1.5; t += dt) {
    MotionFrame f{t, {}, {0}, {0}};
    for (int i = 0; i < 3; ++i) {
      const double z = i == 0 ? std::max(0.1, 0.1 + height - 0.5 * standard_g * t * t) : 0.1;
      for (const double v : {1.0 * i, 0.0, z, 1.0, 0.0, 0.0, 0.0}) f.poses.push_back(static_cast<float>(v));
    }
    finder.add(std::move(f));
  }
  return finder.impacts;
}

}  // namespace

TEST_CASE("a falling block raises dust where and when it lands", "[render][dust]") {
  const double height = GENERATE(0.5, 1.0, 2.0), dt = GENERATE(0.01, 0.02, 0.04);
  const std::vector<Impact> impacts = fall(height, dt);
  const double lands = std::sqrt(2 * height / standard_g), speed = standard_g * lands;
  REQUIRE_FALSE(impacts.empty());
  CHECK(impacts.size() <= 2);  // the blow lies between two frames
  double most = 0;
  for (const Impact& blow : impacts) {
    most = std::max(most, blow.speed);
    CHECK(std::fabs(blow.t - lands) <= dt + 1e-9);
    CHECK(std::fabs(blow.at.x()) < 1e-6);
    CHECK(blow.at.z() < speed * dt + 0.01);
    CHECK(blow.size == Approx(0.2).epsilon(1e-5));
  }
  CHECK(most > 0.45 * speed);
  CHECK(most < 1.05 * speed);
  CHECK(dust_at(impacts, lands - 2 * dt).empty());
  CHECK_FALSE(dust_at(impacts, lands + 0.2).empty());
  CHECK(dust_at(impacts, lands + 5).empty());
  for (const Puff& puff : dust_at(impacts, lands + 0.2)) {
    CHECK(puff.opacity > 0);
    CHECK(puff.opacity < 0.31);
    CHECK(puff.at.allFinite());
  }
}

TEST_CASE("a short hop raises none", "[render][dust]") { CHECK(fall(0.005, 0.01).empty()); }

TEST_CASE("dust changes the picture where it is, softly, and the same each time", "[render][dust]") {
  prepare_contexts();
  const MotionScene scene = brick_house({1.2, 1.2, 6, 1, 0.5});
  const MotionFrame frame = brick_house_frame(scene, 0);
  const Show show = prepare_show(scene, {}, {frame});
  Look look;
  look.width = 320, look.height = 180;
  const Camera camera = choose_cameras(show.stage, 16.0 / 9).front();
  Painter painter(show, look, "auto");
  const Image clear = painter.draw(frame, camera);
  std::vector<Puff> dust{{show.stage.building.center() - Vec3(0, 0, 0.1), 0.4, 0.3, 0.4}};
  const Image once = painter.draw(frame, camera, std::nullopt, dust), again = painter.draw(frame, camera, std::nullopt, dust);
  CHECK(once.rgb == again.rgb);
  CHECK(painter.draw(frame, camera).rgb == clear.rgb);
  dust[0].at = show.stage.building.center() + 0.8 * (camera.eye - show.stage.building.center()).normalized();  // before the house
  const Image before = painter.draw(frame, camera, std::nullopt, dust);
  int changed = 0, largest = 0;
  for (std::size_t i = 0; i < clear.rgb.size(); ++i) {
    const int way = std::abs(int(clear.rgb[i]) - int(before.rgb[i]));
    changed += way > 2 ? 1 : 0, largest = std::max(largest, way);
  }
  CHECK(changed > 300);
  CHECK(largest < 90);
}
