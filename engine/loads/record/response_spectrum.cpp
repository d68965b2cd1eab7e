#include "engine/loads/record/response_spectrum.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"

namespace erbs {
namespace {

struct Oscillator {
  double omega, damping, damped;  // rad/s, ratio, rad/s
  double u = 0, v = 0;            // m, m/s, relative to the ground
};

struct Decay {
  double h, exponential, cosine, sine;  // of one substep
};

Decay decay_over(const Oscillator& o, double h) {
  return {h, std::exp(-o.damping * o.omega * h), std::cos(o.damped * h), std::sin(o.damped * h)};
}

// One substep under the ground acceleration a0 + slope s, by the exact solution of
//   u'' + 2 z w u' + w^2 u = -(a0 + slope s)
// (Nigam and Jennings 1969, eqs. 2.4-2.7). The particular solution is p + q s; the rest decays.
void advance(Oscillator& o, const Decay& d, double a0, double slope) {
  const double w = o.omega, z = o.damping;
  const double q = -slope / (w * w), p = -(a0 + 2 * z * w * q) / (w * w);
  const double c1 = o.u - p, c2 = (o.v - q + z * w * c1) / o.damped;
  const double free_u = d.exponential * (c1 * d.cosine + c2 * d.sine);
  const double free_v = d.exponential * o.damped * (c2 * d.cosine - c1 * d.sine) - z * w * free_u;
  o.u = free_u + p + q * d.h;
  o.v = free_v + q;
}

// Largest displacement of the free vibration from here on, m: where its velocity vanishes for the first time.
double largest_free(Oscillator o) {
  const double w = o.omega, z = o.damping, along = w * w * o.u + z * w * o.v;
  double t = std::atan2(o.v * o.damped, along) / o.damped;
  if (t < 0) t += pi / o.damped;
  advance(o, decay_over(o, t), 0, 0);
  return std::abs(o.u);
}

constexpr int samples = 40;         // of the response, per period
constexpr int most = 40 * samples;  // of one segment: by then a damped oscillator only follows the ground

double largest_response(const Polyline& a, double period, double damping_ratio) {
  const double omega = 2 * pi / period;
  Oscillator o{omega, damping_ratio, omega * std::sqrt(1 - damping_ratio * damping_ratio)};
  double peak = 0;
  const auto go = [&](const Decay& d, double a0, double slope) {
    advance(o, d, a0, slope);
    peak = std::max(peak, std::abs(o.u));
  };
  Decay decay{};
  int count = 0;
  double last_h = -1;
  for (size_t i = 0; i + 1 < a.times.size(); ++i) {
    const double h = a.times[i + 1] - a.times[i], slope = (a.values[i + 1] - a.values[i]) / h;
    if (std::abs(h - last_h) > 1e-13 * a.times.back()) {  // steps of an even record differ by round-off only
      last_h = h;
      count = static_cast<int>(std::clamp(std::ceil(h * samples / period), 1.0, 1.0 * most));
      decay = decay_over(o, std::min(h / count, period / samples));
    }
    for (int k = 0; k < count; ++k) go(decay, a.values[i] + slope * decay.h * k, slope);
    const double rest = h - count * decay.h;
    if (count == most && rest > 0) go(decay_over(o, rest), a.values[i] + slope * (h - rest), slope);
  }
  return std::max(peak, largest_free(o));
}

}  // namespace

std::vector<ResponsePoint> response_spectrum(const Polyline& acceleration, const std::vector<double>& periods, double damping_ratio) {
  std::vector<ResponsePoint> spectrum;
  for (const double period : periods) {
    const double displacement = largest_response(acceleration, period, damping_ratio), omega = 2 * pi / period;
    spectrum.push_back({period, displacement, displacement * omega * omega});
  }
  return spectrum;
}

std::vector<double> spectrum_periods(double low, double high, int count) {
  std::vector<double> periods;
  for (int i = 0; i < count; ++i) periods.push_back(low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
  return periods;
}

}  // namespace erbs
