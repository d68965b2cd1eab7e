// A camera given after the run: what it refuses, and the elevations that every run has.
#include <algorithm>
#include <catch2/catch.hpp>

#include "render/image/image.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;
namespace fs = std::filesystem;

TEST_CASE("a camera of one's own looks where it should, or says why it cannot", "[program][render]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + "joint{ law = dry{ kn = 1*GPa, mu = .6 } } analysis{ duration = .02 }") == 0);
  const auto render = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"render", bench.out(), "--stills", "0", "--force", "--no-figures"};
    if (std::find(more.begin(), more.end(), "--size") == more.end()) words.insert(words.end(), {"--size", "160x120"});
    words.insert(words.end(), more.begin(), more.end());
    return bench.erbs(words);
  };
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"--eye", "1,2"}, "--eye 1,2 is not a point in m; try --eye 6,-7,4"},
      {{"--eye", "1,2,3,4"}, "is not a point in m"},
      {{"--eye", "1,2,x"}, "is not a point in m"},
      {{"--eye", "1,2,nan"}, "is not a point in m"},
      {{"--eye=1,-2,1", "--target=1,-2,1"}, "--eye and --target are the same point"},
      {{"--target", "0,0,0"}, "give --eye x,y,z as well"},
      {{"--path", "0:1,2,3:0,0,0"}, "two or more keyframes"},
      {{"--path", "0:1,2,3:0,0,0; 1:1,2:0,0,0"}, "two or more keyframes"},
      {{"--path", "1:1,2,3:0,0,0; 1:2,2,3:0,0,0"}, "order them by time"},
      {{"--path", "0:1,2,3:1,2,3; 1:2,2,3:0,0,0"}, "looks nowhere"},
      {{"--path", "0:1,2,3:0,0,0; 1:2,2,3:0,0,0", "--camera", "corner"}, "leave out --eye, --camera and --follow"},
      {{"--follow", "debris"}, "no block has fallen"},
      {{"--time", "0:1"}, "--stills and --time exclude each other"},
      {{"--frames", "5"}, "--stills and --frames exclude each other"},
      {{"--webp"}, "--stills makes single pictures"},
      {{"--figures"}, "--figures and --no-figures exclude each other"},
      {{"--follow", "brick"}, "no group and no block"},
      {{"--split", "--eye", "1,2,3"}, "--split needs several cameras"},
      {{"--split", "--camera", "from_-x,from_+x", "--size", "100x100"}, "larger --size"},
      {{"--svg", "--split"}, "leave out --split"},
      {{"--svg", "--color", "speed"}, "leave out --color"},
      {{"--forces"}, "frame_stress = true"},
      {{"--dust", "--magnify", "3"}, "leave out --magnify"},
      {{"--mechanism", "nowhere.csv"}, "nowhere.csv"},
      {{"--mechanism", (fs::path(bench.out()) / "energy.csv").string()}, "it is no mechanism"},
      {{"--eye", "1,2,3", "--camera", "corner"}, "leave out --camera"},
      {{"--eye", "1,2,3", "--fov", "180"}, "--fov"},
      {{"--camera", "from_x"}, "from_above"},
      {{"--eye=.15,.06,.05", "--target=3,0,0"}, "the camera of --eye stands inside block b0 at 0 s"},
      {{"--eye=.15,.06,.31", "--target=3,0,0", "--svg"}, "inside block b3"},
      {{"--path", "0:.15,.06,.15:3,0,0; 1:4,4,4:0,0,0"}, "inside block b1"},
  };
  for (const auto& [words, reason] : wrong) {
    INFO(reason);
    CHECK(render(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, reason));
  }
  CHECK_FALSE(fs::exists(fs::path(bench.out()) / "frames"));
  CHECK(render({"--eye=.15,.06,.05", "--target=3,0,0", "--hide", "pier"}) == 2);  // nothing is left
  CHECK(render({"--eye=.15,.06,.05", "--target=3,0,0", "--ghost", "pier"}) == 0);
  CHECK(render({"--eye=.15,.06,.05", "--target=3,0,0", "--section", "x<.1"}) == 0);  // where it stands, all is cut away
  CHECK(render({"--eye=2,2,-.5", "--target=0,0,0"}) == 0);
  CHECK(contains(bench.said, "below the ground"));
  CHECK(bench.erbs({"render", bench.out(), "--time", "0:9", "--size", "160x120", "--no-video", "--force", "--no-figures"}) == 0);
  CHECK(contains(bench.said, "reaches beyond the run"));
  CHECK(render({"--fit"}) == 0);
  CHECK(render({"--split", "--camera", "from_-x,from_-y,from_above", "--size", "480x360"}) == 0);
  const erbs::render::Image split = erbs::render::read_png(bench.out() + "/frames/split_t0.000s.png");
  int ink = 0;
  for (int y = 200; y < 340; ++y)
    for (int x = 250; x < 470; ++x) ink += split.pixel(x, y)[0] < 150 ? 1 : 0;
  CHECK(ink > 20);  // the legend stands in the tile that no camera fills, and covers none of the others
  CHECK(render({"--path", "0:3,2,3:0,0,0; 1:2,2,3:0,0,0"}) == 0);
  CHECK(render({"--eye=1,-2,1", "--fit"}) == 0);
  CHECK(render({"--eye=0,0,5", "--target=0,0,0"}) == 0);  // straight down
  CHECK(render({"--camera", "from_-x,from_above"}) == 0);
  for (const char* name : {"own", "from_-x", "from_above"})
    CHECK(fs::exists(fs::path(bench.out()) / "frames" / (std::string(name) + "_t0.000s.png")));
}

TEST_CASE("what cannot be drawn is refused before anything is written", "[program][render][bad_input]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + "joint{ law = dry{ kn = 1*GPa, mu = .6 } } analysis{ duration = .1 }", {"--no-figures"}) == 0);
  const fs::path dir(bench.out());
  const std::vector<std::string> small{"render", bench.out(), "--size", "160x120", "--no-video"};
  const auto render = [&](std::vector<std::string> more) {
    more.insert(more.begin(), small.begin(), small.end());
    return bench.erbs(more);
  };
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"--time", "9:12"}, "--time 9:12 holds no frame; the run has frames from 0 s to 0.1"},
      {{"--time", "2:1"}, "is not a span of seconds"},
      {{"--stills", "0,7"}, "--stills 7 is not within the run"},
      {{"--frames", "0"}, "neither `every` nor a number"},
      {{"--frames", "3x"}, "neither `every` nor a number"},
      {{"--svg", "--stills", "-1"}, "--stills -1 is not within the run"},
      {{"--camera", "nowhere"}, "--camera nowhere is none of this run's"},
      {{"--eye=.15,.06,.05", "--target=3,0,0"}, "stands inside block b0"},
  };
  for (const auto& [words, reason] : wrong) {
    INFO(reason);
    CHECK(render(words) == 2);
    INFO(bench.said);
    CHECK(contains(bench.said, reason));
    CHECK_FALSE(fs::exists(dir / "frames"));
    CHECK_FALSE(fs::exists(dir / "energy.svg"));
  }
  CHECK(render({"--stills", "0", "--camera", "from_-x"}) == 0);
  CHECK(fs::exists(dir / "energy.svg"));
  // The second of two cameras has its picture already: the first is not drawn, either.
  CHECK(render({"--stills", "0", "--camera", "from_-y,from_-x"}) == 2);
  CHECK(contains(bench.said, "--force"));
  CHECK_FALSE(fs::exists(dir / "frames/from_-y_t0.000s.png"));
}

TEST_CASE("a camera whose name holds a comma is chosen by it, alone and in a list", "[program][render]") {
  Bench bench;
  REQUIRE(bench.run(four_bricks() + "joint{ law = dry{ kn = 1*GPa, mu = .6 } } analysis{ duration = .02 }\n"
                                    "camera{ name = 'north, low', eye = { 3, 3, .2 }, target = { 0, 0, .2 } }\n"
                                    "camera{ name = 'north', eye = { 0, 3, 1 }, target = { 0, 0, .2 } }") == 0);
  const auto render = [&](const std::string& cameras) {
    return bench.erbs({"render", bench.out(), "--stills", "0", "--force", "--no-figures", "--size", "160x120", "--camera", cameras});
  };
  const fs::path frames = fs::path(bench.out()) / "frames";
  CHECK(render("north, low") == 0);
  CHECK(fs::exists(frames / "north__low_t0.000s.png"));
  CHECK_FALSE(fs::exists(frames / "north_t0.000s.png"));
  CHECK(render("from_+x,north, low,north") == 0);
  CHECK(fs::exists(frames / "from_+x_t0.000s.png"));
  CHECK(fs::exists(frames / "north_t0.000s.png"));
  CHECK(render("north,low") == 2);
  CHECK(contains(bench.said, "--camera low is none of this run's: north, low, north, from_-x"));
}
