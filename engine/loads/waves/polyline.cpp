#include "engine/loads/waves/polyline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"

namespace erbs {
namespace {

// Polynomials on segment i; s is the time since its first point.
double slope(const Polyline& p, size_t i) { return (p.values[i + 1] - p.values[i]) / (p.times[i + 1] - p.times[i]); }
double area_in(const Polyline& p, size_t i, double s) { return p.area[i] + s * (p.values[i] + 0.5 * slope(p, i) * s); }
double double_area_in(const Polyline& p, size_t i, double s) {
  return p.double_area[i] + s * (p.area[i] + s * (0.5 * p.values[i] + slope(p, i) * s / 6));
}

// Interpolation from both ends: exact at a point, from either of its two segments.
double value_in(const Polyline& p, size_t i, double t) {
  const double share = (t - p.times[i]) / (p.times[i + 1] - p.times[i]);
  return (1 - share) * p.values[i] + share * p.values[i + 1];
}

void check_points(const Polyline& p) {
  if (p.times.size() != p.values.size())
    throw Error(fmt::format("{} times but {} values; give one value for each time", p.times.size(), p.values.size()));
  if (p.times.size() < 2) throw Error(fmt::format("{} point(s) make no line; give at least two", p.times.size()));
  for (size_t i = 0; i < p.times.size(); ++i) {
    if (!std::isfinite(p.times[i]) || !std::isfinite(p.values[i]))
      throw Error(fmt::format("point {} is not finite ({}, {}); give finite numbers", i + 1, p.times[i], p.values[i]));
    if (i > 0 && p.times[i] <= p.times[i - 1])
      throw Error(fmt::format("time {} of point {} does not come after {}; times must increase", p.times[i], i + 1, p.times[i - 1]));
  }
}

}  // namespace

Polyline make_polyline(std::vector<double> times, std::vector<double> values) {
  Polyline p{std::move(times), std::move(values), {}, {}};
  check_points(p);
  p.area.resize(p.times.size());
  p.double_area.resize(p.times.size());
  for (size_t i = 0; i + 1 < p.times.size(); ++i) {
    const double h = p.times[i + 1] - p.times[i];
    p.area[i + 1] = p.area[i] + 0.5 * h * (p.values[i] + p.values[i + 1]);
    p.double_area[i + 1] = p.double_area[i] + h * (p.area[i] + h * (2 * p.values[i] + p.values[i + 1]) / 6);
  }
  return p;
}

int segment(const Polyline& p, double t) {
  const auto last = static_cast<double>(p.times.size() - 2);
  // For evenly spaced points, the usual case, the first guess is right.
  const double guess = (t - p.times.front()) / (p.times.back() - p.times.front()) * (last + 1);
  const auto i = static_cast<size_t>(std::clamp(guess, 0.0, last));
  if ((i == 0 || p.times[i] <= t) && (i + 2 == p.times.size() || t < p.times[i + 1])) return static_cast<int>(i);
  const auto after = std::upper_bound(p.times.begin() + 1, p.times.end() - 1, t);
  return static_cast<int>(after - p.times.begin()) - 1;
}

double value_inside(const Polyline& p, double t) {
  t = std::clamp(t, p.times.front(), p.times.back());
  return value_in(p, static_cast<size_t>(segment(p, t)), t);
}

double area_inside(const Polyline& p, double t) {
  t = std::clamp(t, p.times.front(), p.times.back());
  const auto i = static_cast<size_t>(segment(p, t));
  return area_in(p, i, t - p.times[i]);
}

double double_area_inside(const Polyline& p, double t) {
  t = std::clamp(t, p.times.front(), p.times.back());
  const auto i = static_cast<size_t>(segment(p, t));
  return double_area_in(p, i, t - p.times[i]);
}

double area_between(const Polyline& p, double t0, double t1) {
  if (t1 < t0) return -area_between(p, t1, t0);
  t0 = std::clamp(t0, p.times.front(), p.times.back());
  t1 = std::clamp(t1, p.times.front(), p.times.back());
  const auto i = static_cast<size_t>(segment(p, t0)), j = static_cast<size_t>(segment(p, t1));
  // Within one segment the mean is the value at mid-time.
  if (i == j) return (t1 - t0) * value_in(p, i, 0.5 * (t0 + t1));
  const double head = (p.times[i + 1] - t0) * value_in(p, i, 0.5 * (t0 + p.times[i + 1]));
  const double tail = (t1 - p.times[j]) * value_in(p, j, 0.5 * (p.times[j] + t1));
  return head + (p.area[j] - p.area[i + 1]) + tail;
}

double shortest_interval(const Polyline& line) {
  double least = line.times.back() - line.times.front();
  for (std::size_t i = 1; i < line.times.size(); ++i) least = std::min(least, line.times[i] - line.times[i - 1]);
  return least;
}

}  // namespace erbs
