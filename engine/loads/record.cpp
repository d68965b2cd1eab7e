#include "engine/loads/record.h"

#include <algorithm>
#include <utility>

namespace erbs {

double end_time(const Record& wave) { return wave.start + wave.acceleration.times.back(); }

double value(const Record& wave, double t) {
  const Polyline& a = wave.acceleration;
  const double s = t - wave.start;
  return s < a.times.front() || s > a.times.back() ? 0.0 : value_inside(a, s);
}

double area(const Record& wave, double t) { return area_inside(wave.acceleration, t - wave.start); }

double double_area(const Record& wave, double t) {
  const Polyline& a = wave.acceleration;
  const double s = t - wave.start;
  return double_area_inside(a, s) + std::max(0.0, s - a.times.back()) * a.area.back();
}

double mean(const Record& wave, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value(wave, t0);
  const Polyline& a = wave.acceleration;
  const double s0 = t0 - wave.start, s1 = t1 - wave.start;
  return s1 > s0 ? area_between(a, s0, s1) / (s1 - s0) : value(wave, t0);
}

}  // namespace erbs
