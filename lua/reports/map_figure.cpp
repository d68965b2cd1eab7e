// Stability map of time step, damping and stiffness: its figure and its table.
#include <algorithm>
#include <cmath>

#include "engine/record/format/csv.h"
#include "engine/record/plot/figure.h"
#include "lua/reports/stability_map.h"

namespace erbs::lua {
namespace {

using RunVerdict = study::MapRun::Verdict;

const char* name_of(const study::Scheme& s) {
  return !s.sequential ? "leapfrog" : s.explicit_damping ? "sequential, explicit damping" : "sequential, centred damping";
}

std::string rounded(double x) { return fmt::format("{:.3g}", x); }

struct Range {
  double c0, c1, dt0, dt1;
};

Range range_of(const MapStudy& s) {
  return {0.4 * s.dampings.front(), 2.5 * s.dampings.back(), 0.6 * s.steps.front().second, 1.5 * s.steps.back().second};
}

// Zero damping has no logarithm; it is drawn at the left edge.
double at_damping(const MapStudy& s, double c) { return c > 0 ? c : s.dampings.size() > 1 ? 0.1 * s.dampings[1] : 1; }

std::string points(const MapStudy& s, const study::Scheme& scheme, double factor, RunVerdict verdict, bool rated, bool whole = true) {
  std::string text;
  for (const study::MapRun& r : s.all) {
    if (r.scheme.sequential != scheme.sequential || r.scheme.explicit_damping != scheme.explicit_damping || r.factor != factor ||
        r.verdict != verdict || (verdict == RunVerdict::converged && whole != (r.until >= 0.999 * s.window)))
      continue;
    if ((verdict == RunVerdict::converged || verdict == RunVerdict::bounded) && r.ratio.has_value() != rated) continue;
    const double shade = r.ratio ? std::clamp(std::log10(std::max(1e-9, std::fabs(*r.ratio))), -2.0, 2.0) : 0;
    text += fmt::format("{:.6g} {:.6g} {:.4g}\n", at_damping(s, r.damping), r.dt, shade);
  }
  return text;
}

// Outline of the region that theory calls bounded: its lower and upper damping at each step, as a closed curve.
std::string outline(const MapStudy& s, const study::Scheme& scheme, double factor) {
  const study::Stiffness k = stiffer(s.nominal, factor);
  const Range r = range_of(s);
  const double limit = scheme.sequential ? k.block : k.critical;
  std::string left, right;
  for (int i = 0; i <= 300; ++i) {
    const double dt = std::min(limit * (1 - 1e-9), r.dt0 * std::pow(r.dt1 / r.dt0, i / 300.0));
    const auto room = room_of(scheme, k, dt);
    if (!room) break;
    left += fmt::format("{:.6g} {:.6g}\n", std::clamp(room->least, r.c0, r.c1), dt);
    right = fmt::format("{:.6g} {:.6g}\n", std::clamp(room->most, r.c0, r.c1), dt) + right;
    if (dt >= limit * (1 - 1e-9)) break;
  }
  return left + right;
}

void add_curves(const MapStudy& s, const study::Scheme& scheme, double factor, plot::Figure& figure, plot::Panel& p) {
  const auto add = [&](const std::string& rows, const std::string& look, const char* columns = "1:2") {
    p.series.push_back({figure.add_rows(rows.empty() ? "NaN NaN 0\n" : rows) + " using " + columns, look});
  };
  if (const std::string inside = outline(s, scheme, factor); !inside.empty()) {
    add(inside, "filledcurves closed fc rgb '#dcebd9'");
    add(inside, "lines lw 2 lc rgb '#3f7f3b'");
  }
  add(points(s, scheme, factor, RunVerdict::diverged, false), "points pt 2 ps 0.9 lw 2 lc rgb '#b3261e'");
  add(points(s, scheme, factor, RunVerdict::ledger, false), "points pt 1 ps 1.1 lw 2 lc rgb '#d07a1e'");
  add(points(s, scheme, factor, RunVerdict::failed, false), "points pt 3 ps 0.9 lw 1 lc rgb '#777777'");
  add(points(s, scheme, factor, RunVerdict::bounded, false), "points pt 8 ps 1.3 lw 2 lc rgb '#777777'");
  add(points(s, scheme, factor, RunVerdict::bounded, true), "points pt 8 ps 1.3 lw 2 lc palette", "1:2:3");
  for (const bool whole : {false, true}) {
    const std::string mark = fmt::format("points pt {} ps 1.4 lw 2.5 lc ", whole ? 7 : 6);
    add(points(s, scheme, factor, RunVerdict::converged, false, whole), mark + "rgb '#777777'");
    add(points(s, scheme, factor, RunVerdict::converged, true, whole), mark + "palette", "1:2:3");
  }
}

// The legend of the marks, in one row at the bottom.
void add_legend(const MapStudy& s, std::vector<plot::Label>& labels) {
  const auto any = [&](RunVerdict verdict, bool whole) {
    return std::any_of(s.all.begin(), s.all.end(),
                       [&](const study::MapRun& r) { return r.verdict == verdict && whole == (r.until >= 0.999 * s.window); });
  };
  double x = 0.045;
  const auto add = [&](const std::string& text, double at_x, double at_y, int mark, double size, const char* color) {
    labels.push_back({text, fmt::format("screen {:.4f},{:.4f}", at_x, at_y),
                      fmt::format("left offset 1.2,0 point pt {} ps {} lw 2 lc rgb '{}'", mark, size, color)});
    x += 0.035 + 0.0052 * double(text.size());
  };
  const char* blue = "#2b8cbe";
  if (any(RunVerdict::converged, true)) add("bounded over the window", x, 0.038, 7, 1.4, blue);
  if (any(RunVerdict::converged, false)) add("bounded over the beginning of the window, not run further", x, 0.038, 6, 1.4, blue);
  if (any(RunVerdict::bounded, false)) add("bounded so far, out of time", x, 0.038, 8, 1.3, blue);
  add("diverged, reported by the run", x, 0.038, 2, 0.9, "#b3261e");
  // in the second row, where it always has room
  add("bounded, with energy fed by the scheme itself", 0.5975, 0.014, 1, 1.1, "#d07a1e");
  add("green: bounded by theory", 0.045, 0.014, 5, 1.6, "#9cc797");
  labels.push_back({"dashed: C_c / m of eq. (6); the rules of the steps are at the right", "screen 0.2,0.014", "left tc rgb '#444444'"});
}

// The critical damping, and the rules of the time steps; their names only with `named`.
void add_rules(const MapStudy& s, double factor, bool named, plot::Panel& p) {
  p.add_vertical(s.critical_damping * std::sqrt(factor), "dt 2 lw 1 lc rgb '#444444'");
  for (std::size_t i = 0; i < s.steps.size(); ++i) {
    const double dt = s.steps[i].second, above = i + 1 < s.steps.size() ? s.steps[i + 1].second / dt : 10;
    const double shift = above < 1.2 ? -0.45 : i > 0 && dt / s.steps[i - 1].second < 1.2 ? 0.45 : 0;
    p.add_horizontal(dt, "lw 0.6 lc rgb '#d5d5d5' back");
    if (named)
      p.labels.push_back({fmt::format("{} s: {}", rounded(dt), s.steps[i].first), fmt::format("graph 1.02, first {:.6g}", dt),
                          fmt::format("left offset 0,{} font ',9' tc rgb '#444444'", shift)});
  }
}

}  // namespace

void draw_map(const MapStudy& s, const std::string& path) {
  const study::Scheme schemes[] = {{false, false}, {true, false}, {true, true}};
  const Range r = range_of(s);
  std::vector<double> factors = s.factors;
  std::sort(factors.begin(), factors.end());
  plot::Figure figure{1600, 1250};
  figure.grid = "";
  figure.settings =
      "set palette defined (-2 '#5e3c99', -1 '#8da0cb', -0.1 '#2b8cbe', 0 '#1a9850', 0.1 '#2b8cbe', 1 '#e0a030', 2 '#7f3b08')\n"
      "set cbrange [-2:2]\n";
  figure.labels = {{"What converges: " + s.name, "screen 0.03,0.98", "left font ',18'"},
                   {fmt::format("{:g} s around the peak of the ground motion; every mark is a run; colour: {} over that of leapfrog at the "
                                "smallest step and the scene's damping",
                                s.window, s.quantity),
                    "screen 0.03,0.957", "left tc rgb '#555555'"}};
  add_legend(s, figure.labels);
  for (std::size_t row = 0; row < factors.size(); ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const double height = 0.80 / double(factors.size()), top = 0.915 - double(row) * (height + 0.02),
                   left = 0.06 + 0.262 * double(column);
      const std::string stiffness = fmt::format("stiffness x {:g}", factors[row]);
      plot::Panel p;
      p.axes = {left, left + 0.235, top - height + 0.03, top};
      p.x = {
          row + 1 == factors.size() ? "mass damping c/m [1/s]" : "", fmt::format("[{:.6g}:{:.6g}]", r.c0, r.c1), "", "10^{%T}", "", true};
      p.y = {column == 0 ? "time step [s]" : "", fmt::format("[{:.6g}:{:.6g}]", r.dt0, r.dt1), "", "10^{%T}", "", true};
      p.labels = {
          {row == 0 ? fmt::format("{}, {}", name_of(schemes[column]), stiffness) : stiffness, "graph 0.02, graph 1.04", "left font ',12'"}};
      p.settings = row == 0 && column == 2 ? "set colorbox horizontal user origin screen 0.83,0.962 size screen 0.14,0.012\n"
                                             "set cbtics ('1/100' -2, '1/10' -1, '1' 0, '10' 1, '100' 2) font ',9'\n"
                                           : "unset colorbox\n";
      add_rules(s, factors[row], column == 2, p);
      add_curves(s, schemes[column], factors[row], figure, p);
      figure.panels.push_back(p);
    }
  plot::draw(figure, path);
}

void write_map_csv(const MapStudy& study, const std::string& command, const std::string& path) {
  CsvWriter table(path, {"scheme", "stiffness", "rule", "dt_s", "damping_1_s", "verdict", "theory", "until_s", "quantity", "value",
                         "over_leapfrog", "energy_residual", "joints_broken", "cpu_s", "command", "reason"});
  const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string("nan"); };
  for (const study::MapRun& r : study.all)
    table.text_row({name_of(r.scheme), fmt::format("{:g}", r.factor), r.step, fmt::format("{}", r.dt), fmt::format("{}", r.damping),
                    word(r.verdict), foretold(r, study.nominal) ? "bounded" : "diverges", fmt::format("{:.6g}", r.until), study.quantity,
                    number(r.value), number(r.ratio), fmt::format("{:.3g}", r.residual), std::to_string(r.broken),
                    fmt::format("{:.2f}", r.cpu), fmt::format("{} {}", command, fmt::join(r.words, " ")), r.reason});
  table.flush();
}

}  // namespace erbs::lua
