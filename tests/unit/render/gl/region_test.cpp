// Which part of a picture is touched.
#include "render/gl/region.h"

#include <catch2/catch.hpp>
#include <random>

#include "render/run/stage.h"

using namespace erbs;
using namespace erbs::render;

namespace {

Stage unit_stage() {
  Stage stage;
  stage.building = stage.reach = Eigen::AlignedBox3d(Vec3(-1, -1, 0), Vec3(1, 1, 2));
  return stage;
}

}  // namespace

TEST_CASE("a region holds every point of its spheres, and little more", "[render][region]") {
  const Stage stage = unit_stage();
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> size(0.01F, 0.5F);
  Camera camera;
  camera.eye = Vec3(5, -6, 3), camera.target = Vec3(0, 0, 1), camera.fov = 0.7;
  for (const auto& [top, bottom] : {std::pair{0.0, 0.0}, {58.0, 102.0}}) {
    const View v = look(camera, stage, 1280, 720, top, bottom);
    for (int k = 0; k < 100; ++k) {
      const Sphere s{Eigen::Vector3f{normal(random), normal(random), normal(random)}, size(random)};
      const Region r = region_of({s}, v.view, v.projection, 1280, 720, 0);
      Eigen::AlignedBox2f seen;
      for (int i = 0; i < 400; ++i) {
        const Eigen::Vector3f out = Eigen::Vector3f{normal(random), normal(random), normal(random)}.normalized();
        const Eigen::Vector4f c = v.projection * v.view * Eigen::Vector3f(s.middle + s.radius * out).homogeneous();
        seen.extend(Eigen::Vector2f(640 * (1 + c.x() / c.w()), 360 * (1 + c.y() / c.w())));
      }
      const auto inside = [](float x, int low, int high, int most) {
        return (x >= float(low) || low == 0) && (x <= float(high) || high == most);
      };
      CHECK(inside(seen.min().x(), r.left, r.right, 1280));
      CHECK(inside(seen.max().x(), r.left, r.right, 1280));
      CHECK(inside(seen.min().y(), r.bottom, r.top, 720));
      CHECK(inside(seen.max().y(), r.bottom, r.top, 720));
      const bool within = r.left > 0 && r.bottom > 0 && r.right < 1280 && r.top < 720;
      if (within) CHECK(float(r.width()) < 1.1F * seen.sizes().x() + 6);
    }
  }
}

TEST_CASE("a sphere about the eye may cover the whole picture, one behind it covers none", "[render][region]") {
  Camera camera;
  camera.eye = Vec3(5, 0, 1), camera.target = Vec3(0, 0, 1);
  const View v = look(camera, unit_stage(), 640, 360, 0, 0);
  const Region about = region_of({{Eigen::Vector3f(5, 0, 1), 0.5F}}, v.view, v.projection, 640, 360, 3);
  CHECK((about.width() == 640 && about.height() == 360));
  CHECK(region_of({{Eigen::Vector3f(9, 0, 1), 0.5F}}, v.view, v.projection, 640, 360, 3).empty());
  CHECK(region_of({}, v.view, v.projection, 640, 360, 3).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(region_of({{Eigen::Vector3f(nan, 0, 1), 0.5F}}, v.view, v.projection, 640, 360, 3).empty());
  CHECK(nearest_of({{Eigen::Vector3f(1, 0, 1), 0.5F}, {Eigen::Vector3f(nan, 0, 1), 0.5F}}, v.view, v.projection) == Approx(3.5));
}

TEST_CASE("the sky begins at the horizon of the picture", "[render][region]") {
  Camera camera;
  camera.eye = Vec3(5, 0, 1), camera.target = Vec3(0, 0, 1);  // level: the horizon is the middle row
  const View v = look(camera, unit_stage(), 640, 360, 0, 0);
  const Eigen::Matrix4f to_world = (v.projection * v.view).inverse();
  const Region sky = rising(to_world, v.eye, Eigen::Vector3f::UnitZ(), 640, 360);
  CHECK(std::abs(sky.bottom - 180) <= 2);
  CHECK((sky.top == 360 && sky.left == 0 && sky.right == 640));
  camera.target = Vec3(4.9, 0, 0);  // almost straight down
  const View down = look(camera, unit_stage(), 640, 360, 0, 0);
  CHECK(rising((down.projection * down.view).inverse(), down.eye, Eigen::Vector3f::UnitZ(), 640, 360).empty());
}

TEST_CASE("the shadow of a sphere lies where the sun throws it", "[render][region]") {
  const Eigen::Vector3f sun(0.6F, 0, 0.8F);
  const std::vector<Sphere> shadow = fallen_shadows({{Eigen::Vector3f(1, 2, 4.5F), 1}}, sun, 0.5);
  CHECK(shadow[0].middle.x() == Approx(1 - 4 * 0.75));
  CHECK(shadow[0].middle.y() == Approx(2));
  CHECK(shadow[0].middle.z() == Approx(0.5));
  CHECK(shadow[0].radius == Approx(1.25));  // the long half axis of its ellipse
}

TEST_CASE("a region shrinks only where it does not reach the border of the picture", "[render][region]") {
  const Region r = inset({0, 20, 90, 60}, 5, 100, 60);
  CHECK((r.left == 0 && r.bottom == 25 && r.right == 85 && r.top == 60));
}
