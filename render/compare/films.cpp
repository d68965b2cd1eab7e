#include "render/compare/films.h"

#include <algorithm>
#include <cmath>

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
  Image image(a.width, a.height);
  const double orange[3] = {213, 94, 0}, blue[3] = {0, 114, 178};  // Okabe and Ito 2008
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    double change = 0;
    for (std::size_t c = i; c < i + 3; ++c) change += (a.rgb[c] - b.rgb[c]) / 3.0;
    const double share = std::min(1.0, std::abs(change) / 64);  // full colour at a quarter of the range
    for (std::size_t c = 0; c < 3; ++c) image.rgb[i + c] = std::uint8_t(245 + share * ((change > 0 ? orange : blue)[c] - 245));
  }
  return image;
}

ComparisonFilms::ComparisonFilms(const std::string& folder, int width, int height, double fps)
    : side_(folder + "/compare_side.mp4", 2 * width, height, fps, 3, "faster"),
      blend_(folder + "/compare_blend.mp4", width, height, fps, 3, "faster"),
      difference_(folder + "/compare_difference.mp4", width, height, fps, 3, "faster"),
      font_(Font::Face::regular) {}

void ComparisonFilms::label(Image& image, const std::string& left, const std::string& right, double t) const {
  const double size = std::max(11.0, image.height / 26.0), bar = 1.7 * size;
  fill_box(image, 0, 0, image.width, bar, {255, 255, 255, 0.85});
  const double base = 1.2 * size;
  font_.draw(image, left, 0.6 * size, base, size, {20, 20, 20, 1});
  font_.draw(image, fmt::format("{:.3f} s", t), 0.5 * image.width, base, size, {20, 20, 20, 1}, Font::Align::middle);
  font_.draw(image, right, image.width - 0.6 * size, base, size, {20, 20, 20, 1}, Font::Align::right);
}

void ComparisonFilms::add(const Image& run, const Image& film, double t) {
  Image image = side_by_side(film, run);
  label(image, "reference", "run", t);
  side_.add(image);
  image = blended(run, film);
  label(image, "reference + run", "", t);
  blend_.add(image);
  image = difference_of(run, film);
  label(image, "orange: run brighter", "blue: darker", t);
  difference_.add(image);
}

void ComparisonFilms::finish() {
  for (Video* video : {&side_, &blend_, &difference_}) video->finish();
}

}  // namespace erbs::render
