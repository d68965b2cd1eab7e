#include "render/image/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "engine/base/units.h"

namespace erbs::render {
namespace {

constexpr int side = 16, reach = 8;  // px, of block matching

// Sum of absolute differences of a square of `after` and the square of `before` that lies (dx, dy) away. Stops above `most`.
float mismatch(const Gray& before, const Gray& after, int x0, int y0, int dx, int dy, float most) {
  std::array<float, side> column{};  // sums of columns: a processor adds them side by side
  float sum = 0;
  for (int y = 0; y < side && sum < most; ++y) {
    const float* p = &after.v[std::size_t((y0 + y) * after.width + x0)];
    const float* q = &before.v[std::size_t((y0 + y + dy) * before.width + x0 + dx)];
    for (std::size_t x = 0; x < side; ++x) column[x] += std::abs(p[x] - q[x]);
    if (y % 4 == 3) sum = std::accumulate(column.begin(), column.end(), 0.0f);
  }
  return sum;
}

}  // namespace

Gray gray_of(const Image& image) {
  Gray gray{image.width, image.height, std::vector<float>(image.rgb.size() / 3)};
  for (std::size_t i = 0; i < gray.v.size(); ++i)
    gray.v[i] = 0.2126f * float(image.rgb[3 * i]) + 0.7152f * float(image.rgb[3 * i + 1]) + 0.0722f * float(image.rgb[3 * i + 2]);
  return gray;
}

namespace {

// `known`: the factor, which a processor then need not look up; 0: any.
template <int known>
void reduce(const Image& image, int any, Image& small) {
  const int factor = known > 0 ? known : any;
  const std::size_t length = 3 * std::size_t(small.width * factor);
  const auto area = std::uint32_t(factor * factor);
  std::vector<std::uint32_t> sums(length);  // of the rows of a square: a processor adds several columns at once
  for (int y = 0; y < small.height; ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    std::uint32_t* const sum = sums.data();
    for (int j = 0; j < factor; ++j) {
      const std::uint8_t* const row = image.pixel(0, y * factor + j);
      for (std::size_t i = 0; i < length; ++i) sum[i] += row[i];
    }
    std::uint8_t* to = small.pixel(0, y);
    for (int x = 0; x < small.width; ++x)
      for (int c = 0; c < 3; ++c) {
        std::uint32_t all = area / 2;
        for (int i = 0; i < factor; ++i) all += sum[3 * (x * factor + i) + c];
        *to++ = std::uint8_t(all / area);
      }
  }
}

}  // namespace

Image reduced(const Image& image, int factor) {
  if (factor <= 1) return image;
  Image small(image.width / factor, image.height / factor);
  if (factor == 2) reduce<2>(image, 2, small);
  else if (factor == 4) reduce<4>(image, 4, small);
  else reduce<0>(image, factor, small);
  return small;
}

double mean_difference(const Gray& a, const Gray& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.v.size(); ++i) sum += std::abs(double(a.v[i]) - double(b.v[i]));
  return a.v.empty() ? 0 : sum / double(a.v.size());
}

std::vector<float> changes_of_squares(const Gray& a, const Gray& b) {
  constexpr int side = 8;
  std::vector<float> squares;
  for (int top = 0; top + side <= a.height; top += side)
    for (int left = 0; left + side <= a.width; left += side) {
      float sum = 0;
      for (int y = top; y < top + side; ++y)
        for (int i = y * a.width + left; i < y * a.width + left + side; ++i) sum += std::abs(a.v[std::size_t(i)] - b.v[std::size_t(i)]);
      squares.push_back(sum / (side * side));
    }
  if (squares.empty()) return squares;
  std::vector<float> sorted = squares;
  const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (float& square : squares) square = std::max(0.0F, square - *middle);
  return squares;
}

Image row_medians(const Image& image) {
  Image background(image.width, image.height);
  std::vector<std::uint8_t> row(std::size_t(image.width));
  for (int y = 0; y < image.height; ++y)
    for (int c = 0; c < 3; ++c) {
      for (int x = 0; x < image.width; ++x) row[std::size_t(x)] = image.pixel(x, y)[c];
      std::nth_element(row.begin(), row.begin() + image.width / 2, row.end());
      for (int x = 0; x < image.width; ++x) background.pixel(x, y)[c] = row[std::size_t(image.width / 2)];
    }
  return background;
}

Mask silhouette(const Image& image, const Image& background, int threshold) {
  Mask mask(image.rgb.size() / 3), beyond(image.rgb.size());
  const std::uint8_t *const a = image.rgb.data(), *const b = background.rgb.data();
  std::uint8_t* const channel = beyond.data();
  const auto most = std::uint8_t(threshold);
  for (std::size_t i = 0; i < beyond.size(); ++i) channel[i] = std::uint8_t(std::max(a[i], b[i]) - std::min(a[i], b[i])) > most;
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = channel[3 * i] | channel[3 * i + 1] | channel[3 * i + 2];
  return mask;
}

double overlap(const Mask& a, const Mask& b) {
  std::size_t both = 0, any = 0;
  for (std::size_t i = 0; i < a.size(); ++i) both += a[i] & b[i], any += a[i] | b[i];
  return any == 0 ? 1 : double(both) / double(any);
}

Flow flow_between(const Gray& before, const Gray& after) {
  Flow flow;
  int all = 0, moving = 0;
  for (int y = reach; y + side + reach <= after.height; y += side)
    for (int x = reach; x + side + reach <= after.width; x += side, ++all) {
      const float rest = mismatch(before, after, x, y, 0, 0, HUGE_VALF);
      if (rest < 3 * side * side) continue;
      float best = 0.9f * rest;
      int bx = 0, by = 0;
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
          if (const float now = mismatch(before, after, x, y, dx, dy, best); now < best) best = now, bx = dx, by = dy;
      if (bx != 0 || by != 0) flow.x -= bx, flow.y += by, ++moving;
    }
  if (moving > 0) flow.x /= moving, flow.y /= moving;
  flow.moving = all > 0 ? double(moving) / all : 0;
  return flow;
}

double angle_between(const Flow& a, const Flow& b) {
  if (std::hypot(a.x, a.y) < 0.1 || std::hypot(b.x, b.y) < 0.1) return NAN;
  return std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y)) * 180 / pi;
}

}  // namespace erbs::render
