// A film has the colours of its pictures, wherever they come from.
#include "render/movie/video.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <optional>

#include "render/movie/film_reader.h"
#include "tests/support/folder.h"

using namespace erbs;
using namespace erbs::render;

TEST_CASE("colours of a film are those of its pictures", "[render][video]") {
  const test::Folder dir;
  constexpr int side = 32;  // px, of a square of one colour
  const std::vector<std::array<std::uint8_t, 3>> colors{{0, 0, 0},   {255, 255, 255}, {255, 0, 0},     {0, 255, 0},
                                                        {0, 0, 255}, {200, 110, 80},  {128, 128, 128}, {20, 60, 90}};
  // A step of the narrow range is 1.2 of a channel of 255, and the compression may err by two of them.
  Image image(side * static_cast<int>(colors.size()), 2 * side);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) std::copy_n(colors[static_cast<std::size_t>(x / side)].begin(), 3, image.pixel(x, y));
  const std::string path = dir.file("film.mp4");
  {
    Video film(path, image.width, image.height, 25);
    for (int i = 0; i < 3; ++i) film.add(image);
    film.finish();
  }
  FilmReader reader(path, 25);
  reader.rewind();
  int pictures = 0;
  for (std::optional<Image> seen; (seen = reader.next()); ++pictures)
    for (std::size_t k = 0; k < colors.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        INFO("colour " << k << ", channel " << c << ", picture " << pictures);
        CHECK(std::abs(int(seen->pixel(static_cast<int>(k) * side + side / 2, side)[c]) - int(colors[k][c])) <= 4);
      }
  CHECK(pictures == 3);
}
