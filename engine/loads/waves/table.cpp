#include "engine/loads/waves/table.h"

#include <algorithm>
#include <utility>

namespace erbs {

Table make_table(std::vector<double> times, std::vector<double> values, bool hold) {
  return {make_polyline(std::move(times), std::move(values)), hold};
}

double end_time(const Table& wave) { return wave.line.times.back(); }

double value(const Table& wave, double t) {
  const bool inside = t >= wave.line.times.front() && t <= wave.line.times.back();
  return inside || wave.hold ? value_inside(wave.line, t) : 0.0;
}

double area(const Table& wave, double t) {
  const Polyline& line = wave.line;
  const double inside = area_inside(line, t);
  if (!wave.hold) return inside;
  const double before = std::min(0.0, t - line.times.front()), after = std::max(0.0, t - line.times.back());
  return inside + before * line.values.front() + after * line.values.back();
}

double double_area(const Table& wave, double t) {
  const Polyline& line = wave.line;
  const double before = std::min(0.0, t - line.times.front()), after = std::max(0.0, t - line.times.back());
  const double drift = double_area_inside(line, t) + after * line.area.back();
  if (!wave.hold) return drift;
  return drift + 0.5 * before * before * line.values.front() + 0.5 * after * after * line.values.back();
}

double mean(const Table& wave, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value(wave, t0);
  const Polyline& line = wave.line;
  const double first = line.times.front(), last = line.times.back();
  // Inside the table. Within one segment this gives the value at mid-time; only `hold` adds the parts beyond the ends.
  const double from = std::clamp(t0, first, last), to = std::clamp(t1, first, last);
  double sum = area_between(line, from, to);
  if (wave.hold)
    sum += std::max(0.0, std::min(t1, first) - t0) * line.values.front() + std::max(0.0, t1 - std::max(t0, last)) * line.values.back();
  return sum / (t1 - t0);
}

}  // namespace erbs
