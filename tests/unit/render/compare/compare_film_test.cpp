// Measures of pictures, and a run against films of itself and of another run.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/system/process.h"
#include "engine/record/format/json.h"
#include "render/compare/compare_film.h"
#include "render/compare/films.h"
#include "render/image/measures.h"
#include "render/movie/film_reader.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// A textured square on white, its corner at (x, y).
Image square(int x, int y) {
  Image image(160, 120);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t(250));
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 40; ++i)
      for (int c = 0; c < 3; ++c) image.pixel(x + i, y + j)[c] = std::uint8_t(40 + (i * i * 7 + j * 31 + i * j * 3) % 97);
  return image;
}

// The pier of scenes/first.lua, which rocks and falls.
struct Films {
  lua::Bench bench;
  std::string run = (bench.folder / "pier").string();
  Films() { REQUIRE(bench.erbs({"run", test::in_source("/scenes/first.lua"), "-o", run, "-q", "--no-figures"}) == 0); }
  // A film of the run from `from` s on.
  std::string film(double from, const std::string& fps, const std::string& size, const char* overlay = "--no-overlay",
                   const std::string& slow = "1") const {
    const std::string renderer = test::in_build("/erbs-render"), span = std::to_string(from) + ":1.7";
    std::vector<std::string> words{renderer, run,      "--size", size,           "--fps", fps,      "--time",
                                   span,     "--slow", slow,     "--no-figures", "-q",    "--force"};
    if (*overlay) words.emplace_back(overlay);
    REQUIRE(wait_for(start(words, (bench.folder / "log").string())) == 0);
    for (const auto& entry : std::filesystem::directory_iterator(run))
      if (entry.path().extension() == ".mp4") {
        std::filesystem::rename(entry.path(), bench.folder / "film.mp4");
        return (bench.folder / "film.mp4").string();
      }
    return "";
  }
};

}  // namespace

TEST_CASE("motion and silhouettes of pictures are measured", "[render][compare]") {
  const Flow right = flow_between(gray_of(square(50, 40)), gray_of(square(54, 40))),
             up = flow_between(gray_of(square(50, 40)), gray_of(square(50, 37)));
  CHECK(std::atan2(right.y, right.x) == Approx(0).margin(0.3));
  CHECK(std::atan2(up.y, up.x) == Approx(std::acos(-1) / 2).margin(0.3));
  CHECK(angle_between(right, up) == Approx(90).margin(20));
  CHECK(std::isnan(angle_between(right, flow_between(gray_of(square(50, 40)), gray_of(square(50, 40))))));
  const Image background = row_medians(square(50, 40));
  CHECK(overlap(silhouette(square(50, 40), background), silhouette(square(50, 40), background)) == 1);
  CHECK(overlap(silhouette(square(50, 40), background), silhouette(square(60, 40), background)) == Approx(0.6));
  CHECK(reduced(square(50, 40), 4).width == 40);
  const std::vector<float> changes = changes_of_squares(gray_of(square(48, 40)), gray_of(square(56, 40)));
  REQUIRE(changes.size() == 20 * 15);
  CHECK(changes[5 * 20 + 6] > 50);  // the column of squares that the square leaves
  CHECK(changes[5 * 20 + 5] == 0);
  CHECK(difference_of(square(50, 40), square(50, 40)).pixel(60, 50)[0] == 245);
}

TEST_CASE("the shift of a film is found to half a picture, and its noise tells nothing apart", "[render][compare][program]") {
  Films films;
  for (const std::string fps : {"25", "40"}) {
    CAPTURE(fps);
    const std::string film = films.film(0.137, fps, "256x192"), place = (films.bench.folder / ("found" + fps)).string();
    const std::string limits =
        "shift<" + std::to_string(0.137 + 0.5 / std::stod(fps)) + ",shift>" + std::to_string(0.137 - 0.5 / std::stod(fps));
    CHECK(films.bench.erbs(
              {"compare", films.run, film, "-o", place, "--film-background", "drawn", "--expect", limits + ",iou>.8,ssim>.9"}) == 0);
    INFO(films.bench.said);
    CHECK(std::filesystem::exists(place + "/compare_side.mp4"));
    CHECK(read_json(place + "/compare.json")["passed"] == true);
  }
}

TEST_CASE("a film of the run itself has no lag, where long shadows move", "[render][compare][program]") {
  lua::Bench bench;
  REQUIRE(bench.run("material { name = 'stone', density = 2200 } ground { z = 0, size = 200, material = 'stone' }\n"
                    "joint { law = mortar { E = 2*GPa, thickness = 0.02, ft = 0.2*MPa, c = 0.3*MPa, mu = 0.7 }, thickness = 0.02 }\n"
                    "for i = 0, 19 do box { size = { 6, 6, 2.98 }, at = { 0, 0, 0.02 + 3 * i }, material = 'stone' } end\n"
                    "ground_motion { wave = sine { amplitude = 0.6 * g, frequency = 0.3 * Hz }, direction = 'x' }\n"
                    "analysis { duration = 8 }",
                    {"-q", "--no-figures"}) == 0);
  REQUIRE(bench.erbs({"render", bench.out(), "--size", "640x360", "--no-overlay", "--no-figures", "-q"}) == 0);
  std::string film;
  for (const auto& entry : std::filesystem::directory_iterator(bench.out()))
    if (entry.path().extension() == ".mp4") film = entry.path().string();
  CHECK(bench.erbs({"compare", bench.out(), film, "--film-background", "drawn", "--expect", "shift<.01,iou>.95"}) == 0);
  INFO(bench.said);
  CHECK(read_json(bench.out() + "/compare/frames.json")["frames_outside"] == 0);
}

TEST_CASE("a film in slow motion is recognised", "[render][compare][program]") {
  Films films;
  const std::string slow = GENERATE("2", "4", "1", "0.5");
  CAPTURE(slow);
  const std::string film = films.film(0, "25", "256x192", "--no-overlay", slow), place = (films.bench.folder / "found").string();
  CHECK(films.bench.erbs({"compare", films.run, film, "-o", place, "--film-background", "drawn"}) == 0);
  INFO(films.bench.said);
  const std::string wish = "with --slow " + slow + " by ";
  CHECK((films.bench.said.find(wish) != std::string::npos) == (slow != "1"));
  CHECK(films.bench.erbs({"compare", films.run, film, "-o", place + "_slow", "--film-background", "drawn", "--slow", slow, "--expect",
                          "iou>.9,shift<.02"}) == 0);
  CHECK(films.bench.said.find("doubtful") == std::string::npos);
}

TEST_CASE("a film whose shadows the run does not show has no lag either, whether or not its pictures are repeated",
          "[render][compare][program]") {
  Films films;
  const std::string film = films.film(0, "25", "320x180"), twice = (films.bench.folder / "twice.mp4").string(),
                    slow = (films.bench.folder / "slow.mp4").string(), place = (films.bench.folder / "place").string();
  const auto lag = [&] { return read_json(place + "/frames.json")["alignment"]["lag_s"].get<double>(); };
  CHECK(films.bench.erbs({"compare", films.run, film, "-o", place, "--expect", "iou>.95"}) == 0);
  CHECK(lag() == Approx(0).margin(0.004));
  // Each picture is shown once more, half a picture late in the mean.
  REQUIRE(wait_for(start({"ffmpeg", "-y", "-loglevel", "error", "-i", film, "-r", "50", twice})) == 0);
  CHECK(films.bench.erbs({"compare", films.run, twice, "-o", place, "--force"}) == 0);
  CHECK(lag() == Approx(-0.01).margin(0.004));
  INFO(films.bench.said);
  CHECK(films.bench.said.find("doubtful") == std::string::npos);
  REQUIRE(wait_for(start({"ffmpeg", "-y", "-loglevel", "error", "-i", film, "-vf", "setpts=4*PTS", "-r", "25", slow})) == 0);
  CHECK(films.bench.erbs({"compare", films.run, slow, "-o", place, "--force"}) == 0);
  CHECK(films.bench.said.find("with --slow 4 by ") != std::string::npos);
}

TEST_CASE("a run with another peak is told apart from noise of H.264", "[render][compare][program]") {
  Films films;
  const std::string film = films.film(0, "25", "256x192"), coarse = (films.bench.folder / "coarse.mp4").string();
  REQUIRE(wait_for(start({"ffmpeg", "-y", "-loglevel", "error", "-i", film, "-c:v", "libx264", "-crf", "28", coarse})) == 0);
  const std::string stronger = (films.bench.folder / "stronger").string(), place = (films.bench.folder / "of_").string();
  REQUIRE(films.bench.erbs({"run", test::in_source("/scenes/first.lua"), "-D", "shake=0.42*g", "-o", stronger, "-q", "--no-figures"}) == 0);
  const std::vector<std::string> how{"--film-background", "drawn", "--expect", "iou>.9"};
  std::vector<std::string> same{"compare", films.run, coarse, "-o", place + "same"},
      other{"compare", stronger, coarse, "-o", place + "other"};
  same.insert(same.end(), how.begin(), how.end()), other.insert(other.end(), how.begin(), how.end());
  CHECK(films.bench.erbs(same) == 0);
  CHECK(films.bench.erbs(other) == 4);
}

TEST_CASE("a film that breaks off is told, and so is one whose width is reduced and odd", "[render][compare][program][bad_input]") {
  Films films;
  const std::string film = films.film(0, "25", "1282x366"), cut = (films.bench.folder / "cut.mp4").string();
  std::filesystem::copy_file(film, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) * 2 / 3);
  const auto compare_with = [&](const std::string& reference, const std::string& place) {
    return films.bench.erbs(
        {"compare", films.run, reference, "-o", (films.bench.folder / place).string(), "--align", "none", "--film-background", "drawn"});
  };
  CHECK(compare_with(film, "whole") == 0);
  CHECK(films.bench.said.find("breaks off") == std::string::npos);
  CHECK(read_json((films.bench.folder / "whole/frames.json").string())["method"]["reduction"] == 3);
  CHECK(compare_with(cut, "part") == 0);
  INFO(films.bench.said);
  CHECK(films.bench.said.find("the film breaks off: ") != std::string::npos);
  CHECK(read_json((films.bench.folder / "part/frames.json").string())["frames_missing"] > 3);
}

TEST_CASE("a film with a title and a strip is told, one without is not", "[render][compare][program]") {
  Films films;
  const char* const overlay = GENERATE("", "--no-overlay");
  const std::string background = GENERATE("rows", "drawn");
  CAPTURE(overlay, background);
  const std::string film = films.film(0, "25", "640x360", overlay), place = (films.bench.folder / "found").string();
  CHECK(films.bench.erbs({"compare", films.run, film, "-o", place, "--align", "none", "--film-background", background}) == 0);
  INFO(films.bench.said);
  const bool told = films.bench.said.find("--no-overlay") != std::string::npos;
  CHECK(told == (*overlay == 0));
  CHECK((read_json(place + "/compare.json")["standing_share"] > 0.1) == (*overlay == 0));
}

TEST_CASE("a camera inside a block compares nothing", "[render][compare][program][bad_input]") {
  Films films;
  const std::string film = films.film(0, "25", "256x192"), place = (films.bench.folder / "none").string();
  CHECK(films.bench.erbs({"compare", films.run, film, "-o", place, "--eye=.15,.06,.07", "--target=3,0,0"}) == 2);
  INFO(films.bench.said);
  CHECK(films.bench.said.find("stands inside block brick0") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(place));
}

TEST_CASE("figures of a comparison do not depend on the number of threads", "[render][compare][program]") {
  Films films;
  const std::string film = films.film(0, "25", "256x192"), renderer = test::in_build("/erbs-render");
  std::vector<Json> found;
  for (const std::string threads : {"1", "3"}) {
    const std::string place = (films.bench.folder / ("by" + threads)).string();
    REQUIRE(wait_for(start({renderer, films.run, "--compare", film, "--compare-to", place, "--threads", threads, "--no-figures", "-q"},
                           (films.bench.folder / "log").string())) == 0);
    found.push_back(read_json(place + "/frames.json"));
    found.back().erase("wall_s");
  }
  CHECK(found[0] == found[1]);
}

TEST_CASE("what is no film is refused, and nothing is written", "[render][compare][program]") {
  Films films;
  films.bench.write("text.mp4", "no film");
  const std::string place = (films.bench.folder / "none").string();
  CHECK(films.bench.erbs({"compare", films.run, (films.bench.folder / "text.mp4").string(), "-o", place}) == 2);
  CHECK(films.bench.said.find("finds no film") != std::string::npos);
  std::filesystem::create_directories(films.bench.folder / "empty");
  CHECK(films.bench.erbs({"compare", films.run, (films.bench.folder / "empty").string(), "-o", place}) == 2);
  CHECK(films.bench.said.find("no two PNG files") != std::string::npos);
  CHECK(films.bench.erbs({"compare", films.run, (films.bench.folder / "text.mp4").string(), "-o", place, "--expect", "peak<5%"}) == 2);
  CHECK_FALSE(std::filesystem::exists(place));
}

TEST_CASE("first motions are found where a run moves from its first picture on, and where they lie before a film the user is told",
          "[render][compare]") {
  // The run creeps from the start and falls at 5 s.
  const auto change = [](double t) { return t < 0 ? 0.0 : t < 5 ? 1.0 : 1 + 4 * std::min(1.0, t - 5); };
  const auto lag_from = [&](double from) {  // of a film that begins at this time of the run
    FilmErrors errors;
    errors.fps = 25;
    for (int i = 1; i < 200; ++i) errors.run.t.push_back(0.04 * (i - 0.5)), errors.run.y.push_back(change(0.04 * (i - 0.5)));
    errors.film.t = errors.run.t;
    for (const double t : errors.film.t) errors.film.y.push_back(change(t + from) + 0.02 * std::sin(100 * t));
    FilmComparison wish;
    wish.align = "first-motion";
    align_film(errors, wish, 1, errors.run.t);
    return errors;
  };
  const FilmErrors late = lag_from(-0.36), early = lag_from(0.52);
  CHECK(late.lag == Approx(-0.36).margin(0.04));
  CHECK(std::isnan(late.correlated_lag));
  CHECK(early.correlated_lag == Approx(0.52).margin(0.02));
}
