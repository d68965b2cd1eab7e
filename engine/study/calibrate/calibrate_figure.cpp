// The figure of a calibration: what is known, what the scene gave before and what it gives now, and the residuals below.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/record/format/csv.h"
#include "engine/record/plot/figure.h"
#include "engine/study/calibrate/calibrate.h"

namespace erbs::study {
namespace {

constexpr const char* known_look = "lw 2 lc rgb '#777777'";
constexpr const char* now_look = "lw 2 lc rgb '#b5432e'";
constexpr const char* legend_above = "at screen 0.5,0.927 center top horizontal maxcols 3 samplen 3 noenhanced";
constexpr const char* before_look = "lw 1 dt 2 lc rgb '#1f5f8b'";

std::string rows_of(const std::vector<double>& x, const std::vector<double>& y) {
  std::string rows;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(y[i])) rows += fmt::format("{} {}\n", x[i], y[i]);
  return rows;
}

double at(const std::vector<double>& x, const std::vector<double>& y, double t) {
  const auto next = std::upper_bound(x.begin(), x.end(), t);
  if (next == x.begin() || (next == x.end() && t > x.back())) return NAN;
  const std::size_t i = std::min(std::size_t(next - x.begin()), x.size() - 1);
  return y[i - 1] + (y[i] - y[i - 1]) * (t - x[i - 1]) / (x[i] - x[i - 1]);
}

// A symmetric range with tics at its ends, wide enough for all residuals.
plot::Axis around_zero(const std::string& label, const std::vector<double>& residuals) {
  double most = 0;
  for (const double x : residuals)
    if (std::isfinite(x)) most = std::max(most, std::fabs(x));
  if (!(most > 0)) most = 1;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  const double end = decade * (most <= decade ? 1 : most <= 2 * decade ? 2 : most <= 5 * decade ? 5 : 10);
  return {label, fmt::format("[{}:{}]", -1.15 * end, 1.15 * end), fmt::format("{}", end), "", "noenhanced"};
}

struct Sheet {
  plot::Figure figure;
  void add(plot::Panel& panel, const std::vector<double>& x, const std::vector<double>& y, const std::string& look,
           const std::string& title) {
    const std::string rows = rows_of(x, y);
    if (!rows.empty()) panel.series.push_back({figure.add_rows(rows) + " using 1:2", look, title});
  }
};

// Both runs over the known history, above the distance of the fitted one from it.
void add_history(Sheet& sheet, const Sweep& s, const KnownHistory& known, double bottom, double top) {
  const double middle = bottom + 0.4 * (top - bottom);
  plot::Panel upper, lower;
  upper.axes = {0.1, 0.97, middle + 0.02, top}, lower.axes = {0.1, 0.97, bottom + 0.055, middle - 0.01};
  upper.x = {"", "", "", "none"}, upper.y = {known.label, "", "", "", "noenhanced"};
  lower.x = {"time [s]"};
  upper.key = legend_above;
  const double end = known.t.back();
  upper.x.range = lower.x.range = fmt::format("[0:{}]", end);
  sheet.add(upper, known.t, known.values, std::string("lines ") + known_look, known.known);
  for (const bool now : {false, true}) {
    const std::string file = fmt::format("{}/runs/{}/histories.csv", s.directory, now ? best_run : first_run);
    if (!std::filesystem::exists(file)) continue;
    const CsvTable table = read_csv(file);
    const std::vector<double>&t = table.column("time_s"), &y = table.column(known.column);
    const std::string look = std::string("lines ") + (now ? now_look : before_look);
    sheet.add(upper, t, y, look, now ? "fitted" : "as the scene is written");
    if (!now) continue;
    std::vector<double> less;
    for (std::size_t i = 0; i < t.size(); ++i) less.push_back(t[i] <= end ? y[i] - at(known.t, known.values, t[i]) : NAN);
    sheet.add(lower, t, less, look, "");
    lower.y = around_zero("residual", less);
  }
  lower.add_horizontal(0, "lc rgb '#777777'");
  sheet.figure.panels.insert(sheet.figure.panels.end(), {upper, lower});
}

// The targets of one label by number, above their residuals in percent of the scale.
void add_target(Sheet& sheet, const CalibrationTarget& target, const std::vector<double>& before, const std::vector<double>& now,
                std::size_t from, plot::Box cell, bool legend) {
  const double middle = cell.bottom + 0.42 * (cell.top - cell.bottom);
  plot::Panel upper, lower;
  constexpr double below = 54;  // px, for numbers and the name of the axis
  const double foot = cell.bottom + below / sheet.figure.height;
  upper.axes = {cell.left, cell.right, middle + 0.02, cell.top}, lower.axes = {cell.left, cell.right, foot, middle - 0.01};
  std::vector<double> x, less, old_values, values;
  for (std::size_t i = 0; i < target.values.size(); ++i) {
    x.push_back(double(i + 1));
    old_values.push_back(before[from + i]), values.push_back(now[from + i]);
    less.push_back(100 * (now[from + i] - target.values[i]) / target.scale);
  }
  const std::string range = fmt::format("[0.5:{}]", double(x.size()) + 0.5);
  upper.x = {"", range, "1", "none"}, lower.x = {"number", range, "1"};
  upper.y = {target.label, "", "", "", "noenhanced"}, lower.y = around_zero(fmt::format("residual [% of {:.3g}]", target.scale), less);
  if (legend) upper.key = legend_above;
  sheet.add(upper, x, target.values, std::string("linespoints pt 6 ps 1.1 ") + known_look, "known");
  sheet.add(upper, x, old_values, "points pt 2 ps 0.9 lc rgb '#1f5f8b'", "as the scene is written");
  sheet.add(upper, x, values, "points pt 7 ps 0.7 lc rgb '#b5432e'", "fitted");
  sheet.add(lower, x, less, "impulses lw 4 lc rgb '#b5432e'", "");
  lower.add_horizontal(0, "lc rgb '#777777'");
  sheet.figure.panels.insert(sheet.figure.panels.end(), {upper, lower});
}

}  // namespace

void draw_calibration(const Sweep& s, const Calibrated& result) {
  const Calibration& c = *s.plan.calibration;
  constexpr std::size_t most_targets = 4;
  constexpr double top = 0.895;
  Sheet sheet{{1000, c.history ? 980.0 : 620.0}};
  const std::string title = s.plan.title.empty() ? s.scene.substr(s.scene.find_last_of('/') + 1) : s.plan.title;
  std::string fitted;
  for (const auto& [param, value] : result.values) fitted += fmt::format("{}{} = {:.4g}", fitted.empty() ? "" : ", ", param, value);
  sheet.figure.labels = {{title, "screen 0.5,0.975", "center font ',16'"},
                         {fmt::format("{}; rms {:.3g} % of the scales", fitted, 100 * result.rms), "screen 0.5,0.945", "center"}};
  const double share = c.history ? 0.46 : 0.0;
  if (c.history) add_history(sheet, s, *c.history, 1 - share - 0.04, top);
  const std::size_t count = std::min(most_targets, c.targets.size());
  std::size_t from = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double width = 0.9 / double(count), left = 0.1 + double(i) * width;
    add_target(sheet, c.targets[i], result.got_before, result.got, from,
               {left, left + width - (i + 1 < count ? 0.09 : 0.03), 0.01, c.history ? 0.47 : top}, i == 0 && !c.history);
    from += c.targets[i].values.size();
  }
  for (const char* format : {".svg", ".png"}) plot::draw(sheet.figure, s.directory + "/" + calibration_stem + format);
}

}  // namespace erbs::study
