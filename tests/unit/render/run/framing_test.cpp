// Cameras that --fit places: all that is drawn is in the picture, and fills it.
#include "render/run/framing.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "render/movie/movie.h"
#include "tests/support/folder.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// Pixels free on each side of the bricks in the pictures of the run in this folder, which `change` makes special ones; the least of all.
struct Free {
  int left, right, below, above;
  int least() const { return std::min({left, right, below, above}); }
};
template <class Change>
Free free_around(const test::Folder& dir, int width, int height, Change&& change) {
  Movie movie;
  movie.look.width = width, movie.look.height = height;
  movie.look.overlay = false;
  movie.fit = movie.quiet = movie.force = true;
  change(movie);
  const MotionReader reader(dir.path.string());
  REQUIRE(make_movie(read_run(dir.path.string()), reader, movie, std::atomic<bool>{false}));
  Free free{width, width, height, height};
  for (const auto& file : std::filesystem::directory_iterator(dir.path / "frames")) {
    const Image image = read_png(file.path().string());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (const std::uint8_t* p = image.pixel(x, y); p[0] > 1.3 * p[1])
          free = {std::min(free.left, x), std::min(free.right, width - 1 - x), std::min(free.below, height - 1 - y),
                  std::min(free.above, y)};
  }
  std::filesystem::remove_all(dir.path / "frames");
  return free;
}

// Nothing cut off, and of one side at most a twentieth left free, of the smaller side of the picture.
void check_filled(const Free& free, int width, int height) {
  INFO(free.left << " " << free.right << " " << free.below << " " << free.above << " of " << width << " x " << height);
  const double twentieth = 0.05 * std::min(width, height);
  CHECK(free.least() > 0);
  CHECK(std::min(free.left + free.right, free.below + free.above) <= twentieth);
}

}  // namespace

TEST_CASE("the option --fit fills pictures of any shape with what is drawn, from any direction", "[render][camera]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.6, 6, 3, 0.1});
  const auto [width, height] = GENERATE(std::pair{480, 270}, std::pair{240, 400}, std::pair{600, 160});
  for (const char* camera : {"corner", "side", "from_-y", "from_above"})
    for (const double t : {0.0, 3.0}) {
      INFO(camera << " " << t);
      check_filled(free_around(dir, width, height, [&](Movie& m) { m.cameras = {camera}, m.stills = {t}; }), width, height);
    }
  for (const double fov : {5.0, 45.0, 75.0}) {
    INFO(fov);
    check_filled(
        free_around(dir, width, height, [&](Movie& m) { m.eye = Vec3(1, -2, 3), m.target = Vec3(3, 0, 0), m.fov = fov, m.stills = {0}; }),
        width, height);
  }
}

TEST_CASE("the option --fit goes by what is hidden, cut, magnified or moves", "[render][camera]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.6, 40, 3, 0.1});
  const int width = 400, height = 300;
  check_filled(free_around(dir, width, height, [](Movie& m) { m.stills = {0.0, 2.4, 3.0}; }), width, height);
  check_filled(free_around(dir, width, height, [](Movie& m) { m.section = read_section("z<1"), m.stills = {0}; }), width, height);
  check_filled(free_around(dir, width, height, [](Movie& m) { m.look.magnify = 20, m.stills = {0.3}; }), width, height);
  check_filled(free_around(dir, width, height,
                           [](Movie& m) {
                             m.video = false, m.frames = "7";
                             m.cameras = {"side"};
                           }),
               width, height);
}

TEST_CASE("the option --fit leaves out what has been thrown far away, and keeps all the rest", "[render][camera]") {
  const double far = GENERATE(0.5, 2.0, 50.0);
  const MotionScene scene = brick_house({1.2, 1.2, 8, 1, 0.5});
  MotionFrame last = brick_house_frame(scene, 0);
  for (std::size_t b = 0; b < scene.blocks.size(); b += 12)
    if (!scene.blocks[b].fixed) last.poses[7 * b] += static_cast<float>(far), last.poses[7 * b + 2] = 0.05F;
  const Stage stage = set_stage(scene, {brick_house_frame(scene, 0), last});
  Camera camera = choose_cameras(stage, 16.0 / 9).front();
  Framing framing(camera, camera.eye - camera.target, stage, 16.0 / 9, 0.02);
  const std::vector<Vec3> corners = visible_corners(scene, stage, last);
  std::size_t loose = 0;
  for (const MotionBlock& block : scene.blocks) loose += !block.fixed;
  CHECK((corners.size() == 8 * loose) == (far < 10));
  for (const Vec3& corner : corners) framing.add(corner);
  camera = framing.camera();
  const View view = look(camera, stage, 1280, 720, 0, 0);
  const Eigen::Matrix4f to_clip = view.projection * view.view;
  Eigen::AlignedBox2f shown;
  for (const Vec3& corner : corners)
    shown.extend(Eigen::Vector4f(to_clip * corner.cast<float>().homogeneous()).hnormalized().head<2>().eval());
  CHECK(shown.min().minCoeff() > -0.979F);
  CHECK(shown.max().maxCoeff() < 0.979F);
  const float spare_x = 0.04F * 9 / 16, spare_y = 0.04F;
  CHECK((shown.sizes().x() == Approx(2 - 2 * spare_x).margin(1e-4) || shown.sizes().y() == Approx(2 - 2 * spare_y).margin(1e-4)));
  CHECK(shown.center().norm() < 1e-4F);
}
