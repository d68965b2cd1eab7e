#include "render/image/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace erbs::render {
namespace {

double brightness(const std::uint8_t* p) { return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]; }

// Structural similarity: Wang, Bovik, Sheikh, Simoncelli 2004, eq. (13), with K1 = 0.01 and K2 = 0.03 of section III.
double window_ssim(const Image& a, const Image& b, int x0, int y0) {
  constexpr int side = 8;
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255, n = side * side;
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x) {
      const double p = brightness(a.pixel(x, y)), q = brightness(b.pixel(x, y));
      sa += p, sb += q, saa += p * p, sbb += q * q, sab += p * q;
    }
  const double ma = sa / n, mb = sb / n;
  const double va = (saa - n * ma * ma) / (n - 1), vb = (sbb - n * mb * mb) / (n - 1), cov = (sab - n * ma * mb) / (n - 1);
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
  double sum = 0;
  int windows = 0;
  for (int y = 0; y + 8 <= a.height; y += 4)
    for (int x = 0; x + 8 <= a.width; x += 4, ++windows) sum += window_ssim(a, b, x, y);
  d.ssim = sum / windows;
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
