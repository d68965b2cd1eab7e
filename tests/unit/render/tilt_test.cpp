// Tilting tests are drawn level: gravity of the run, position of the table, and the picture.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/units.h"
#include "engine/base/vec.h"
#include "render/image/compare.h"
#include "render/movie/movie.h"
#include "tests/support/folder.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// Rows of a histories.csv in which gravity turns evenly about the axis, by `angle` (rad) in 0.2 s.
std::string turning(const Vec3& axis, double angle) {
  std::string rows = "time_s,gravity_ax_m_s2,gravity_ay_m_s2,gravity_az_m_s2\n";
  for (int i = 0; i <= 20; ++i) {
    const Vec3 g = rotation(angle * i / 20 * axis.normalized()) * Vec3(0, 0, -standard_g);
    rows += fmt::format("{},{},{},{}\n", 0.01 * i, g.x(), g.y(), g.z());
  }
  return rows;
}

}  // namespace

TEST_CASE("the tilt of a run has the axis, the sign and the angle of its scene", "[render][run]") {
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  CHECK(read_run(dir.path.string()).gravity.empty());
  const auto axis = GENERATE(Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, -1, 0));
  const double angle = GENERATE(0.3, -0.5, 1.2);
  std::ofstream(dir.file("histories.csv")) << turning(axis, angle);
  const Run run = read_run(dir.path.string());
  CHECK(run.record.axis.empty());
  CHECK(&run.strip() == &run.tilt);
  CHECK((run.tilt.direction - axis.normalized()).norm() < 1e-6);
  CHECK(run.tilt.a.back() == Approx(angle * 180 / pi));
  CHECK(run.tilt.peak == Approx(std::abs(angle) * 180 / pi));
  for (const double t : {-1.0, 0.0, 0.07, 0.143, 5.0}) {
    const Vec3 down = levelling(run.gravity, t) * gravity_at(run.gravity, t);
    CHECK(down.head<2>().norm() < 1e-9);
    CHECK(down.z() == Approx(-standard_g).epsilon(1e-3));
  }
}

TEST_CASE("a table rests on its lowest edge, and the camera sees it turn", "[render][stage]") {
  const Stage stage = set_stage(brick_house({}), {});
  CHECK(stage.on_ground);
  CHECK(stage.table.max().z() == stage.ground_z);
  CHECK(stage.table.contains(Vec3(stage.building.min().x(), stage.building.min().y(), stage.ground_z)));
  CHECK(table_position(stage, Mat3::Identity()).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  Camera camera;
  camera.eye = Vec3(9, -12, 5), camera.target = Vec3(0.3, 0.2, 1);
  for (const double angle : {-0.6, 0.1, 0.9}) {
    const Eigen::Isometry3d position = table_position(stage, rotation(angle * Vec3(0.6, 0.8, 0)).toRotationMatrix());
    double lowest = HUGE_VAL;
    for (int i = 0; i < 8; ++i) lowest = std::min(lowest, (position * stage.table.corner(Eigen::AlignedBox3d::CornerType(i))).z());
    CHECK(lowest == Approx(stage.table.min().z()));
    const View level = look(camera, stage, 640, 360, 0, 0), seen = look(in_scene(camera, position), stage, 640, 360, 0, 0);
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, -2, 0.5), Vec3(-0.3, 0.7, 2)}) {
      const Eigen::Vector4f one = level.view * (position * p).cast<float>().homogeneous(), two = seen.view * p.cast<float>().homogeneous();
      CHECK((one - two).norm() < 1e-4F);
    }
  }
}

TEST_CASE("a tilting test is drawn tilting, or from a camera that stays level with its table", "[render][draw]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  const MotionReader reader(dir.path.string());
  const auto drawn = [&](const char* name, bool table_turns) {
    Movie movie;
    movie.look.width = 320, movie.look.height = 180;
    movie.look.overlay = false, movie.look.table_turns = table_turns;
    movie.stills = {0.1};
    movie.quiet = movie.force = true;
    REQUIRE(make_movie(read_run(dir.path.string()), reader, movie, std::atomic<bool>{false}));
    for (const auto& file : std::filesystem::directory_iterator(dir.path / "frames")) {
      const Image image = read_png(file.path().string());
      std::filesystem::remove(file.path());
      return image;
    }
    FAIL(name);
    return Image(1, 1);
  };
  const Image upright = drawn("upright", true);
  std::ofstream(dir.file("histories.csv")) << turning(Vec3(0, 1, 0), 0.6);
  CHECK(drawn("camera", false).rgb == upright.rgb);
  CHECK(drawn("table", true).rgb != upright.rgb);
}

TEST_CASE("a white background is white where nothing stands", "[render][draw]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  const MotionReader reader(dir.path.string());
  Movie movie;
  movie.look.width = 320, movie.look.height = 180;
  movie.look.overlay = false, movie.look.white = true;
  movie.stills = {0.1};
  movie.quiet = movie.force = true;
  REQUIRE(make_movie(read_run(dir.path.string()), reader, movie, std::atomic<bool>{false}));
  const Image image = read_png(std::filesystem::directory_iterator(dir.path / "frames")->path().string());
  std::size_t paper = 0, dark = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const int least = std::min({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
    paper += least >= 250;
    dark += least < 120;
  }
  for (const auto& [x, y] : {std::pair{0, 0}, {319, 0}, {160, 2}}) CHECK(int(*image.pixel(x, y)) == 255);
  CHECK(paper > image.rgb.size() / 3 / 3);  // sky, and the ground in the sun
  CHECK(dark > image.rgb.size() / 3 / 50);  // the bricks
}
