#include "engine/loads/waves/sine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace erbs {
namespace {

// Common form of the four waves: a sine inside a window of time.
struct Window {
  double amplitude, omega, phase, start, length;
};

Window window(const Sine& w) { return {w.amplitude, 2 * pi * w.frequency, w.phase, w.start, w.duration}; }
Window window(const HalfSine& w) {
  const double omega = 2 * pi * w.frequency;
  return {w.amplitude, omega, w.phase, w.start, (pi - w.phase) / omega};
}
Window window(const FullSine& w) {
  const double omega = 2 * pi * w.frequency;
  return {w.amplitude, omega, w.phase, w.start, (2 * pi - w.phase) / omega};
}

Window window(const FullCosine& w) { return {w.amplitude, 2 * pi * w.frequency, 0.5 * pi, w.start, 1 / w.frequency}; }

// x - sin x without loss of digits near 0.
double x_minus_sin(double x) {
  if (std::abs(x) > 0.5) return x - std::sin(x);
  double term = x * x * x / 6, sum = term;
  for (int k = 2; std::abs(term) > 1e-18 * std::abs(sum); ++k) {
    term *= -x * x / (2.0 * k * (2.0 * k + 1));
    sum += term;
  }
  return sum;
}

double value_in(const Window& w, double t) {
  if (t < w.start || t >= w.start + w.length) return 0;
  return w.amplitude * std::sin(w.omega * (t - w.start) + w.phase);
}

double area_in(const Window& w, double t) {
  const double half = 0.5 * w.omega * std::clamp(t - w.start, 0.0, w.length);
  return 2 * w.amplitude / w.omega * std::sin(half + w.phase) * std::sin(half);  // cos p - cos(x + p) as a product
}

double double_area_in(const Window& w, double t) {
  const double x = w.omega * std::clamp(t - w.start, 0.0, w.length), half = std::sin(0.5 * x);
  const double inside = w.amplitude / (w.omega * w.omega) * (std::cos(w.phase) * x_minus_sin(x) + std::sin(w.phase) * 2 * half * half);
  const double after = t - (w.start + w.length);
  return after > 0 ? inside + after * area_in(w, t) : inside;
}

double mean_in(const Window& w, double t0, double t1) {
  if (t1 < t0) std::swap(t0, t1);
  if (t0 == t1) return value_in(w, t0);
  const double from = std::max(t0, w.start), to = std::min(t1, w.start + w.length);
  if (from >= to) return 0;
  const double half = 0.5 * w.omega * (to - from);
  const double sinc = half < 1e-8 ? 1.0 : std::sin(half) / half;
  const double middle = w.omega * (0.5 * (from + to) - w.start) + w.phase;
  return w.amplitude * std::sin(middle) * sinc * ((to - from) / (t1 - t0));
}

}  // namespace

double value(const Sine& wave, double t) { return value_in(window(wave), t); }
double value(const HalfSine& wave, double t) { return value_in(window(wave), t); }
double value(const FullSine& wave, double t) { return value_in(window(wave), t); }
double value(const FullCosine& wave, double t) { return value_in(window(wave), t); }
double area(const Sine& wave, double t) { return area_in(window(wave), t); }
double area(const HalfSine& wave, double t) { return area_in(window(wave), t); }
double area(const FullSine& wave, double t) { return area_in(window(wave), t); }
double area(const FullCosine& wave, double t) { return area_in(window(wave), t); }
double double_area(const Sine& wave, double t) { return double_area_in(window(wave), t); }
double double_area(const HalfSine& wave, double t) { return double_area_in(window(wave), t); }
double double_area(const FullSine& wave, double t) { return double_area_in(window(wave), t); }
double double_area(const FullCosine& wave, double t) { return double_area_in(window(wave), t); }
double mean(const Sine& wave, double t0, double t1) { return mean_in(window(wave), t0, t1); }
double mean(const HalfSine& wave, double t0, double t1) { return mean_in(window(wave), t0, t1); }
double mean(const FullSine& wave, double t0, double t1) { return mean_in(window(wave), t0, t1); }
double mean(const FullCosine& wave, double t0, double t1) { return mean_in(window(wave), t0, t1); }
double end_time(const Sine& wave) { return wave.start + wave.duration; }
double end_time(const HalfSine& wave) { return wave.start + window(wave).length; }
double end_time(const FullSine& wave) { return wave.start + window(wave).length; }
double end_time(const FullCosine& wave) { return wave.start + window(wave).length; }

}  // namespace erbs
