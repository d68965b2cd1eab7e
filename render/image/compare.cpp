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

}  // namespace

Difference compare(const Image& a, const Image& b) {
  Difference d;
  d.same_size = a.width == b.width && a.height == b.height && a.channels == b.channels && a.width >= 8 && a.height >= 8;
  if (!d.same_size) return d;
  std::size_t failed = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
    int worst = 0;
    for (std::size_t c = i; c < i + 3; ++c) worst = std::max(worst, std::abs(a.rgb[c] - b.rgb[c]));
    failed += worst > 4 ? 1 : 0;
  }
  d.failed_fraction = static_cast<double>(failed) / (static_cast<double>(a.rgb.size()) / 3);
  double sum = 0;
  int windows = 0;
  for (int y = 0; y + 8 <= a.height; y += 4)
    for (int x = 0; x + 8 <= a.width; x += 4, ++windows) sum += window_ssim(a, b, x, y);
  d.ssim = sum / windows;
  return d;
}

}  // namespace erbs::render
