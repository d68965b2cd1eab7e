#include "render/draw/push_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/record/plot/gnuplot.h"
#include "engine/record/plot/unit.h"

namespace erbs::render {
namespace {

std::string label_of(const std::string& multiplier) {
  if (multiplier == "multiplier_tan") return "tangent of the tilt";
  return multiplier == "multiplier_g" ? "acceleration [g]" : "multiplier of the forces";
}

double peak_of(const std::vector<double>& values) {
  double peak = 0;
  for (const double value : values)
    if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  return peak;
}

}  // namespace

plot::Figure push_figure(const std::string& file, const CsvTable& curve, const Run& run) {
  plot::Figure figure{.width = 760, .height = 640};
  const std::string source = gnuplot_quoted(file) + " every ::1 using ";
  const plot::ShownUnit& length = plot::shown_unit(*plot::find_unit("m"), peak_of(curve.column("displacement_m")));
  const std::string x = fmt::format("(column({})*{})", curve.find("displacement_m") + 1, length.factor);
  const std::string along = fmt::format("displacement of the monitored point [{}]", length.name);
  figure.settings = "set datafile separator comma\nset lmargin 12\nset rmargin 4\nset autoscale xfix\n";
  figure.labels.push_back({run.title, "screen 0.5,0.97", "center font ',15' noenhanced"});
  plot::Panel load{.cell = {0, 1, 0.36, 0.95}, .y = {.label = label_of(curve.names.front())}, .key = "bottom right"};
  load.series.push_back({fmt::format("{}{}:1", source, x), "linespoints lw 1.6 pt 7 ps 0.5 lc rgb '#0072b2'", "states of equilibrium"});
  if (const double highest = *std::max_element(curve.columns[0].begin(), curve.columns[0].end()); highest > 0) {
    load.add_horizontal(highest, "lw 1 dt 3 lc rgb '#7d7d7d'");
    // above the line and at its end: the curve lies below, and rises at the other one
    load.labels.push_back(
        {fmt::format("{:.4g}", highest), fmt::format("graph 0.99, first {}", highest), "right offset 0,0.6 tc rgb '#5d5d5d'"});
  }
  const double most = std::max(peak_of(curve.column("joints_opened")), peak_of(curve.column("joints_slid")));
  const plot::Axis number{.label = "joints", .range = most > 0 ? "[0:*]" : "[0:1]", .tics = most < 5 ? "1" : ""};  // no halves
  plot::Panel joints{.cell = {0, 1, 0, 0.36}, .x = {.label = along}, .y = number, .key = "tmargin right horizontal"};
  for (const auto& [name, title, look] : {std::array{"joints_opened", "opened", "#d55e00"}, std::array{"joints_slid", "slid", "#009e73"}})
    joints.series.push_back(
        {fmt::format("{}{}:{}", source, x, curve.find(name) + 1), fmt::format("linespoints lw 1.3 pt 7 ps 0.4 lc rgb '{}'", look), title});
  figure.panels = {load, joints};
  return figure;
}

}  // namespace erbs::render
