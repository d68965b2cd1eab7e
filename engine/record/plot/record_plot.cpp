#include "engine/record/plot/record_plot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/plot/gnuplot.h"

namespace erbs {
namespace {

struct Panel {
  std::string_view title, label, color;
  int column;
  Peak peak;         // in the unit of the panel
  std::string note;  // text beside the marker
  double bottom, top;
};

constexpr std::string_view head = R"(set terminal svg size 1240,780 dynamic font "DejaVu Sans,13" background "#ffffff"
set encoding utf8
set multiplot
set border 3 lc rgb "#5a5a5a" lw 1
set tics out nomirror scale 0.6 tc rgb "#333333"
set grid lc rgb "#e3e3e3" lw 1 lt 1
set style fill solid noborder
unset key
)";

// Rows of time, a (g), v (m/s), d (m). Short records get points in between, since v and d are curved; long ones would make large files.
std::string histories(const Polyline& a) {
  const int parts = a.times.size() < 2500 ? 3 : 1;
  std::string text = "$history << END\n";
  for (size_t i = 0; i < a.times.size(); ++i)
    for (int k = 0; k < (i + 1 < a.times.size() ? parts : 1); ++k) {
      const double t = k == 0 ? a.times[i] : a.times[i] + k * (a.times[i + 1] - a.times[i]) / parts;
      text += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", t, value_inside(a, t) / standard_g, area_inside(a, t), double_area_inside(a, t));
    }
  return text + "END\n";
}

std::string spectrum(const RecordReport& r) {
  std::string text = "$spectrum << END\n";
  for (const ResponsePoint& point : r.spectrum) text += fmt::format("{:.6g} {:.6g}\n", point.period, point.acceleration / standard_g);
  return text + "END\n";
}

// The step (1, 2 or 5 times a power of ten) that gives one to four tics up to `reach`.
double tic_step(double reach) {
  const double decade = std::pow(10, std::floor(std::log10(reach)));
  const double lead = reach / decade;
  return decade * (lead < 2 ? 0.5 : lead < 4 ? 1 : lead < 8 ? 2 : 5);
}

// A circle at the peak, with its value on the side that has room.
std::string marker(const Panel& p, double duration) {
  const bool left = p.peak.time > 0.6 * duration;
  return fmt::format("set label 1 at {:.8g},{:.8g} {} {} offset {},{} point pt 7 ps 0.8 lc rgb '{}' tc rgb '#222222' noenhanced front\n",
                     p.peak.time, p.peak.value, gnuplot_quoted(p.note), left ? "right" : "left", left ? -1.0 : 1.0,
                     p.peak.value > 0 ? 0.0 : -0.4, p.color);
}

std::string panel(const Panel& p, const RecordReport& r, bool last) {
  const double reach = std::max(1.28 * std::abs(p.peak.value), 1e-12);  // gives a record of zeros an axis too
  std::string text = fmt::format(
      "set lmargin at screen 0.075\nset rmargin at screen 0.6\nset bmargin at screen {}\nset tmargin at screen {}\n"
      "set label 4 '{}' at graph 0, graph 1.1 left tc rgb '{}' font ',14'\n"
      "set label 5 '{}' at screen 0.02,{} center rotate by 90 tc rgb '#333333'\n"  // a ylabel would move with the tic labels
      "set xrange [0:{:.8g}]\nset yrange [{:.8g}:{:.8g}]\nset format x '{}'\n{}\n",
      p.bottom, p.top, p.title, p.color, p.label, 0.5 * (p.bottom + p.top), r.duration, -reach, reach, last ? "%g" : "",
      last ? "set xlabel 'time (s)' offset 0,0.3 tc rgb '#333333'" : "unset xlabel");
  text += fmt::format("set object 1 rectangle from {:.8g}, graph 0 to {:.8g}, graph 1 fc rgb '#f3efe8' fs solid noborder behind\n",
                      r.time_5, r.time_95);
  text += fmt::format("set ytics {:.8g}\n", tic_step(reach)) + marker(p, r.duration);
  text += "set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead lc rgb '#9a9a9a' lw 1\n";
  return text + fmt::format("plot $history using 1:{} with lines lw 1.1 lc rgb '{}'\n", p.column, p.color);
}

std::string spectrum_panel(const RecordReport& r) {
  const double top = std::max(r.spectrum_peak.acceleration / standard_g, 1e-12);
  std::string text =
      "unset object 1\nunset arrow 1\nset lmargin at screen 0.685\nset rmargin at screen 0.975\nset bmargin at screen 0.40\nset tmargin at "
      "screen 0.865\n"
      "unset label 5\nset label 4 'Response spectrum, 5 % damping' at graph 0, graph 1.045 left tc rgb '#5b3a78' font ',14'\n"
      "set ylabel 'pseudo-acceleration Sa (g)' offset 0.6,0 tc rgb '#333333'\nset xlabel 'period T (s)' offset 0,0.3 tc rgb '#333333'\n"
      "set ytics auto\nset logscale x\nset format x '%g'\nset xtics (0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5)\n";
  text +=
      fmt::format("set xrange [{:.8g}:{:.8g}]\nset yrange [0:{:.8g}]\n", r.spectrum.front().period, r.spectrum.back().period, 1.2 * top);
  const bool left = r.spectrum_peak.period > 0.5;
  text += fmt::format(
      "set label 1 at {:.8g},{:.8g} '{:.3f} g at {:.2f} s' {} offset {},0.2 point pt 7 ps 0.8 lc rgb '#5b3a78' tc rgb '#222222' front\n",
      r.spectrum_peak.period, top, top, r.spectrum_peak.period, left ? "right" : "left", left ? -0.6 : 0.6);
  return text + "plot $spectrum using 1:2 with lines lw 1.8 lc rgb '#5b3a78'\n";
}

// Names and values below the spectrum.
std::string summary(const RecordReport& r) {
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
  std::string text;
  int tag = 10;
  double y = 0.285;
  for (const auto& [name, value] : rows) {
    text += fmt::format("set label {} {} at screen 0.685,{:.4f} left noenhanced tc rgb '#555555'\n", tag++, gnuplot_quoted(name), y);
    text += fmt::format("set label {} {} at screen 0.975,{:.4f} right noenhanced tc rgb '#111111'\n", tag++, gnuplot_quoted(value), y);
    y -= 0.0315;
  }
  return text;
}

}  // namespace

void write_record_plot(const Record& record, const RecordReport& r, const std::string& path) {
  const std::string name = std::filesystem::path(r.file).filename().string();
  std::string title = r.title.substr(0, 110);
  if (title.size() < r.title.size()) title += " ...";
  std::string script(head);
  script += histories(record.acceleration) + spectrum(r);
  script += fmt::format("set label 2 {} at screen 0.075,0.965 left font ',16' noenhanced tc rgb '#111111'\n", gnuplot_quoted(name));
  script += fmt::format("set label 3 {} at screen 0.075,0.93 left font ',12' noenhanced tc rgb '#666666'\n", gnuplot_quoted(title));
  const double pga = r.pga.value / standard_g;
  const auto note = [](std::string_view unit, const Peak& peak, double value) {
    return fmt::format("{:.4f} {} at {:.2f} s", std::abs(value), unit, peak.time);
  };
  const Panel panels[] = {
      {"Acceleration", "a (g)", "#b5432e", 2, {pga, r.pga.time}, note("g", r.pga, pga), 0.645, 0.865},
      {"Velocity", "v (m/s)", "#2f6b8f", 3, r.pgv, note("m/s", r.pgv, r.pgv.value), 0.365, 0.585},
      {"Displacement", "d (m)", "#3c7a4b", 4, r.pgd, note("m", r.pgd, r.pgd.value), 0.085, 0.305},
  };
  for (const Panel& p : panels) {
    script += panel(p, r, p.column == 4);
    script += "unset label 2\nunset label 3\n";
  }
  script += summary(r) + spectrum_panel(r) + "unset multiplot\n";
  run_gnuplot(script, path);
}

}  // namespace erbs
