#include "engine/loads/record/record_report.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "engine/base/units.h"

namespace erbs {
namespace {

void raise(Peak& peak, double value, double time) {
  if (std::abs(value) > std::abs(peak.value)) peak = {value, time};
}

Peak largest(const std::vector<double>& times, const std::vector<double>& values) {
  Peak peak;
  for (size_t i = 0; i < times.size(); ++i) raise(peak, values[i], times[i]);
  return peak;
}

// The velocity of a segment is largest at its ends or at a zero of the acceleration.
Peak largest_velocity(const Polyline& a) {
  Peak peak;
  for (size_t i = 0; i < a.times.size(); ++i) {
    raise(peak, a.area[i], a.times[i]);
    if (i + 1 == a.times.size() || a.values[i] * a.values[i + 1] >= 0) continue;
    const double t = a.times[i] + (a.times[i + 1] - a.times[i]) * a.values[i] / (a.values[i] - a.values[i + 1]);
    raise(peak, area_inside(a, t), t);
  }
  return peak;
}

// The displacement of a segment is largest at its ends or at a zero of the velocity v + a s + slope s^2 / 2.
Peak largest_displacement(const Polyline& a) {
  Peak peak;
  for (size_t i = 0; i < a.times.size(); ++i) {
    raise(peak, a.double_area[i], a.times[i]);
    if (i + 1 == a.times.size()) continue;
    const double h = a.times[i + 1] - a.times[i], half_slope = 0.5 * (a.values[i + 1] - a.values[i]) / h;
    const double root = a.values[i] * a.values[i] - 4 * half_slope * a.area[i];
    if (root < 0) continue;
    // Roots of the quadratic in the form that loses no digits: q / A and C / q.
    const double q = -0.5 * (a.values[i] + std::copysign(std::sqrt(root), a.values[i]));
    for (const double s : {half_slope != 0 ? q / half_slope : -1.0, q != 0 ? a.area[i] / q : -1.0})
      if (s > 0 && s < h) raise(peak, double_area_inside(a, a.times[i] + s), a.times[i] + s);
  }
  return peak;
}

// Int a^2 over the time s from the start of a segment, where a = a0.
double square_area(double a0, double slope, double s) { return s * (a0 * a0 + s * slope * (a0 + s * slope / 3)); }

// Arias intensity pi / (2 g) Int a^2 dt (Arias 1970), and the times at 5 and 95 % of it (Trifunac and Brady 1975).
void arias(const Polyline& a, RecordReport& r) {
  std::vector<double> sum(a.times.size(), 0.0);
  const auto slope = [&](size_t i) { return (a.values[i + 1] - a.values[i]) / (a.times[i + 1] - a.times[i]); };
  for (size_t i = 0; i + 1 < a.times.size(); ++i) sum[i + 1] = sum[i] + square_area(a.values[i], slope(i), a.times[i + 1] - a.times[i]);
  r.arias = pi / (2 * standard_g) * sum.back();
  const auto when = [&](double share) {
    const double wanted = share * sum.back();
    const auto after = std::lower_bound(sum.begin() + 1, sum.end() - 1, wanted);
    const auto i = static_cast<size_t>(after - sum.begin()) - 1;
    double low = 0, high = a.times[i + 1] - a.times[i];
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (sum[i] + square_area(a.values[i], slope(i), middle) < wanted ? low : high) = middle;
    }
    return a.times[i] + low;
  };
  r.time_5 = when(0.05);
  r.time_95 = when(0.95);
}

}  // namespace

RecordReport report(const Record& record) {
  const Polyline& a = record.acceleration;
  RecordReport r;
  r.file = record.file;
  r.title = record.title;
  r.format = record.format;
  r.hash = record.hash;
  r.note = record.note;
  r.points = record.points;
  r.dt = record.file_dt * record.time_factor;
  r.duration = a.times.back();
  r.pga = largest(a.times, a.values);
  r.pgv = largest(a.times, a.area);
  r.shortest_dt = a.times.size() > 1 ? a.times[1] - a.times[0] : 0;
  for (std::size_t i = 1; i < a.times.size(); ++i) {
    r.shortest_dt = std::min(r.shortest_dt, a.times[i] - a.times[i - 1]);
    r.longest_dt = std::max(r.longest_dt, a.times[i] - a.times[i - 1]);
  }
  r.pgd = largest(a.times, a.double_area);
  r.true_pgv = largest_velocity(a);
  r.true_pgd = largest_displacement(a);
  r.end_velocity = a.area.back();
  r.end_displacement = a.double_area.back();
  arias(a, r);
  r.spectrum = response_spectrum(a, spectrum_periods(0.02, 5, 241), 0.05);
  for (const ResponsePoint& point : r.spectrum)
    if (point.acceleration > r.spectrum_peak.acceleration) r.spectrum_peak = point;
  return r;
}

void print(std::ostream& out, const RecordReport& r) {
  const std::string step =
      r.dt > 0 ? fmt::format("{:.6g} s", r.dt) : fmt::format("uneven, {:.6g} to {:.6g} s", r.shortest_dt, r.longest_dt);
  const auto row = [&](std::string_view name, const std::string& text) { out << fmt::format("{:<22} {}\n", name, text); };
  row("file", r.file);
  if (!r.title.empty()) row("title", r.title);
  row("format", fmt::format("{}, fnv1a {}", r.format, r.hash));
  if (!r.note.empty()) row("corrected", r.note);
  row("points", fmt::format("{}", r.points));
  row("dt", step);
  row("duration", fmt::format("{:.6g} s", r.duration));
  row("PGA", fmt::format("{:.5f} g = {:.4f} m/s2 at {:.3f} s", std::abs(r.pga.value) / standard_g, std::abs(r.pga.value), r.pga.time));
  const auto peak_row = [&](std::string_view name, const Peak& points, const Peak& pieces, std::string_view unit) {
    row(name, fmt::format("{:.4f} {} at {:.3f} s (between points {:.4f} {} at {:.3f} s)", std::abs(points.value), unit, points.time,
                          std::abs(pieces.value), unit, pieces.time));
  };
  peak_row("PGV", r.pgv, r.true_pgv, "m/s");
  peak_row("PGD", r.pgd, r.true_pgd, "m");
  row("end velocity", fmt::format("{:.1e} m/s", r.end_velocity));
  row("end displacement", fmt::format("{:.1f} mm", std::round(1e4 * r.end_displacement) / 10 + 0.0));  // + 0.0: no "-0.0"
  row("Arias intensity", fmt::format("{:.4f} m/s", r.arias));
  row("duration D5-95", fmt::format("{:.2f} s, from {:.2f} to {:.2f} s", r.time_95 - r.time_5, r.time_5, r.time_95));
  row("largest Sa at 5 %", fmt::format("{:.4f} g at T = {:.3f} s", r.spectrum_peak.acceleration / standard_g, r.spectrum_peak.period));
}

}  // namespace erbs
