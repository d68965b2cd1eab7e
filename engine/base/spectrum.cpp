#include "engine/base/spectrum.h"

#include <cmath>
#include <utility>

#include "engine/base/units.h"

namespace erbs {

void fourier(std::vector<std::complex<double>>& values) {
  const size_t n = values.size();
  for (size_t i = 1, j = 0; i < n; ++i) {
    size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (size_t length = 2; length <= n; length *= 2)
    for (size_t k = 0; k < length / 2; ++k) {
      const auto turn = std::polar(1.0, -2 * pi * static_cast<double>(k) / static_cast<double>(length));
      for (size_t start = k; start < n; start += length) {
        const auto odd = turn * values[start + length / 2];
        values[start + length / 2] = values[start] - odd;
        values[start] += odd;
      }
    }
}

double dominant_frequency(const std::vector<double>& values, double dt) {
  const size_t n = values.size();
  if (n < 4 || !(dt > 0)) return 0;
  double mean = 0, largest = 0;
  for (const double v : values) mean += v / static_cast<double>(n);
  for (const double v : values) largest = std::max(largest, std::abs(v - mean));
  if (!(largest > 1e-12 * std::abs(mean))) return 0;
  size_t length = 4;  // zeros at the end make the lines lie closer together
  while (length < 4 * n) length *= 2;
  std::vector<std::complex<double>> line(length);
  for (size_t i = 0; i < n; ++i) {
    const double window = 0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(n - 1));
    line[i] = (values[i] - mean) / largest * window;
  }
  fourier(line);
  size_t peak = 1;
  for (size_t k = 1; k < length / 2; ++k)
    if (std::norm(line[k]) > std::norm(line[peak])) peak = k;
  const double tiny = 1e-300;
  const double a = std::log(std::norm(line[peak - 1]) + tiny), b = std::log(std::norm(line[peak]) + tiny),
               c = std::log(std::norm(line[peak + 1]) + tiny);
  const double bend = a - 2 * b + c;
  const double offset = bend < 0 ? 0.5 * (a - c) / bend : 0;
  return (static_cast<double>(peak) + offset) / (static_cast<double>(length) * dt);
}

}  // namespace erbs
