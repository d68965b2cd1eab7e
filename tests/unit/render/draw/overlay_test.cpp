// The overlay of pictures: its panels are filled by what they show.
#include "render/draw/overlay.h"

#include <catch2/catch.hpp>

#include "engine/base/units.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// Rows and columns (px) of the pixels of which `is` holds.
template <class Is>
Eigen::AlignedBox2i where(const Image& image, Is&& is) {
  Eigen::AlignedBox2i box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (is(image.pixel(x, y))) box.extend(Eigen::Vector2i(x, y));
  return box;
}

struct Overlaid {
  MotionScene scene = brick_house({1.2, 1.2, 4, 1, 0.5});
  Run run;
  // The overlay over black, from the camera "corner".
  Image draw(double t) const {
    const Show show = prepare_show(scene, run, {brick_house_frame(scene, 0)});
    Look l;
    l.top = overlay_top(l.width, l.height), l.bottom = overlay_bottom(l.width, l.height, !run.strip().axis.empty());
    Camera camera;
    camera.eye = Vec3(3, -5, 2), camera.target = Vec3(0, 0, 0.3);
    Image image(l.width, l.height);
    Overlay(run, show, l, "corner", 1).draw(image, t, look(camera, show.stage, l.width, l.height, l.top, l.bottom), {});
    return image;
  }
};

}  // namespace

TEST_CASE("the strip is as high as its record, whether this has both signs or one", "[render][overlay]") {
  Overlaid s;
  const auto [low, high] = GENERATE(std::pair{-1.0, 1.0}, std::pair{0.0, 1.0}, std::pair{-1.0, 0.0}, std::pair{-0.2, 1.0});
  s.run.record.axis = "x", s.run.record.direction = Vec3::UnitX(), s.run.record.peak = standard_g;
  for (int i = 0; i <= 1000; ++i) {
    s.run.record.t.push_back(0.001 * i);
    s.run.record.a.push_back(standard_g * (0.5 * (low + high) + 0.5 * (high - low) * std::sin(0.1 * i)));
  }
  const Image image = s.draw(1);  // all is past, and drawn dark
  const Eigen::AlignedBox2i curve = where(image, [](const std::uint8_t* p) { return p[0] == 48 && p[1] == 60 && p[2] == 76; });
  INFO(curve.min().transpose() << " " << curve.max().transpose());
  CHECK(curve.sizes().y() >= 60);  // of 63 rows between the names of events and the times
  CHECK(curve.sizes().x() > 1000);
}

TEST_CASE("the panel of the axes is as large as they are", "[render][overlay]") {
  Overlaid s;
  if (GENERATE(false, true)) {
    s.run.record.axis = "y", s.run.record.direction = Vec3::UnitY(), s.run.record.peak = 1;
    s.run.record.t = {0, 1}, s.run.record.a = {0, 1};
  }
  Image image = s.draw(0);
  const double bottom = overlay_bottom(image.width, image.height, !s.run.strip().axis.empty());
  // Over black the panel is light grey, and arrows and letters are darker or red.
  Image corner(140, 130);
  for (int y = 0; y < corner.height; ++y)
    std::copy_n(image.pixel(0, image.height - static_cast<int>(bottom) - corner.height + y), 3 * corner.width, corner.pixel(0, y));
  const Eigen::AlignedBox2i panel = where(corner, [](const std::uint8_t* p) { return p[0] > 0; });
  const Eigen::AlignedBox2i ink = where(corner, [](const std::uint8_t* p) { return p[0] > 0 && p[1] < 160; });
  INFO(panel.min().transpose() << ", " << panel.max().transpose() << "; " << ink.min().transpose() << ", " << ink.max().transpose());
  REQUIRE(!panel.isEmpty());
  CHECK(panel.contains(ink));
  CHECK((ink.min() - panel.min()).maxCoeff() <= 12);
  CHECK((panel.max() - ink.max()).maxCoeff() <= 12);
}
