// Drawing processes: their input, their output, and failures of one of them.
#include "render/movie/workers.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "engine/base/error.h"

using namespace erbs;
using namespace erbs::render;

namespace {

MotionFrame frame_of(double t) { return {t, {1, 2, 3, 1, 0, 0, 0}, {7, 9, 11}, {0.1F, 0.2F, 0.3F}}; }

// A picture whose first pixel shows the input of the process.
Workers::Draw echo() {
  return [](std::size_t index, const MotionFrame& f) {
    Image image(4, 2);
    image.rgb = {static_cast<std::uint8_t>(index), f.damage[2], static_cast<std::uint8_t>(10 * f.t),
                 static_cast<std::uint8_t>(10 * f.opening[1])};
    image.rgb.resize(24, static_cast<std::uint8_t>(f.poses[2]));
    return image;
  };
}

}  // namespace

TEST_CASE("processes draw what they are ordered to", "[render][workers]") {
  Workers workers(2, Image(4, 2), frame_of(0), echo);
  workers.order(0, 5, frame_of(0.5));
  workers.order(1, 6, frame_of(0.6));
  const Image a = workers.collect(0), b = workers.collect(1);
  CHECK(a.rgb[0] == 5);
  CHECK(a.rgb[1] == 11);
  CHECK(a.rgb[2] == 5);
  CHECK(a.rgb[3] == 2);
  CHECK(a.rgb[23] == 3);
  CHECK(b.rgb[0] == 6);
}

TEST_CASE("a process takes a second order while it draws the first", "[render][workers]") {
  Workers one(1, Image(4, 2), frame_of(0), echo);
  one.order(0, 1, frame_of(0.1));
  one.order(0, 2, frame_of(0.2));
  CHECK(one.collect(0).rgb[2] == 1);
  one.order(0, 3, frame_of(0.3));
  CHECK(one.collect(0).rgb[2] == 2);
  CHECK(one.collect(0).rgb[2] == 3);
}

TEST_CASE("pictures are taken in their order by any number of processes", "[render][workers]") {
  for (const std::size_t count : {1, 2, 3, 7}) {
    Workers workers(count, Image(4, 2), frame_of(0), echo);
    std::vector<int> taken;
    workers.draw_in_order(
        5, [](std::size_t i) { return frame_of(0.1 * double(i)); },
        [&](std::size_t i, const Image& image) {
          CHECK(image.rgb[0] == i);
          CHECK(int(image.rgb[2]) == int(i));
          taken.push_back(int(i));
          return i < 3;
        });
    CHECK(taken == std::vector<int>{0, 1, 2, 3});
  }
}

TEST_CASE("what goes wrong in a drawing process is told here", "[render][workers]") {
  const auto failing = [](auto what) {
    return [what]() -> Workers::Draw {
      return [what](std::size_t, const MotionFrame&) -> Image {
        what();
        return {};
      };
    };
  };
  Workers full(1, Image(4, 2), frame_of(0), failing([] { throw Error("the disk is full"); }));
  full.order(0, 0, frame_of(0));
  CHECK_THROWS_AS(full.collect(0), Error);
  Workers confused(1, Image(4, 2), frame_of(0), failing([] { throw std::logic_error("internal"); }));
  confused.order(0, 0, frame_of(0));
  CHECK_THROWS_WITH(confused.collect(0), "internal");
  Workers dead(1, Image(4, 2), frame_of(0), failing([] { _exit(3); }));
  dead.order(0, 0, frame_of(0));
  CHECK_THROWS_WITH(dead.collect(0), Catch::Contains("died"));
}
