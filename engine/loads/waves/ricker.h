// Ricker wavelet (Ricker 1940): A (1 - 2 x^2) exp(-x^2), x = pi f (t - peak time). One smooth pulse between two lobes of half its size,
// with zero velocity and displacement after it, as used for near-source ground motions. Zero where |x| > 6, below 1e-14 of the peak.
#pragma once
#include <cmath>

#include "engine/base/field.h"
#include "engine/base/units.h"

namespace erbs {

struct Ricker {
  double amplitude = 0;  // in the unit of its load
  double frequency = 0;  // Hz
  double start = 0;      // s

  static constexpr std::string_view wave_name = "ricker";
  static constexpr std::string_view help = "A Ricker wavelet: a smooth pulse between two lobes, its peak 6 / (pi frequency) after `start`.";
  static Fields<Ricker> fields() {
    return {
        {"amplitude", &Ricker::amplitude, "", "peak value, in the unit of the load", -unbounded, unbounded, true},
        {"frequency", &Ricker::frequency, "Hz", "frequency at which the spectrum peaks", 1e-9, 1e9, true},
        {"start", &Ricker::start, "s", "time of the first value, 6 / (pi frequency) before the peak", -1e9, 1e9},
    };
  }
  double half() const { return 6 / (pi * frequency); }              // s, from the start to the peak
  double since_peak(double t) const { return t - start - half(); }  // s
  double bell(double t) const {                                     // exp(-x^2)
    const double x = pi * frequency * since_peak(t);
    return std::fabs(x) > 6 ? 0 : std::exp(-x * x);
  }
};

// loads.h explains the six functions.
inline double value(const Ricker& wave, double t) {
  const double x = pi * wave.frequency * wave.since_peak(t);
  return wave.amplitude * (1 - 2 * x * x) * wave.bell(t);
}
inline double area(const Ricker& wave, double t) { return wave.amplitude * wave.since_peak(t) * wave.bell(t); }
inline double double_area(const Ricker& wave, double t) {
  return -wave.amplitude * wave.bell(t) / (2 * pi * pi * wave.frequency * wave.frequency);
}
// Over short intervals Gauss' rule with five points, which errs by 1e-15 there; the difference of areas would cancel.
inline double mean(const Ricker& wave, double t0, double t1) {
  if (t0 == t1) return value(wave, t0);
  if (std::fabs(t1 - t0) * wave.frequency > 0.05) return (area(wave, t1) - area(wave, t0)) / (t1 - t0);
  constexpr double place[] = {0, 0.5384693101056831, 0.9061798459386640},
                   weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  double sum = weight[0] * value(wave, 0.5 * (t0 + t1));
  for (int i = 1; i < 3; ++i)
    for (const double side : {-1.0, 1.0}) sum += weight[i] * value(wave, 0.5 * (t0 + t1) + side * place[i] * 0.5 * (t1 - t0));
  return 0.5 * sum;
}
inline double end_time(const Ricker& wave) { return wave.start + 2 * wave.half(); }
inline double resolution(const Ricker& wave) { return 0.02 / wave.frequency; }

}  // namespace erbs
