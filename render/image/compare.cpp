#include "render/image/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace erbs::render {
namespace {

double brightness(const std::uint8_t* p) { return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]; }

// Sums of the brightness of two pictures, of its squares and of its products, over squares of 4 pixels, from the upper left corner on.
constexpr int square = 4;
struct Sums {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  Sums operator+(const Sums& o) const { return {a + o.a, b + o.b, aa + o.aa, bb + o.bb, ab + o.ab}; }
};

std::vector<Sums> sums_of_squares(const Image& a, const Image& b) {
  const int columns = a.width / square, rows = a.height / square;
  std::vector<Sums> sums(static_cast<std::size_t>(columns * rows));
  for (int y = 0; y < rows * square; ++y)
    for (int x = 0; x < columns * square; ++x) {
      const double p = brightness(a.pixel(x, y)), q = brightness(b.pixel(x, y));
      Sums& s = sums[static_cast<std::size_t>(y / square * columns + x / square)];
      s.a += p, s.b += q, s.aa += p * p, s.bb += q * q, s.ab += p * q;
    }
  return sums;
}

// Structural similarity of a window of four squares: Wang, Bovik, Sheikh, Simoncelli 2004, eq. (13), with K1 = 0.01 and K2 = 0.03 of
// section III.
double window_ssim(const Sums& s) {
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255, n = 4 * square * square;
  const double ma = s.a / n, mb = s.b / n;
  const double va = (s.aa - n * ma * ma) / (n - 1), vb = (s.bb - n * mb * mb) / (n - 1), cov = (s.ab - n * ma * mb) / (n - 1);
  return (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

// Largest difference of a channel, of the pixel that begins at `i`.
int channel_difference(const Image& a, const Image& b, std::size_t i) {
  int worst = 0;
  for (std::size_t c = i; c < i + 3; ++c) worst = std::max(worst, std::abs(a.rgb[c] - b.rgb[c]));
  return worst;
}
constexpr int visible = 4;  // of 255; what drivers round differently is less

}  // namespace

Difference compare(const Image& a, const Image& b) {
  Difference d;
  d.same_size = a.width == b.width && a.height == b.height && a.channels == b.channels && a.width >= 8 && a.height >= 8;
  if (!d.same_size) return d;
  std::size_t failed = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) failed += channel_difference(a, b, i) > visible ? 1 : 0;
  d.failed_fraction = static_cast<double>(failed) / (static_cast<double>(a.rgb.size()) / 3);
  // Each square belongs to up to four windows of 8 x 8 pixels.
  const std::vector<Sums> sums = sums_of_squares(a, b);
  const int columns = a.width / square, rows = a.height / square;
  double sum = 0;
  for (int y = 0; y + 1 < rows; ++y)
    for (int x = 0; x + 1 < columns; ++x) {
      const Sums* s = &sums[static_cast<std::size_t>(y * columns + x)];
      sum += window_ssim(s[0] + s[1] + s[columns] + s[columns + 1]);
    }
  d.ssim = sum / ((rows - 1) * (columns - 1));
  return d;
}

Image difference_picture(const Image& a, const Image& b) {
  Image out(a.width, a.height);
  for (std::size_t i = 0; i + 2 < a.rgb.size() && i + 2 < b.rgb.size(); i += 3) {
    const double pale = 255 - 0.35 * (255 - brightness(&a.rgb[i]));
    const int worst = channel_difference(a, b, i);
    const double red = worst > visible ? std::min(1.0, 0.4 + 0.6 * worst / 128) : 0;
    const double paint[3] = {214, 32, 32};
    for (std::size_t c = 0; c < 3; ++c) out.rgb[i + c] = static_cast<std::uint8_t>(std::lround((1 - red) * pale + red * paint[c]));
  }
  return out;
}

}  // namespace erbs::render
