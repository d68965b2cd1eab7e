#include "engine/record/plot/record_plot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/plot/figure.h"

namespace erbs {
namespace {

struct Quantity {
  std::string title, symbol, unit, color;
  int column;
  Peak peak;  // in the unit
  double bottom, top;
  double before = 0;  // largest value before correction, in the unit
};

constexpr const char* grey = "#b9b3a8";

// Rows of time, a (g), v (m/s), d (m). Short records get points in between, since v and d are curved; long ones would make large files.
std::string histories(const Polyline& a) {
  const int parts = a.times.size() < 2500 ? 3 : 1;
  std::string text;
  for (size_t i = 0; i < a.times.size(); ++i)
    for (int k = 0; k < (i + 1 < a.times.size() ? parts : 1); ++k) {
      const double t = k == 0 ? a.times[i] : a.times[i] + k * (a.times[i + 1] - a.times[i]) / parts;
      text += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", t, value_inside(a, t) / standard_g, area_inside(a, t), double_area_inside(a, t));
    }
  return text;
}

std::string spectrum(const RecordReport& r) {
  std::string text;
  for (const ResponsePoint& point : r.spectrum) text += fmt::format("{:.6g} {:.6g}\n", point.period, point.acceleration / standard_g);
  return text;
}

// The step (1, 2 or 5 times a power of ten) that gives one to four tics up to `reach`.
double tic_step(double reach) {
  const double decade = std::pow(10, std::floor(std::log10(reach)));
  const double lead = reach / decade;
  return decade * (lead < 2 ? 0.5 : lead < 4 ? 1 : lead < 8 ? 2 : 5);
}

// A circle at the peak, with its value on the side that has room.
plot::Label marker(double x, double y, const std::string& text, bool left, double gap, double lift, const std::string& color) {
  return {text, fmt::format("{:.8g},{:.8g}", x, y),
          fmt::format("{} offset {},{} point pt 7 ps 0.8 lc rgb '{}' front", left ? "right" : "left", left ? -gap : gap, lift, color)};
}

plot::Panel history_panel(const Quantity& q, const RecordReport& r, const std::string& rows, const std::string& before) {
  // At least 1e-12 gives a record of zeros an axis too. A drift before correction is cut at thrice the corrected peak.
  const double own = std::max(1.28 * std::abs(q.peak.value), 1e-12), reach = std::clamp(1.05 * std::abs(q.before), own, 3 * own);
  const bool last = q.column == 4;
  plot::Panel p;
  p.axes = {0.075, 0.6, q.bottom, q.top};
  p.x = {last ? "time (s)" : "", fmt::format("[0:{:.8g}]", r.duration), "", last ? "" : "none", "offset 0,0.3"};
  p.y = {"", fmt::format("[{:.8g}:{:.8g}]", -reach, reach), fmt::format("{:.8g}", tic_step(reach))};
  p.settings = fmt::format("set object rectangle from {:.8g}, graph 0 to {:.8g}, graph 1 fc rgb '#f3efe8' fs solid noborder behind\n",
                           r.time_5, r.time_95);
  p.add_horizontal(0, "lc rgb '#9a9a9a' lw 1");
  p.labels = {{q.title, "graph 0, graph 1.1", fmt::format("left tc rgb '{}' font ',14'", q.color)},
              // a ylabel would move with the tic labels
              {fmt::format("{} ({})", q.symbol, q.unit), fmt::format("screen 0.02,{}", 0.5 * (q.bottom + q.top)), "center rotate by 90"},
              marker(q.peak.time, q.peak.value, fmt::format("{:.4f} {} at {:.2f} s", std::abs(q.peak.value), q.unit, q.peak.time),
                     q.peak.time > 0.6 * r.duration, 1, q.peak.value > 0 ? 0 : -0.4, q.color)};
  if (!before.empty()) p.series.push_back({fmt::format("{} using 1:{}", before, q.column), fmt::format("lines lw 1.1 lc rgb '{}'", grey)});
  p.series.push_back({fmt::format("{} using 1:{}", rows, q.column), fmt::format("lines lw 1.1 lc rgb '{}'", q.color)});
  return p;
}

plot::Panel spectrum_panel(const RecordReport& r, const std::string& rows, const std::string& before, double before_top) {
  const double top = std::max(r.spectrum_peak.acceleration / standard_g, 1e-12);
  plot::Panel p;
  p.axes = {0.685, 0.975, 0.40, 0.865};
  p.x = {"period T (s)",
         fmt::format("[{:.8g}:{:.8g}]", r.spectrum.front().period, r.spectrum.back().period),
         "(0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5)",
         "",
         "offset 0,0.3",
         true};
  p.y = {"pseudo-acceleration Sa (g)", fmt::format("[0:{:.8g}]", 1.2 * std::max(top, before_top)), "", "", "offset 0.6,0"};
  const char* color = "#5b3a78";
  p.labels = {{"Response spectrum, 5 % damping", "graph 0, graph 1.045", fmt::format("left tc rgb '{}' font ',14'", color)},
              marker(r.spectrum_peak.period, top, fmt::format("{:.3f} g at {:.2f} s", top, r.spectrum_peak.period),
                     r.spectrum_peak.period > 0.5, 0.6, 0.2, color)};
  if (!before.empty()) p.series.push_back({before + " using 1:2", fmt::format("lines lw 1.8 lc rgb '{}'", grey)});
  p.series.push_back({rows + " using 1:2", fmt::format("lines lw 1.8 lc rgb '{}'", color)});
  return p;
}

// Names and values below the spectrum.
void add_summary(const RecordReport& r, std::vector<plot::Label>& labels) {
  const std::pair<std::string, std::string> rows[] = {
      {"points, step", fmt::format("{}, {}", r.points, r.dt > 0 ? fmt::format("{:.5g} s", r.dt) : "uneven")},
      {"PGA", fmt::format("{:.5f} g", std::abs(r.pga.value) / standard_g)},
      {"PGV", fmt::format("{:.4f} m/s", std::abs(r.pgv.value))},
      {"PGD", fmt::format("{:.4f} m", std::abs(r.pgd.value))},
      {"end velocity", fmt::format("{:.1e} m/s", r.end_velocity)},
      {"end displacement", fmt::format("{:.1f} mm", std::round(1e4 * r.end_displacement) / 10 + 0.0)},
      {"Arias intensity", fmt::format("{:.3f} m/s", r.arias)},
      {"duration D5-95 (shaded)", fmt::format("{:.2f} s", r.time_95 - r.time_5)},
  };
  double y = 0.285;
  for (const auto& [name, value] : rows) {
    labels.push_back({name, fmt::format("screen 0.685,{:.4f}", y), "left tc rgb '#555555'"});
    labels.push_back({value, fmt::format("screen 0.975,{:.4f}", y), "right tc rgb '#111111'"});
    y -= 0.0315;
  }
}

}  // namespace

void write_record_plot(const Record& record, const RecordReport& r, const std::string& path, const Uncorrected* before) {
  std::string title = r.title.substr(0, 110);
  if (title.size() < r.title.size()) title += " ...";
  plot::Figure figure{1240, 780};
  figure.labels = {{std::filesystem::path(r.file).filename().string(), "screen 0.075,0.965", "left font ',16' tc rgb '#111111'"},
                   {title, "screen 0.075,0.935", "left font ',12' tc rgb '#666666'"}};
  if (!r.note.empty()) {
    std::string note = r.note.substr(0, 230);
    if (note.size() < r.note.size()) note.replace(std::min(note.rfind(' '), note.size()), std::string::npos, " ...");
    figure.labels.push_back({note, "screen 0.075,0.912", "left font ',9' tc rgb '#8a8478'"});
  }
  if (before != nullptr) figure.labels.push_back({"grey: before correction", "screen 0.975,0.965", "right font ',13' tc rgb '#8a8478'"});
  add_summary(r, figure.labels);
  const std::string rows = figure.add_rows(histories(record.acceleration));
  const std::string old_rows = before != nullptr ? figure.add_rows(histories(before->record.acceleration)) : "";
  const RecordReport& old = before != nullptr ? before->report : r;
  const Quantity quantities[] = {
      {"Acceleration", "a", "g", "#b5432e", 2, {r.pga.value / standard_g, r.pga.time}, 0.645, 0.865, old.pga.value / standard_g},
      {"Velocity", "v", "m/s", "#2f6b8f", 3, r.pgv, 0.365, 0.585, old.pgv.value},
      {"Displacement", "d", "m", "#3c7a4b", 4, r.pgd, 0.085, 0.305, old.pgd.value}};
  for (const Quantity& q : quantities) figure.panels.push_back(history_panel(q, r, rows, old_rows));
  const std::string old_spectrum = before != nullptr ? figure.add_rows(spectrum(old)) : "";
  figure.panels.push_back(
      spectrum_panel(r, figure.add_rows(spectrum(r)), old_spectrum, before != nullptr ? old.spectrum_peak.acceleration / standard_g : 0));
  plot::draw(figure, path);
}

}  // namespace erbs
