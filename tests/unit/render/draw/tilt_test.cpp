// Tilting tests are drawn level: gravity of the run, position of the table, and the picture; backgrounds of pictures.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/units.h"
#include "engine/base/vec.h"
#include "render/image/text.h"
#include "render/movie/movie.h"
#include "render/run/framing.h"
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

// The picture at 0.1 s of the run in this folder, 320 x 180 without overlay; `change` makes it a special one.
template <class Change>
Image picture(const test::Folder& dir, Change&& change) {
  Movie movie;
  movie.look.width = 320, movie.look.height = 180;
  movie.look.overlay = false;
  movie.stills = {0.1};
  movie.quiet = movie.force = true;
  change(movie);
  const MotionReader reader(dir.path.string());
  REQUIRE(make_movie(read_run(dir.path.string()), reader, movie, std::atomic<bool>{false}));
  const std::filesystem::path file = std::filesystem::directory_iterator(dir.path / "frames")->path();
  Image image = read_png(file.string());
  std::filesystem::remove(file);
  return image;
}

bool is_brick(const std::uint8_t* p) { return p[0] > 1.3 * p[1]; }

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
  std::ofstream(dir.file("curve.csv")) << "multiplier_tan,displacement_m\n0,0\n0.1,0\n";  // two states; what follows is the fall
  CHECK(read_run(dir.path.string()).tilt.peak < 0.9 * run.tilt.peak);
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

TEST_CASE("what slides down a tilting ground stays on the plate that is drawn", "[render][stage]") {
  const MotionScene scene = brick_house({1.2, 1.2, 4, 0.2, 0.1});
  MotionFrame last = brick_house_frame(scene, 0);
  float* brick = &last.poses[7 * (scene.blocks.size() - 1)];
  brick[0] = 8, brick[2] = 0.05F;  // the ground reaches to 10 m
  const Stage stage = set_stage(scene, {brick_house_frame(scene, 0), last});
  CHECK(stage.table.contains(Vec3(8.1, brick[1], stage.ground_z)));
  CHECK(stage.table.max().x() < 10.001);
}

TEST_CASE("default cameras look at the upper side of a table, however it tilts", "[render][stage]") {
  const MotionScene scene = brick_house({1.2, 1.2, 4, 0.2, 0.1});
  const MotionFrame frame = brick_house_frame(scene, 0);
  for (int direction = 0; direction < 12; ++direction)
    for (const double angle : {0.1, 0.4, 0.8}) {
      const double around = direction * pi / 6;
      const Mat3 level = rotation(angle * Vec3(std::cos(around), std::sin(around), 0)).toRotationMatrix();
      Stage stage = set_stage(scene, {frame});
      turn_table(stage, scene, {frame, frame}, {Mat3::Identity(), level});
      CAPTURE(around, angle);
      for (const Camera& camera : choose_cameras(stage, 16.0 / 9)) CHECK((camera.eye - camera.target).normalized().dot(level.col(2)) > 0.2);
    }
}

TEST_CASE("below a table that blocks fall past no floor is drawn", "[render][stage]") {
  prepare_contexts();
  const MotionScene scene = brick_house({1.2, 1.2, 4, 0.2, 0.1});
  MotionFrame last = brick_house_frame(scene, 0);
  float* brick = &last.poses[7 * (scene.blocks.size() - 1)];
  const double fallen = GENERATE(0.0, 0.5, 4.0);
  if (fallen > 0) brick[0] = 10.5F, brick[2] = static_cast<float>(-fallen);  // beyond the edge of the ground
  const Mat3 level = rotation(Vec3(0, 0.1, 0)).toRotationMatrix();
  Stage stage = set_stage(scene, {brick_house_frame(scene, 0), last});
  turn_table(stage, scene, {last}, {level});
  REQUIRE(stage.positions.size() == 1);
  CHECK(stage.floor == (fallen == 0));
  Look l;
  l.width = 160, l.height = 90;
  const Run run;
  const Show show = prepare_show(scene, run, stage, {}, std::nullopt);
  Camera camera;
  camera.eye = Vec3(0, -30, 4), camera.target = Vec3(0, 0, 4), camera.fov = 1;
  const Image image = Painter(show, l, "auto").draw(last, camera, level);
  const int horizon = *image.pixel(2, 44), foot = *image.pixel(2, 89);
  INFO(horizon << " " << foot);
  if (stage.floor) CHECK(foot < horizon - 10);
  else CHECK(std::abs(foot - horizon) < 4);
}

TEST_CASE("a level ground that blocks fall past is drawn as far as it reaches", "[render][stage]") {
  prepare_contexts();
  const MotionScene scene = brick_house({1.2, 1.2, 4, 0.2, 0.1});
  MotionFrame last = brick_house_frame(scene, 0);
  float* brick = &last.poses[7 * (scene.blocks.size() - 1)];
  const auto [beside, fallen] = GENERATE(std::pair{10.5F, 0.0F}, std::pair{10.5F, 0.5F}, std::pair{10.5F, 400.0F}, std::pair{3.0F, 0.5F});
  if (fallen > 0)
    brick[0] = beside, brick[1] = 0, brick[2] = -fallen;  // the ground reaches to 10 m; at 3 m it hides what was driven into it
  Stage stage = set_stage(scene, {brick_house_frame(scene, 0), last});
  bound_ground(stage, scene, {last});
  CHECK(stage.bounded == (fallen > 0 && beside > 10));
  Look l;
  l.width = 160, l.height = 90;
  Run run;
  run.materials = {{"brick", Vec3(0.5, 0.15, 0.08), 0}};
  const Show show = prepare_show(scene, run, stage, {}, std::nullopt);
  Camera camera;
  camera.eye = Vec3(18, 0, 3), camera.target = Vec3(10.5, 0, -0.5), camera.fov = 0.3;  // at the place where the brick is to be seen
  const Image image = Painter(show, l, "auto").draw(last, camera, levelling_at(run, stage, l, 0));
  std::size_t bricks = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) bricks += is_brick(image.pixel(x, y));
  INFO(bricks);
  if (beside > 10 && fallen == 0.5F) CHECK(bricks > 8);
  else CHECK(bricks == 0);
}

TEST_CASE("a tilting test is drawn tilting, or from a camera that stays level with its table", "[render][draw]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  const Image upright = picture(dir, [](Movie&) {});
  std::ofstream(dir.file("histories.csv")) << turning(Vec3(0, 1, 0), 0);
  CHECK(picture(dir, [](Movie&) {}).rgb == upright.rgb);  // a table that never leans is no tilting test
  const double angle = GENERATE(0.6, -0.6);
  std::ofstream(dir.file("histories.csv")) << turning(Vec3(0, 1, 0), angle);
  CHECK(picture(dir, [](Movie& movie) { movie.look.table_turns = false; }).rgb == upright.rgb);
  // Gravity leans to -x for a positive angle. From -y, x points right: the left end of the house, which is wider than high, goes down.
  const Image turned = picture(dir, [](Movie& movie) { movie.cameras = {"from_-y"}; });
  std::vector<std::pair<int, int>> bricks;
  for (int x = 0; x < turned.width; ++x)
    for (int y = 0; y < turned.height; ++y)
      if (is_brick(turned.pixel(x, y))) bricks.emplace_back(x, y);
  REQUIRE(bricks.size() > 500);
  const auto mean_y = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += bricks[i].second;
    return sum / double(to - from);
  };
  const std::size_t third = bricks.size() / 3;
  const double lower = mean_y(0, third) - mean_y(2 * third, bricks.size());  // rows count from the top
  INFO(lower);
  CHECK(lower * angle > 0);
  CHECK(std::abs(lower) > 5);  // pixels
}

TEST_CASE("the underside of a table lies in its own shadow", "[render][draw]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  std::ofstream(dir.file("histories.csv")) << turning(Vec3(1, 0, 0), 0.02);
  const Image image = picture(dir, [](Movie& movie) { movie.eye = Vec3(0, 0, -8), movie.target = Vec3::Zero(), movie.fov = 4; });
  const auto [least, most] = std::minmax_element(image.rgb.begin(), image.rgb.end());
  INFO(int(*least) << " " << int(*most));
  CHECK(*most - *least < 20);  // neither bricks nor their shadow; the grey itself is tinted
}

TEST_CASE("a white background is white where nothing stands", "[render][draw]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  const Image image = picture(dir, [](Movie& movie) { movie.look.background = Background::white; });
  std::size_t paper = 0, bricks = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      paper += std::min({p[0], p[1], p[2]}) >= 250;
      bricks += is_brick(p);
    }
  for (const auto& [x, y] : {std::pair{0, 0}, {319, 0}, {160, 2}}) CHECK(int(*image.pixel(x, y)) == 255);
  CHECK(paper > image.rgb.size() / 3 / 3);  // sky, and the ground in the sun
  CHECK(bricks > image.rgb.size() / 3 / 50);
}

TEST_CASE("a transparent background holds blocks and their shadow alone", "[render][draw]") {
  prepare_contexts();
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  const double magnified = GENERATE(1.0, 3.0);
  const Image clear = picture(dir, [&](Movie& movie) {
    movie.look.background = Background::transparent;
    movie.look.magnify = magnified;
  });
  const Image paper = picture(dir, [&](Movie& movie) {
    movie.look.background = Background::white;
    movie.look.magnify = magnified;
  });
  REQUIRE(clear.channels == 4);
  REQUIRE(paper.channels == 3);
  std::size_t nothing = 0, shadow = 0, bricks = 0, other = 0;
  for (int y = 0; y < clear.height; ++y)
    for (int x = 0; x < clear.width; ++x) {
      const std::uint8_t *p = clear.pixel(x, y), *q = paper.pixel(x, y);
      nothing += p[3] == 0;
      shadow += p[3] > 60 && p[3] < 120 && p[0] + p[1] + p[2] == 0;  // black, about a third
      if (p[3] < 255) continue;
      ++bricks;
      other += !std::equal(p, p + 3, q);
    }
  const std::size_t all = static_cast<std::size_t>(clear.width * clear.height);
  CHECK(nothing > all / 3);
  CHECK(shadow > all / 200);
  CHECK(bricks > all / 50);
  CHECK(other == 0);  // blocks have the colours that they have on paper
  CHECK(int(clear.pixel(0, 0)[3]) == 0);
}

TEST_CASE("text on a transparent picture is as dense as its ink", "[render][text]") {
  Image image(20, 20, 4);
  fill_box(image, 0, 0, 20, 20, {200, 100, 50, 0.5});
  CHECK(int(image.pixel(3, 3)[0]) == 200);
  CHECK(int(image.pixel(3, 3)[3]) == 128);
  fill_box(image, 0, 0, 20, 20, {0, 0, 0, 0.5});  // over it: 0.75 in all, two thirds of it black
  CHECK(int(image.pixel(3, 3)[0]) == 67);
  CHECK(int(image.pixel(3, 3)[3]) == 192);
  const test::Folder dir;
  write_png(dir.file("a.png"), image);
  const Image again = read_png(dir.file("a.png"));
  CHECK(again.channels == 4);
  CHECK(again.rgb == image.rgb);
}
