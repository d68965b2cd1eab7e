#include "render/run/camera_points.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "render/run/stage.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// Where the renderer draws a point.
MarkedPoint seen(const Camera& camera, const Vec3& at, int width, int height) {
  const View view = look(camera, Stage{}, width, height, 0, 0);
  const Eigen::Vector4d p = view.projection.cast<double>() * (view.view.cast<double>() * at.homogeneous());
  return {at, (0.5 + 0.5 * p.x() / p.w()) * width, (0.5 - 0.5 * p.y() / p.w()) * height};
}

double angle_between(const Camera& a, const Camera& b) {
  return std::acos(std::min(1.0, (a.target - a.eye).normalized().dot((b.target - b.eye).normalized()))) * 180 / pi;
}

}  // namespace

TEST_CASE("a camera is found again from marked points", "[render][points]") {
  const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {0, 0, 3}, {2, 1.5, 3}, {2, 1.5, 0}, {0, 1.5, 3}};
  std::mt19937 random(1);
  std::normal_distribution<double> error(0, 0.3);  // px, a hand that marks well
  for (const std::size_t count : {4, 6})
    for (const double turn : {0.0, 7.0, 40.0, 120.0, -95.0})
      for (const double fov : {20.0, 31.0, 55.0}) {
        CAPTURE(count, turn, fov);
        Camera camera;
        const double azimuth = (turn - 60) * pi / 180;
        camera.target = {1, 0.7, 1.4}, camera.eye = camera.target + 7 * Vec3(std::cos(azimuth), std::sin(azimuth), 0.35);
        camera.fov = fov * pi / 180;
        std::vector<MarkedPoint> points, marked;
        for (std::size_t i = 0; i < count; ++i) {
          points.push_back(seen(camera, corners[i], 1280, 720));
          marked.push_back({corners[i], points[i].u + error(random), points[i].v + error(random)});
        }
        const FoundCamera free = camera_from(points, 1280, 720, std::nullopt), known = camera_from(marked, 1280, 720, camera.fov);
        CHECK(free.residual < 0.01);
        CHECK(angle_between(free.camera, camera) < 0.1);
        CHECK(free.camera.fov == Approx(camera.fov).epsilon(0.01));
        CHECK(known.residual < 1);
        CHECK(angle_between(known.camera, camera) < 1);
        CHECK((known.camera.eye - camera.eye).norm() < 0.02 * 7);
      }
}

TEST_CASE("marked points are read whole or refused", "[render][points]") {
  const std::vector<MarkedPoint> points = marked_points("0,0,0:10,20; 1,0,0:30.5,20;0,1,0:10,40;0,0,1:5,6;");
  REQUIRE(points.size() == 4);
  CHECK(points[1].u == 30.5);
  CHECK(points[3].at.z() == 1);
  for (const char* bad : {"", "0,0,0:1,2", "0,0,0:1,2;1,0,0:3,4;0,1:5,6;0,0,1:7,8", "0,0,0:1,2;1,0,0:3,4;0,1,0:5,x;0,0,1:7,8",
                          "0,0,0:1,2;1,0,0:3,4;0,1,0:5,6,7;0,0,1:7,8"})
    CHECK_THROWS_WITH(marked_points(bad), Catch::Contains("--points"));
  std::vector<MarkedPoint> line;
  for (int i = 0; i < 4; ++i) line.push_back({{double(i), 0, 0}, 10.0 * i, 0});
  CHECK_THROWS_WITH(camera_from(line, 640, 360, std::nullopt), Catch::Contains("one line"));
}
