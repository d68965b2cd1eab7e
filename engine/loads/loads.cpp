#include "engine/loads/loads.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace erbs {

double value(const Wave& wave, double t) {
  return std::visit([&](const auto& w) { return value(w, t); }, wave);
}

double integral(const Wave& wave, double t) {
  return std::visit([&](const auto& w) { return area(w, t) - area(w, 0.0); }, wave);
}

double second_integral(const Wave& wave, double t) {
  return std::visit([&](const auto& w) { return double_area(w, t) - double_area(w, 0.0) - area(w, 0.0) * t; }, wave);
}

double mean(const Wave& wave, double t0, double t1) {
  return std::visit([&](const auto& w) { return mean(w, t0, t1); }, wave);
}

double end_time(const Wave& wave) {
  return std::visit([](const auto& w) { return end_time(w); }, wave);
}

namespace {

// How often a line turns back, by more than a thousandth of its range.
int turns_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double back = 1e-3 * (*high - *low);
  int turns = 0, way = 0;
  double extreme = values.front();
  for (const double value : values) {
    const double from = value - extreme;
    if (way * from >= 0 && (way != 0 || std::fabs(from) > back)) extreme = value, way = way != 0 ? way : from > 0 ? 1 : -1;
    else if (way != 0 && std::fabs(from) > back) extreme = value, way = -way, ++turns;
  }
  return turns;
}

}  // namespace

double following_step(const Wave& wave) {
  constexpr double share = 0.05, none = std::numeric_limits<double>::infinity();
  constexpr std::size_t swings = 10;  // points; fewer are ramps and leaps
  const auto of = [](const Polyline& line) {
    const std::size_t n = line.times.size();
    const int turns = n < swings ? 0 : turns_of(line.values);
    const double length = line.times.back() - line.times.front();
    return turns < 2 ? none : std::max(share * 2 * length / turns, length / double(n - 1));
  };
  return std::visit(
      [&](const auto& w) {
        if constexpr (requires { w.frequency; }) return share / w.frequency;
        else if constexpr (requires { w.line; }) return of(w.line);
        else if constexpr (requires { w.acceleration; }) return of(w.acceleration);
        else return none;
      },
      wave);
}

double resolution(const Wave& wave) {
  return std::visit([](const auto& w) { return resolution(w); }, wave);
}

}  // namespace erbs
