// Whole pictures: comparison with stored pictures, and properties that every picture must have.
#include "render/draw/draw.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/base/error.h"
#include "render/image/compare.h"
#include "render/movie/movie.h"
#include "render/movie/video.h"
#include "render/run/framing.h"
#include "tests/support/folder.h"
#include "tests/support/places.h"
#include "tests/support/text_of.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;
namespace fs = std::filesystem;

namespace {

using test::Folder;

const std::atomic<bool> go_on{false};

Movie stills(std::vector<double> times, int threads) {
  Movie movie;
  movie.look.width = 480;
  movie.look.height = 270;
  movie.stills = std::move(times);
  movie.quiet = movie.force = true;
  movie.threads = threads;
  return movie;
}

double dark_fraction(const Image& image) {
  std::size_t dark = 0;
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) dark += image.rgb[i] < 60 && image.rgb[i + 1] < 60 ? 1 : 0;
  return static_cast<double>(dark) / (static_cast<double>(image.rgb.size()) / 3);
}

}  // namespace

TEST_CASE("three frames look as they did, from any number of threads", "[render][image_regression]") {
  prepare_contexts();
  const Folder dir;
  write_brick_house(dir.path.string(), {});
  const Run run = read_run(dir.path.string());
  const MotionReader reader(dir.path.string());
  const std::vector<std::string> names{"corner_t0.400s.png", "corner_t1.900s.png", "corner_t2.500s.png"};
  REQUIRE(make_movie(run, reader, stills({0.4, 1.9, 2.5}, 1), go_on));
  std::vector<std::string> first;
  for (const std::string& name : names) first.push_back(test::text_of(dir.path / "frames" / name));
  REQUIRE(make_movie(run, reader, stills({0.4, 1.9, 2.5}, 3), go_on));
  for (std::size_t i = 0; i < names.size(); ++i) {
    INFO(names[i]);
    CHECK(test::text_of(dir.path / "frames" / names[i]) == first[i]);
    const fs::path stored = fs::path(test::in_source("")) / "tests/image" / ("brick_house_" + names[i]);
    // ERBS_WRITE_IMAGES=1 replaces the stored pictures; look at them before a commit.
    if (std::getenv("ERBS_WRITE_IMAGES")) fs::copy_file(dir.path / "frames" / names[i], stored, fs::copy_options::overwrite_existing);
    const Difference d = compare(read_png((dir.path / "frames" / names[i]).string()), read_png(stored.string()));
    INFO("failed pixels " << d.failed_fraction << ", SSIM " << d.ssim);
    CHECK(d.alike());
  }
}

TEST_CASE("both sources of OpenGL draw the same pixels", "[render][context]") {
  prepare_contexts();
  const MotionScene scene = brick_house({1.2, 1.2, 6, 1, 0.5});
  const MotionFrame frame = brick_house_frame(scene, 0);
  const Show show = prepare_show(scene, {}, {frame});
  Look look;
  look.width = 160, look.height = 120;
  const Camera camera = choose_cameras(show.stage, 4.0 / 3).front();
  std::vector<Image> images;
  for (const std::string kind : {"osmesa", "egl"}) {
    try {
      images.push_back(Painter(show, look, kind).draw(frame, camera));
    } catch (const Error& e) { WARN(kind << ": " << e.what()); }
  }
  REQUIRE_FALSE(images.empty());
  if (images.size() == 2) CHECK(compare(images[0], images[1]).alike());
}

TEST_CASE("broken joints are seen as dark lines, damage as colour", "[render][draw]") {
  prepare_contexts();
  const MotionScene scene = brick_house({1.525, 1.83, 13, 1, 0.5});
  MotionFrame frame = brick_house_frame(scene, 0);
  const Show show = prepare_show(scene, {}, {frame});
  Look look;
  look.width = 640, look.height = 360;
  const Camera camera = choose_cameras(show.stage, 16.0 / 9).front();
  Painter painter(show, look, "auto");
  const Image intact = painter.draw(frame, camera);
  std::fill(frame.damage.begin(), frame.damage.end(), 255);
  const Image closed = painter.draw(frame, camera);
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    if (!scene.blocks[b].fixed) frame.poses[7 * b + 2] += 0.02F * static_cast<float>(scene.blocks[b].rest.z());  // 2 mm per course
  const Image open = painter.draw(frame, camera);
  CHECK(dark_fraction(intact) < 0.001);
  CHECK(compare(intact, closed).failed_fraction > 0.01);  // a hairline crack is visible
  CHECK(dark_fraction(open) > 0.004);
  CHECK(dark_fraction(open) > 3 * dark_fraction(closed));  // an open crack is distinct from it
  look.coloring = Coloring::damage;
  const Image red = Painter(show, look, "auto").draw(frame, camera);
  double reddish = 0;
  for (std::size_t i = 0; i + 2 < red.rgb.size(); i += 3) reddish += red.rgb[i] > 2 * red.rgb[i + 1] ? 1 : 0;
  CHECK(reddish > 0.05 * static_cast<double>(red.rgb.size()) / 3);
}

TEST_CASE("a picture is the same whatever was drawn before it, and motion of a fiftieth of a pixel changes none", "[render][draw]") {
  prepare_contexts();
  const MotionScene scene = brick_house({1.525, 1.83, 13, 1, 0.5});
  const MotionFrame rest = brick_house_frame(scene, 0);
  const Show show = prepare_show(scene, {}, {rest});
  Look look;
  look.width = 320, look.height = 180;
  const Camera camera = choose_cameras(show.stage, 16.0 / 9).front();
  const auto moved = [&](double far) {  // m
    MotionFrame frame = rest;
    for (std::size_t b = 0; b < scene.blocks.size(); ++b)
      if (!scene.blocks[b].fixed) frame.poses[7 * b] += static_cast<float>(far * (b % 2 == 0 ? 1 : -1));
    return frame;
  };
  const std::vector<double> distances{1e-6, 2e-5, 1e-3, 0.02};
  std::vector<Image> alone;  // a painter at a time: each makes its context current
  for (const double far : distances) alone.push_back(Painter(show, look, "auto").draw(moved(far), camera));
  Painter painter(show, look, "auto");
  const Image at_rest = painter.draw(rest, camera);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    INFO(distances[i] << " m");
    const bool as_alone = painter.draw(moved(distances[i]), camera).rgb == alone[i].rgb;
    CHECK(as_alone);
    const bool as_at_rest = alone[i].rgb == at_rest.rgb;
    CHECK(as_at_rest == (distances[i] < 1e-4));
    const bool back = painter.draw(rest, camera).rgb == at_rest.rgb;
    CHECK(back);
  }
}

TEST_CASE("a video appears whole or not at all", "[render][video]") {
  const Folder dir;
  fs::create_directories(dir.path);
  const std::string path = (dir.path / "v.mp4").string();
  {
    Video video(path, 64, 64, 25);
    for (int i = 0; i < 5; ++i) video.add(Image(64, 64));
    CHECK_FALSE(fs::exists(path));
    video.finish();
  }
  CHECK(test::text_of(path).find("ftyp") == 4);
  const std::string other = (dir.path / "w.mp4").string();
  { Video video(other, 64, 64, 25); }
  CHECK(fs::is_empty(dir.path) == false);
  CHECK_FALSE(fs::exists(other));
  CHECK_FALSE(fs::exists(other + ".part"));
  CHECK_THROWS_AS(Video(other, 63, 64, 25), Error);
  const std::string repeated = (dir.path / "v.webp").string();
  {
    Video video(repeated, 63, 64, 25);
    Image image(63, 64);
    for (std::uint8_t i = 0; i < 5; ++i) {
      image.pixel(10 * i, 7)[0] = 255;  // frames that do not change are joined
      video.add(image);
    }
    video.finish();
  }
  const std::string file = test::text_of(repeated);
  CHECK(file.substr(0, 4) == "RIFF");
  CHECK(file.substr(8, 4) == "WEBP");
  std::size_t frames = 0;
  for (std::size_t at = file.find("ANMF"); at != std::string::npos; at = file.find("ANMF", at + 4)) ++frames;
  CHECK(frames == 5);
  const std::string search = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  CHECK_THROWS_WITH(Video(other, 64, 64, 25), Catch::Contains("install ffmpeg"));
  setenv("PATH", search.c_str(), 1);
}

TEST_CASE("nothing is written over without --force, and names are checked", "[render][movie]") {
  prepare_contexts();
  const Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 4, 0.2, 0.1});
  const Run run = read_run(dir.path.string());
  const MotionReader reader(dir.path.string());
  Movie movie = stills({0.1}, 1);
  movie.force = false;
  REQUIRE(make_movie(run, reader, movie, go_on));
  CHECK_THROWS_WITH(make_movie(run, reader, movie, go_on), Catch::Contains("--force"));
  movie.force = true;
  movie.stills = {0.1, 0.1002, 0.1002};
  REQUIRE(make_movie(run, reader, movie, go_on));
  CHECK(fs::exists(dir.path / "frames/corner_t0.1000s.png"));
  CHECK(fs::exists(dir.path / "frames/corner_t0.1002s.png"));
  // What cannot be made takes nothing away.
  Movie film = stills({}, 1);
  film.look.width = film.look.height = 65, film.video = true, film.force = true;
  std::ofstream(dir.path / "frames/corner_00001.png") << "of before";
  CHECK_THROWS_WITH(make_movie(run, reader, film, go_on), Catch::Contains("must be even"));
  CHECK(fs::exists(dir.path / "frames/corner_00001.png"));
  movie.stills = {0.1};
  movie.cameras = {"moon"};
  CHECK_THROWS_WITH(make_movie(run, reader, movie, go_on), Catch::Contains("corner"));
  const std::atomic<bool> stop{true};
  movie.cameras.clear();
  CHECK_FALSE(make_movie(run, reader, movie, stop));
}

TEST_CASE("colours show displacement, speed and opening on a scale of round numbers", "[render][draw]") {
  const Folder dir;
  fs::create_directories(dir.path);
  MotionScene scene;
  scene.blocks = {{"base", "", 0, true, Vec3::Zero(), {}}, {"a", "", 0, false, Vec3(1, 0, 0), {}}, {"b", "", 0, false, Vec3(2, 0, 0), {}}};
  scene.joints.resize(2);
  scene.joints[0].a = 0, scene.joints[0].b = 1, scene.joints[1].a = 1, scene.joints[1].b = 2;
  MotionWriter writer(dir.path.string(), scene);
  MotionFrame f{0, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0}, {0, 0}, {0, 0}, {}};
  writer.write(f);
  f.t = 0.5;
  f.poses[7] += 0.3F, f.poses[8] += 0.4F;                      // a moves by 0.5 m
  f.poses[17] = std::cos(0.1F), f.poses[20] = std::sin(0.1F);  // b turns by 0.2 rad
  f.opening = {0.001F, 0.003F};
  writer.write(f);
  writer.close();
  const MotionReader reader(dir.path.string());
  MotionFrame frame = reader.read(1);
  derive_speeds(reader, frame);
  CHECK(block_values(scene, frame, Coloring::displacement)[1] == Approx(0.5));
  CHECK(block_values(scene, frame, Coloring::displacement)[2] == 0);
  CHECK(block_values(scene, frame, Coloring::speed)[1] == Approx(1));
  CHECK(block_values(scene, frame, Coloring::opening)[1] == Approx(0.003));
  CHECK(block_values(scene, frame, Coloring::opening)[0] == Approx(0.001));
  CHECK(color_scale(scene, {frame}, Coloring::displacement) == Approx(0.5));
  CHECK(color_scale(scene, {frame}, Coloring::opening) == Approx(0.005));
  CHECK(color_scale(scene, {}, Coloring::displacement) == 1e-6);  // nothing moves
  MotionFrame far = frame;
  far.poses[9] -= 1000;  // falls past the ground for ever
  const Eigen::AlignedBox3d seen(Vec3::Constant(-10), Vec3::Constant(10));
  CHECK(color_scale(scene, {frame, far}, Coloring::displacement, seen) == Approx(0.5));
  magnify(scene, 10, frame);
  CHECK(frame.poses[7] == Approx(4));
  CHECK(frame.poses[17] == Approx(std::cos(1.0)));
  CHECK(frame.poses[20] == Approx(std::sin(1.0)));
  CHECK(frame.poses[3] == 1);
  // Even steps of the map are even steps of lightness: Y of linear sRGB rises all along.
  const auto luminance = [](double share) { return map_color(share).dot(Vec3(0.2126, 0.7152, 0.0722)); };
  for (int i = 0; i < 20; ++i) CHECK(luminance((i + 1) / 20.0) > luminance(i / 20.0));
}

TEST_CASE("between two recorded frames, blocks move on a straight line and turn evenly", "[render][schedule]") {
  const Folder dir;
  fs::create_directories(dir.path);
  MotionScene scene;
  scene.blocks = {{"a", "", 0, false, Vec3::Zero(), {}}};
  MotionWriter writer(dir.path.string(), scene);
  writer.write({0, {0, 0, 0, 1, 0, 0, 0}, {}, {}});
  const float h = std::sqrt(0.5F);
  writer.write({1, {2, 0, 4, h, 0, 0, h}, {}, {}});  // a quarter rotation about z
  writer.close();
  const MotionFrame f = frame_at(MotionReader(dir.path.string()), 0.5);
  CHECK(f.poses[0] == Approx(1));
  CHECK(f.poses[2] == Approx(2));
  CHECK(f.poses[3] == Approx(std::cos(3.14159265 / 8)));
  CHECK(f.poses[6] == Approx(std::sin(3.14159265 / 8)));
}
