#include "engine/geometry/clip.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace erbs;

TEST_CASE("a cut keeps a corner on the line once, and nothing of a polygon outside", "[geometry]") {
  const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto cut = [&](const Vec2& n, double c) {
    std::vector<Vec2> out;
    const auto corner = [&](int i) -> const Vec2& { return square[std::size_t(i)]; };
    cut_polygon(
        4, corner, [&](int i) { return c - n.dot(corner(i)); },
        [&](const Vec2& x, double d) {
          CHECK(c - n.dot(x) == Approx(d).margin(1e-15));  // the function itself is carried along
          out.push_back(x);
        });
    return out;
  };
  CHECK(cut({1, 0}, 0.25) == std::vector<Vec2>{{0, 0}, {0.25, 0}, {0.25, 1}, {0, 1}});
  CHECK(cut({1, 1}, 1) == std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}});  // along a diagonal
  CHECK(cut({1, 0}, 1).size() == 4);                                   // along an edge
  CHECK(cut({1, 0}, -1).empty());
}

TEST_CASE("what a cut leaves of a polygon starts with the same corner", "[geometry]") {
  const Polygon2 square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(clip_half_plane(square, {0, 1}, 0.5) == Polygon2{{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}});
  CHECK(clip_half_plane(square, {0, -1}, -0.5) == Polygon2{{1, 0.5}, {1, 1}, {0, 1}, {0, 0.5}});
}
