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
  std::vector<double> of_a(static_cast<std::size_t>(columns * square)), of_b = of_a;  // brightness of a row
  for (int y = 0; y < rows * square; ++y) {
    const std::uint8_t *p = a.pixel(0, y), *q = b.pixel(0, y);
    for (std::size_t x = 0; x < of_a.size(); ++x, p += a.channels, q += b.channels) of_a[x] = brightness(p), of_b[x] = brightness(q);
    for (std::size_t column = 0; column < static_cast<std::size_t>(columns); ++column) {
      Sums s;
      for (std::size_t x = column * square; x < (column + 1) * square; ++x)
        s.a += of_a[x], s.b += of_b[x], s.aa += of_a[x] * of_a[x], s.bb += of_b[x] * of_b[x], s.ab += of_a[x] * of_b[x];
      Sums& all = sums[static_cast<std::size_t>(y / square * columns) + column];
      all = all + s;
    }
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
  d.ssim = ssim(a, b);
  return d;
}

double ssim(const Image& a, const Image& b) {
  if (a.width < 2 * square || a.height < 2 * square) return 0;
  const std::vector<Sums> sums = sums_of_squares(a, b);
  const int columns = a.width / square, rows = a.height / square;
  double sum = 0;  // each square belongs to up to four windows of 8 x 8 pixels
  for (int y = 0; y + 1 < rows; ++y)
    for (int x = 0; x + 1 < columns; ++x) {
      const Sums* s = &sums[static_cast<std::size_t>(y * columns + x)];
      sum += window_ssim(s[0] + s[1] + s[columns] + s[columns + 1]);
    }
  return sum / ((rows - 1) * (columns - 1));
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
