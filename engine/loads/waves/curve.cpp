#include "engine/loads/waves/curve.h"

#include <algorithm>
#include <utility>

namespace erbs {
namespace {

using std::size_t;

// The cubic on segment i and its integrals; s is the time since its first point.
struct Cubic {
  double y, slope, bend, jerk;

  Cubic(const Curve& p, size_t i) : y(p.line.values[i]), bend(p.bend[i]) {
    const double h = p.line.times[i + 1] - p.line.times[i];
    slope = (p.line.values[i + 1] - y) / h - h * (2 * bend + p.bend[i + 1]) / 6;
    jerk = (p.bend[i + 1] - bend) / h;
  }
  double value(double s) const { return y + s * (slope + s * (bend / 2 + s * jerk / 6)); }
  double area(double s) const { return s * (y + s * (slope / 2 + s * (bend / 6 + s * jerk / 24))); }
  double double_area(double s) const { return s * s * (y / 2 + s * (slope / 6 + s * (bend / 24 + s * jerk / 120))); }
};

size_t segment_at(const Curve& p, double t) { return size_t(segment(p.line, t)); }
double inside(const Curve& p, double t) { return std::clamp(t, p.line.times.front(), p.line.times.back()); }
double before(const Curve& p, double t) { return std::min(0.0, t - p.line.times.front()); }
double after(const Curve& p, double t) { return std::max(0.0, t - p.line.times.back()); }

// Slope at the first of three points of the parabola through them.
double slope_at_first(double x0, double y0, double x1, double y1, double x2, double y2) {
  const double first = (y1 - y0) / (x1 - x0), second = (y2 - y1) / (x2 - x1);
  return first - (second - first) * (x1 - x0) / (x2 - x0);
}

// Second derivatives at the points: those of neighbours balance so that the slope has no jump (Thomas's algorithm). A curve that is held
// has the slope zero at its ends, else that of the parabola through three points.
std::vector<double> bend_of(const Polyline& line, bool hold) {
  const std::vector<double>&x = line.times, &y = line.values;
  const size_t n = x.size(), e = n - 1;
  std::vector<double> bend(n, 0.0), upper(n, 0.0);
  if (n < 3 && !hold) return bend;
  const double first = hold ? 0 : slope_at_first(x[0], y[0], x[1], y[1], x[2], y[2]),
               last = hold ? 0 : slope_at_first(x[e], y[e], x[e - 1], y[e - 1], x[e - 2], y[e - 2]);
  for (size_t i = 0; i < n; ++i) {
    const double low = i > 0 ? x[i] - x[i - 1] : 0, high = i < e ? x[i + 1] - x[i] : 0;
    const double from = i > 0 ? (y[i] - y[i - 1]) / low : first, to = i < e ? (y[i + 1] - y[i]) / high : last;
    const double pivot = 2 * (low + high) - (i > 0 ? low * upper[i - 1] : 0);
    upper[i] = high / pivot;
    bend[i] = (6 * (to - from) - (i > 0 ? low * bend[i - 1] : 0)) / pivot;
  }
  for (size_t i = e; i-- > 0;) bend[i] -= upper[i] * bend[i + 1];
  return bend;
}

}  // namespace

Curve make_curve(std::vector<double> times, std::vector<double> values, bool hold) {
  Curve p{make_polyline(std::move(times), std::move(values)), {}, hold};
  p.bend = bend_of(p.line, hold);
  Polyline& line = p.line;
  for (size_t i = 0; i + 1 < line.times.size(); ++i) {
    const Cubic cubic(p, i);
    const double h = line.times[i + 1] - line.times[i];
    line.area[i + 1] = line.area[i] + cubic.area(h);
    line.double_area[i + 1] = line.double_area[i] + h * line.area[i] + cubic.double_area(h);
  }
  return p;
}

double end_time(const Curve& wave) { return wave.line.times.back(); }

double value(const Curve& wave, double t) {
  const double at = inside(wave, t);
  if (at != t && !wave.hold) return 0;
  const size_t i = segment_at(wave, at);
  return at == wave.line.times[i + 1] ? wave.line.values[i + 1] : Cubic(wave, i).value(at - wave.line.times[i]);
}

double area(const Curve& wave, double t) {
  const double at = inside(wave, t);
  const size_t i = segment_at(wave, at);
  const double own = wave.line.area[i] + Cubic(wave, i).area(at - wave.line.times[i]);
  return wave.hold ? own + before(wave, t) * wave.line.values.front() + after(wave, t) * wave.line.values.back() : own;
}

double double_area(const Curve& wave, double t) {
  const double at = inside(wave, t), early = before(wave, t), late = after(wave, t);
  const size_t i = segment_at(wave, at);
  const double s = at - wave.line.times[i];
  const double own = wave.line.double_area[i] + s * wave.line.area[i] + Cubic(wave, i).double_area(s) + late * wave.line.area.back();
  return wave.hold ? own + 0.5 * early * early * wave.line.values.front() + 0.5 * late * late * wave.line.values.back() : own;
}

double mean(const Curve& wave, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value(wave, t0);
  const double from = inside(wave, t0), to = inside(wave, t1);
  const size_t i = segment_at(wave, from), j = segment_at(wave, to);
  // Simpson's rule is exact for a cubic, and within one segment nothing cancels.
  const auto part = [&](size_t k, double a, double b) {
    const Cubic cubic(wave, k);
    const double s = a - wave.line.times[k], e = b - wave.line.times[k];
    return (b - a) / 6 * (cubic.value(s) + 4 * cubic.value(0.5 * (s + e)) + cubic.value(e));
  };
  double sum = i == j
                   ? part(i, from, to)
                   : part(i, from, wave.line.times[i + 1]) + (wave.line.area[j] - wave.line.area[i + 1]) + part(j, wave.line.times[j], to);
  if (wave.hold) {
    const double first = wave.line.times.front(), last = wave.line.times.back();
    sum += std::max(0.0, std::min(t1, first) - t0) * wave.line.values.front() +
           std::max(0.0, t1 - std::max(t0, last)) * wave.line.values.back();
  }
  return sum / (t1 - t0);
}

}  // namespace erbs
