#include "engine/loads/waves/pulse.h"

#include <algorithm>
#include <utility>

namespace erbs {

double end_time(const Pulse& wave) { return wave.start + wave.duration; }

double value(const Pulse& wave, double t) { return t >= wave.start && t < end_time(wave) ? wave.amplitude : 0.0; }

double area(const Pulse& wave, double t) { return wave.amplitude * std::clamp(t - wave.start, 0.0, wave.duration); }

double double_area(const Pulse& wave, double t) {
  const double inside = std::clamp(t - wave.start, 0.0, wave.duration), after = t - end_time(wave);
  return wave.amplitude * inside * (0.5 * inside + std::max(0.0, after));
}

double mean(const Pulse& wave, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value(wave, t0);
  const double inside = std::min(t1, end_time(wave)) - std::max(t0, wave.start);
  return inside > 0 ? wave.amplitude * (inside / (t1 - t0)) : 0.0;
}

}  // namespace erbs
