#include "render/compare/films.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/base/error.h"

namespace erbs::render {

Image side_by_side(const Image& left, const Image& right) {
  Image both(left.width + right.width, left.height);
  for (int y = 0; y < left.height; ++y) {
    std::copy_n(left.pixel(0, y), 3 * left.width, both.pixel(0, y));
    std::copy_n(right.pixel(0, y), 3 * right.width, both.pixel(left.width, y));
  }
  return both;
}

Image blended(const Image& a, const Image& b) {
  Image mean(a.width, a.height);
  for (std::size_t i = 0; i < mean.rgb.size(); ++i) mean.rgb[i] = std::uint8_t((a.rgb[i] + b.rgb[i] + 1) / 2);
  return mean;
}

Image difference_of(const Image& a, const Image& b) {
  using Color = std::array<std::uint8_t, 3>;
  constexpr int most = 3 * 255;  // of the sum over three channels
  // Full colour at a quarter of the range, by the mean change of a channel.
  static const std::vector<Color> colors = [] {
    const double orange[3] = {213, 94, 0}, blue[3] = {0, 114, 178};  // Okabe and Ito 2008
    std::vector<Color> all(2 * most + 1);
    for (int sum = -most; sum <= most; ++sum)
      for (std::size_t c = 0; c < 3; ++c) {
        const double share = std::min(1.0, std::abs(sum) / 3.0 / 64);
        all[std::size_t(sum + most)][c] = std::uint8_t(245 + share * ((sum > 0 ? orange : blue)[c] - 245));
      }
    return all;
  }();
  Image image(a.width, a.height);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    int sum = most;
    for (std::size_t c = i; c < i + 3; ++c) sum += a.rgb[c] - b.rgb[c];
    std::copy_n(colors[std::size_t(sum)].begin(), 3, &image.rgb[i]);
  }
  return image;
}

namespace {

// H.264 has no odd sizes: the last column and row are drawn twice.
Image even(Image image) {
  if (image.width % 2 == 0 && image.height % 2 == 0) return image;
  Image whole(image.width + image.width % 2, image.height + image.height % 2);
  for (int y = 0; y < whole.height; ++y) {
    const std::uint8_t* row = image.pixel(0, std::min(y, image.height - 1));
    std::copy_n(row, 3 * image.width, whole.pixel(0, y));
    std::copy_n(row + 3 * (image.width - 1), 3 * (whole.width - image.width), whole.pixel(image.width, y));
  }
  return whole;
}

}  // namespace

ComparisonFilms::ComparisonFilms(const std::string& folder, int width, int height, double fps)
    : side_(folder + "/compare_side.mp4", 2 * width, height + height % 2, fps),
      blend_(folder + "/compare_blend.mp4", width + width % 2, height + height % 2, fps),
      difference_(folder + "/compare_difference.mp4", width + width % 2, height + height % 2, fps),
      font_(Font::Face::regular) {}

void ComparisonFilms::label(Image& image, const std::string& left, const std::string& right, double t) const {
  const double size = std::max(11.0, image.height / 26.0), bar = 1.7 * size;
  fill_box(image, 0, 0, image.width, bar, {255, 255, 255, 0.85});
  const double base = 1.2 * size;
  font_.draw(image, left, 0.6 * size, base, size, {20, 20, 20, 1});
  font_.draw(image, fmt::format("{:.3f} s", t), 0.5 * image.width, base, size, {20, 20, 20, 1}, Font::Align::middle);
  font_.draw(image, right, image.width - 0.6 * size, base, size, {20, 20, 20, 1}, Font::Align::right);
}

void ComparisonFilms::add(std::size_t which, const Image& run, const Image& film, double t) {
  if (which == 0) {
    Image image = side_by_side(film, run);
    label(image, "reference", "run", t);
    side_.add(even(std::move(image)));
  } else if (which == 1) {
    Image image = blended(run, film);
    label(image, "reference + run", "", t);
    blend_.add(even(std::move(image)));
  } else {
    Image image = difference_of(run, film);
    label(image, "orange: run brighter", "blue: darker", t);
    difference_.add(even(std::move(image)));
  }
}

void ComparisonFilms::end() {
  for (Video* video : {&side_, &blend_, &difference_}) video->end();
}

void ComparisonFilms::finish() {
  end();
  for (Video* video : {&side_, &blend_, &difference_}) video->finish();
}

}  // namespace erbs::render
