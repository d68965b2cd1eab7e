// Images: files, comparison, text.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "render/image/compare.h"
#include "render/image/image.h"
#include "render/image/text.h"
#include "tests/support/folder.h"

using namespace erbs;
using namespace erbs::render;

namespace {

Image pattern(int w, int h) {
  Image image(w, h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      p[0] = static_cast<std::uint8_t>(x * 7 + y), p[1] = static_cast<std::uint8_t>(x * y),
      p[2] = static_cast<std::uint8_t>(50 + 100 * (x / 8 % 2));
    }
  return image;
}

}  // namespace

TEST_CASE("a PNG gives back its pixels", "[render][image]") {
  const test::Folder folder;
  const std::string path = folder.file("pattern.png");
  const Image image = pattern(61, 33);
  write_png(path, image);
  const Image again = read_png(path);
  CHECK(again.width == 61);
  CHECK(again.height == 33);
  CHECK(again.rgb == image.rgb);
  CHECK(png_text(path, "Scene").empty());
  write_png(path, image, {{"Software", "erbs"}, {"Scene", "H\u00e4uschen 12"}});
  CHECK(png_text(path, "Scene") == "H\u00e4uschen 12");
  CHECK(read_png(path).rgb == image.rgb);
  std::ofstream(path) << "no picture";
  CHECK_THROWS_AS(read_png(path), Error);
  CHECK_THROWS_AS(png_text(path, "Scene"), Error);
  CHECK_THROWS_AS(write_png("/nowhere/at/all.png", image), Error);
}

TEST_CASE("pictures are alike within the tolerance and not beyond it", "[render][compare]") {
  const Image a = pattern(100, 80);
  CHECK(compare(a, a).alike());
  CHECK(compare(a, a).ssim == Approx(1));
  CHECK(compare(a, a).failed_fraction == 0);
  Image b = a;
  for (std::uint8_t& v : b.rgb) v = static_cast<std::uint8_t>(v < 128 ? v + 4 : v - 4);
  CHECK(compare(a, b).alike());  // 4/255 everywhere
  b = a;
  for (int i = 0; i < 80; ++i) b.pixel(i, i)[1] ^= 0x40;  // 1 % of 8000 pixels
  CHECK(compare(a, b).failed_fraction == Approx(0.01));
  b.pixel(0, 1)[1] ^= 0x40;
  CHECK_FALSE(compare(a, b).alike());
  // A shift by one pixel keeps every brightness but changes the structure.
  Image shifted = a;
  std::copy(a.rgb.begin(), a.rgb.end() - 3, shifted.rgb.begin() + 3);
  CHECK(compare(a, shifted).ssim < 0.9);
  CHECK_FALSE(compare(a, pattern(100, 81)).same_size);
}

TEST_CASE("text is as wide as it says and stays within the picture", "[render][text]") {
  const Font font(Font::Face::regular);
  Image image(200, 40);
  font.draw(image, "0.40 g, µm", 190, 30, 20, {255, 255, 255, 1}, Font::Align::right);
  int left = 200, right = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 200; ++x)
      if (image.pixel(x, y)[0] > 40) left = std::min(left, x), right = std::max(right, x);
  CHECK(right <= 190);
  CHECK(right >= 185);
  CHECK(190 - left == Approx(font.width("0.40 g, µm", 20)).margin(3));
  CHECK_NOTHROW(font.draw(image, "\xff out of the picture", 150, 5, 30, {}));
}
