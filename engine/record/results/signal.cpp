#include "engine/record/results/signal.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
using Complex = std::complex<double>;

void check(const std::vector<double>& t, const std::vector<double>& y) {
  if (t.size() != y.size()) throw Error(fmt::format("{} times but {} values; take both from the same table", t.size(), y.size()));
}

// FFT of radix 2, in place (Cooley and Tukey 1965). The size must be a power of two.
void transform(std::vector<Complex>& a) {
  const std::size_t n = a.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(a[i], a[j]);
  }
  for (std::size_t length = 2; length <= n; length *= 2) {
    // Each factor comes from its own angle: a running product would lose digits over long records.
    std::vector<Complex> factor(length / 2);
    for (std::size_t k = 0; k < length / 2; ++k) factor[k] = std::polar(1.0, -2 * pi * double(k) / double(length));
    for (std::size_t i = 0; i < n; i += length)
      for (std::size_t k = 0; k < length / 2; ++k) {
        const Complex even = a[i + k], odd = a[i + k + length / 2] * factor[k];
        a[i + k] = even + odd;
        a[i + k + length / 2] = even - odd;
      }
  }
}

// y resampled to even time steps; y itself if its steps are even.
std::vector<double> evened(const std::vector<double>& t, const std::vector<double>& y, double& dt) {
  const std::size_t n = t.size();
  dt = (t.back() - t.front()) / double(n - 1);
  double uneven = 0;
  for (std::size_t i = 0; i < n; ++i) uneven = std::max(uneven, std::abs(t[i] - t.front() - double(i) * dt));
  if (uneven < 1e-6 * dt) return y;
  std::vector<double> even(n);
  std::size_t k = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = std::min(t.front() + double(i) * dt, t.back());
    while (k + 2 < n && t[k + 1] < at) ++k;
    const double step = t[k + 1] - t[k];
    even[i] = step > 0 ? y[k] + (y[k + 1] - y[k]) * (at - t[k]) / step : y[k];
  }
  return even;
}

}  // namespace

SamplePeak peak(const std::vector<double>& t, const std::vector<double>& y) {
  check(t, y);
  SamplePeak best{unknown, unknown};
  for (std::size_t i = 0; i < y.size(); ++i)
    if (std::isfinite(y[i]) && !(std::abs(y[i]) <= std::abs(best.value))) best = {y[i], t[i]};
  return best;
}

double mean(const std::vector<double>& t, const std::vector<double>& y) {
  check(t, y);
  if (y.size() < 2 || !(t.back() > t.front())) return y.empty() ? unknown : y.front();
  double sum = 0;
  for (std::size_t i = 1; i < y.size(); ++i) sum += 0.5 * (t[i] - t[i - 1]) * (y[i] + y[i - 1]);
  return sum / (t.back() - t.front());
}

double rms(const std::vector<double>& t, const std::vector<double>& y) {
  check(t, y);
  if (y.size() < 2 || !(t.back() > t.front())) return y.empty() ? unknown : std::abs(y.front());
  // Between rows that do not resolve a vibration a line would lose up to a third of its power; the mean of their squares does not.
  double sum = 0;
  for (std::size_t i = 1; i < y.size(); ++i) sum += 0.5 * (t[i] - t[i - 1]) * (y[i - 1] * y[i - 1] + y[i] * y[i]);
  return std::sqrt(sum / (t.back() - t.front()));
}

Spectrum spectrum(const std::vector<double>& t, const std::vector<double>& y) {
  check(t, y);
  Spectrum s;
  if (y.size() < 8 || !(t.back() > t.front())) return s;
  double dt = 0;
  const std::vector<double> even = evened(t, y, dt);
  const std::size_t n = even.size();
  double average = 0;
  for (const double value : even) average += value / double(n);
  std::size_t padded = 1;
  while (padded < 4 * n) padded *= 2;
  std::vector<Complex> a(padded);
  double weights = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double window = 0.5 - 0.5 * std::cos(2 * pi * double(i) / double(n - 1));
    a[i] = (even[i] - average) * window;
    weights += window;
  }
  transform(a);
  for (std::size_t k = 0; k <= padded / 2; ++k) {
    s.frequency.push_back(double(k) / (double(padded) * dt));
    s.amplitude.push_back(2 * std::abs(a[k]) / weights);
  }
  return s;
}

double dominant_frequency(const std::vector<double>& t, const std::vector<double>& y, double from, double to) {
  const Spectrum s = spectrum(t, y);
  if (s.amplitude.empty()) return unknown;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  if (!(*high - *low > 1e-13 * largest)) return unknown;  // constant up to round-off
  const auto bin = [&](double f) { return std::lower_bound(s.frequency.begin(), s.frequency.end(), f) - s.frequency.begin(); };
  const auto first = bin(from), last = bin(to);
  if (first >= last) return unknown;
  // A slope that enters a band is the flank of a peak outside of it.
  const auto& all = s.amplitude;
  std::size_t k = all.size();
  for (auto i = std::size_t(first); i < std::size_t(last); ++i) {
    const bool peaks = (i == 0 || all[i - 1] <= all[i]) && (i + 1 == all.size() || all[i + 1] <= all[i]);
    if (peaks && (k == all.size() || all[i] > all[k])) k = i;
  }
  if (k == all.size() || !std::isfinite(all[k])) return unknown;
  if (k == 0 || k + 1 == all.size()) return s.frequency[k];
  const double a = std::log(s.amplitude[k - 1]), b = std::log(s.amplitude[k]), c = std::log(s.amplitude[k + 1]);
  const double curvature = a - 2 * b + c;
  const double shift = curvature < 0 ? 0.5 * (a - c) / curvature : 0.0;  // in bins
  return std::clamp(s.frequency[k] + shift * s.frequency[1], from, std::max(from, to));
}

std::vector<double> crossings(const std::vector<double>& t, const std::vector<double>& y, double level, bool rising) {
  check(t, y);
  std::vector<double> times;
  int side = 0;          // sign of the last sample off the level
  std::size_t last = 0;  // its index
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double d = y[i] - level;
    const int now = d > 0 ? 1 : d < 0 ? -1 : 0;
    if (now == 0) continue;
    if (side != 0 && now != side && (!rising || now > 0)) {
      // Samples in between lie on the level: the first of them is the crossing.
      if (i - last > 1) times.push_back(t[last + 1]);
      else times.push_back(t[last] + (t[i] - t[last]) * (level - y[last]) / (y[i] - y[last]));
    }
    side = now;
    last = i;
  }
  return times;
}

double period(const std::vector<double>& t, const std::vector<double>& y) {
  const std::vector<double> up = crossings(t, y, 0, true);
  return up.size() < 2 ? unknown : (up.back() - up.front()) / double(up.size() - 1);
}

}  // namespace erbs
