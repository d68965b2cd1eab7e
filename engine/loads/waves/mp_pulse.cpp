#include "engine/loads/waves/mp_pulse.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/units.h"

namespace erbs {
namespace {

double half(const MpPulse& w) { return 0.5 * w.gamma / w.frequency; }  // s, from the start to the middle

// v(x) = sum of c cos(omega x + nu)
struct Cosine {
  double c, omega;  // m/s, rad/s
};

std::array<Cosine, 3> cosines(const MpPulse& w) {
  const double omega = 2 * pi * w.frequency;
  return {Cosine{0.5 * w.amplitude, omega}, Cosine{0.25 * w.amplitude, omega * (1 + 1 / w.gamma)},
          Cosine{0.25 * w.amplitude, omega * (1 - 1 / w.gamma)}};
}

// Time since the middle, inside the pulse.
double inside(const MpPulse& w, double t) { return std::clamp(t - w.start - half(w), -half(w), half(w)); }

}  // namespace

double end_time(const MpPulse& wave) { return wave.start + 2 * half(wave); }

double residual_displacement(const MpPulse& w) {
  return -w.amplitude * std::cos(w.phase) * std::sin(pi * w.gamma) / (2 * pi * w.frequency * (w.gamma * w.gamma - 1));
}

double value(const MpPulse& wave, double t) {
  if (t < wave.start || t >= end_time(wave)) return 0;
  double sum = 0;
  for (const Cosine& one : cosines(wave)) sum -= one.c * one.omega * std::sin(one.omega * inside(wave, t) + wave.phase);
  return sum;
}

// The product form, exactly zero at both ends.
double area(const MpPulse& wave, double t) {
  const double x = inside(wave, t), envelope = std::cos(pi * wave.frequency * x / wave.gamma);
  if (std::fabs(x) >= half(wave)) return 0;
  return wave.amplitude * envelope * envelope * std::cos(2 * pi * wave.frequency * x + wave.phase);
}

// The velocity is zero after the pulse, so that the displacement stays. sin b - sin a as a product.
double double_area(const MpPulse& wave, double t) {
  const double x = inside(wave, t), from = -half(wave);
  double sum = 0;
  for (const Cosine& one : cosines(wave))
    sum += one.c / one.omega * 2 * std::cos(0.5 * one.omega * (x + from) + wave.phase) * std::sin(0.5 * one.omega * (x - from));
  return sum;
}

// The difference of two velocities, each cosine as a product: exact for any short interval.
double mean(const MpPulse& wave, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value(wave, t0);
  const double from = std::max(t0, wave.start), to = std::min(t1, end_time(wave));
  if (from >= to) return 0;
  const double middle = 0.5 * (from + to) - wave.start - half(wave);
  double sum = 0;
  for (const Cosine& one : cosines(wave))
    sum -= one.c * 2 * std::sin(one.omega * middle + wave.phase) * std::sin(0.5 * one.omega * (to - from));
  return sum / (t1 - t0);
}

}  // namespace erbs
