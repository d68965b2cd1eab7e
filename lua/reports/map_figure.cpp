// Stability map of time step, damping and stiffness: its figure and its table.
#include <algorithm>
#include <cmath>

#include "engine/record/format/csv.h"
#include "engine/record/plot/gnuplot.h"
#include "lua/reports/stability_map.h"

namespace erbs {
namespace {

using Verdict = MapRun::Verdict;

const char* name_of(const Scheme& s) {
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

std::string points(const MapStudy& s, const Scheme& scheme, double factor, Verdict verdict, bool rated, bool whole = true) {
  std::string text;
  for (const MapRun& r : s.all) {
    if (r.scheme.sequential != scheme.sequential || r.scheme.explicit_damping != scheme.explicit_damping || r.factor != factor ||
        r.verdict != verdict || (verdict == Verdict::converged && whole != (r.until >= 0.999 * s.window)))
      continue;
    if ((verdict == Verdict::converged || verdict == Verdict::bounded) && r.ratio.has_value() != rated) continue;
    const double shade = r.ratio ? std::clamp(std::log10(std::max(1e-9, std::fabs(*r.ratio))), -2.0, 2.0) : 0;
    text += fmt::format("{:.6g} {:.6g} {:.4g}\n", at_damping(s, r.damping), r.dt, shade);
  }
  return text;
}

// Outline of the region that theory calls bounded: its lower and upper damping at each step, as a closed curve.
std::string outline(const MapStudy& s, const Scheme& scheme, double factor) {
  const Stiffness k = stiffer(s.nominal, factor);
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

std::string block(int& next, std::string& data, const std::string& rows) {
  data += fmt::format("$d{} << END\n{}END\n", next, rows.empty() ? "NaN NaN 0\n" : rows);
  return fmt::format("$d{}", next++);
}

std::string panel(const MapStudy& s, const Scheme& scheme, double factor, int& next, std::string& data) {
  const std::string inside = outline(s, scheme, factor);
  std::string plot = "plot ";
  if (!inside.empty()) {
    const std::string name = block(next, data, inside);
    plot += fmt::format(
        "{0} using 1:2 with filledcurves closed fc rgb '#dcebd9' notitle, {0} using 1:2 with lines lw 2 lc rgb '#3f7f3b' notitle, ", name);
  }
  const auto add = [&](const std::string& rows, const std::string& style) {
    plot += block(next, data, rows) + " using 1:2" + style + " notitle, ";
  };
  add(points(s, scheme, factor, Verdict::diverged, false), " with points pt 2 ps 0.9 lw 2 lc rgb '#b3261e'");
  add(points(s, scheme, factor, Verdict::ledger, false), " with points pt 1 ps 1.1 lw 2 lc rgb '#d07a1e'");
  add(points(s, scheme, factor, Verdict::failed, false), " with points pt 3 ps 0.9 lw 1 lc rgb '#777777'");
  add(points(s, scheme, factor, Verdict::bounded, false), " with points pt 8 ps 1.3 lw 2 lc rgb '#777777'");
  add(points(s, scheme, factor, Verdict::bounded, true), ":3 with points pt 8 ps 1.3 lw 2 lc palette");
  for (const bool whole : {false, true}) {
    const int mark = whole ? 7 : 6;
    add(points(s, scheme, factor, Verdict::converged, false, whole),
        fmt::format(" with points pt {} ps 1.4 lw 2.5 lc rgb '#777777'", mark));
    add(points(s, scheme, factor, Verdict::converged, true, whole), fmt::format(":3 with points pt {} ps 1.4 lw 2.5 lc palette", mark));
  }
  return plot.substr(0, plot.size() - 2) + "\n";
}

std::string label(int tag, const std::string& text, double x, double y, const std::string& more) {
  return fmt::format("set label {} {} at screen {:.4f},{:.4f} {}\n", tag, gnuplot_quoted(text), x, y, more);
}

// The legend of the marks, in one row at the bottom.
std::string legend(const MapStudy& s) {
  struct Mark {
    const char* text;
    int mark;
    double size;
    const char* color;
  };
  const auto any = [&](Verdict verdict, bool whole) {
    return std::any_of(s.all.begin(), s.all.end(),
                       [&](const MapRun& r) { return r.verdict == verdict && whole == (r.until >= 0.999 * s.window); });
  };
  std::vector<Mark> marks;
  if (any(Verdict::converged, true)) marks.push_back({"bounded over the window", 7, 1.4, "#2b8cbe"});
  if (any(Verdict::converged, false)) marks.push_back({"bounded over the beginning of the window, not run further", 6, 1.4, "#2b8cbe"});
  if (any(Verdict::bounded, false)) marks.push_back({"bounded so far, out of time", 8, 1.3, "#2b8cbe"});
  marks.push_back({"diverged, reported by the run", 2, 0.9, "#b3261e"});
  marks.push_back({"bounded, with energy fed by the scheme itself", 1, 1.1, "#d07a1e"});
  std::string text;
  double x = 0.045;
  int tag = 20;
  for (const Mark& m : marks) {
    // the last mark goes to the second row, where it always has room
    const bool last = &m == &marks.back();
    text += label(tag++, m.text, last ? 0.5975 : x, last ? 0.014 : 0.038,
                  fmt::format("left offset 1.2,0 noenhanced point pt {} ps {} lw 2 lc rgb '{}'", m.mark, m.size, m.color));
    x += 0.035 + 0.0052 * double(std::string(m.text).size());
  }
  return text + label(tag, "green: bounded by theory", 0.045, 0.014, "left offset 1.2,0 noenhanced point pt 5 ps 1.6 lc rgb '#9cc797'") +
         label(tag + 1, "dashed: C_c / m of eq. (6); the rules of the steps are at the right", 0.2, 0.014,
               "left noenhanced tc rgb '#444444'");
}

std::string head(const MapStudy& s, const std::string& path) {
  const bool svg = path.ends_with(".svg");
  const Range r = range_of(s);
  std::string text = fmt::format(
      "set terminal {} size 1600,1250 {} font 'DejaVu Sans,{}' background '#ffffff'\nset encoding utf8\nset multiplot\n"
      "set border 3 lc rgb '#5a5a5a' lw 1\nset tics out nomirror scale 0.5 tc rgb '#222222'\nset logscale xy\nset format x '10^{{%T}}'\n"
      "set format y '10^{{%T}}'\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nunset key\n"
      "set palette defined (-2 '#5e3c99', -1 '#8da0cb', -0.1 '#2b8cbe', 0 '#1a9850', 0.1 '#2b8cbe', 1 '#e0a030', 2 '#7f3b08')\nset cbrange "
      "[-2:2]\n",
      svg ? "svg" : "pngcairo", svg ? "dynamic enhanced" : "enhanced", svg ? 13 : 11, r.c0, r.c1, r.dt0, r.dt1);
  text += label(1, fmt::format("What converges: {}", s.name), 0.03, 0.98, "left font ',18' noenhanced");
  text += label(2,
                fmt::format("{:g} s around the peak of the ground motion; every mark is a run; colour: {} over that of leapfrog at the "
                            "smallest step and the scene's damping",
                            s.window, s.quantity),
                0.03, 0.957, "left noenhanced tc rgb '#555555'");
  return text + legend(s);
}

}  // namespace

void draw_map(const MapStudy& s, const std::string& path) {
  const Scheme schemes[] = {{false, false}, {true, false}, {true, true}};
  std::vector<double> factors = s.factors;
  std::sort(factors.begin(), factors.end());
  std::string data, panels;
  int next = 0;
  for (std::size_t row = 0; row < factors.size(); ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const double height = 0.80 / double(factors.size()), top = 0.915 - double(row) * (height + 0.02),
                   left = 0.06 + 0.262 * double(column);
      std::string set = fmt::format(
          "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n", left,
          left + 0.235, top, top - height + 0.03);
      set += fmt::format("set label 3 {} at graph 0.02, graph 1.04 left noenhanced font ',{}'\n",
                         gnuplot_quoted(row == 0 ? fmt::format("{}, stiffness x {:g}", name_of(schemes[column]), factors[row])
                                                 : fmt::format("stiffness x {:g}", factors[row])),
                         12);
      set += fmt::format("set xlabel '{}'\nset ylabel '{}'\n", row + 1 == factors.size() ? "mass damping c/m [1/s]" : "",
                         column == 0 ? "time step [s]" : "");
      set += fmt::format("set arrow 1 from {0:.6g}, graph 0 to {0:.6g}, graph 1 nohead dt 2 lw 1 lc rgb '#444444'\n",
                         s.critical_damping * std::sqrt(factors[row]));
      for (std::size_t i = 0; i < s.steps.size(); ++i) {
        const bool said = column == 2;
        const double dt = s.steps[i].second, above = i + 1 < s.steps.size() ? s.steps[i + 1].second / dt : 10;
        const double shift = above < 1.2 ? -0.45 : i > 0 && dt / s.steps[i - 1].second < 1.2 ? 0.45 : 0;
        set += said ? fmt::format("set label {} {} at graph 1.02, first {:.6g} left offset 0,{} noenhanced font ',9' tc rgb '#444444'\n",
                                  40 + i, gnuplot_quoted(fmt::format("{} s: {}", rounded(dt), s.steps[i].first)), dt, shift)
                    : fmt::format("unset label {}\n", 40 + i);
        set += fmt::format("set arrow {} from graph 0, first {:.6g} to graph 1, first {:.6g} nohead lw 0.6 lc rgb '#d5d5d5' back\n", 10 + i,
                           dt, dt);
      }
      const bool bar = row == 0 && column == 2;
      set += bar ? "set colorbox horizontal user origin screen 0.83,0.962 size screen 0.14,0.012\nset cbtics ('1/100' -2, '1/10' -1, '1' "
                   "0, '10' 1, '100' 2) "
                   "font ',9'\n"
                 : "unset colorbox\n";
      panels += set + panel(s, schemes[column], factors[row], next, data);
      if (row == 0 && column == 0) panels += "unset label\n";
    }
  run_gnuplot(head(s, path) + data + panels + "unset multiplot\n", path);
}

void write_map_csv(const MapStudy& study, const std::string& command, const std::string& path) {
  CsvWriter table(path, {"scheme", "stiffness", "rule", "dt_s", "damping_1_s", "verdict", "theory", "until_s", "quantity", "value",
                         "over_leapfrog", "energy_residual", "joints_broken", "cpu_s", "command", "reason"});
  const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string("nan"); };
  for (const MapRun& r : study.all)
    table.text_row({name_of(r.scheme), fmt::format("{:g}", r.factor), r.step, fmt::format("{}", r.dt), fmt::format("{}", r.damping),
                    word(r.verdict), foretold(r, study.nominal) ? "bounded" : "diverges", fmt::format("{:.6g}", r.until), study.quantity,
                    number(r.value), number(r.ratio), fmt::format("{:.3g}", r.residual), std::to_string(r.broken),
                    fmt::format("{:.2f}", r.cpu), fmt::format("{} {}", command, fmt::join(r.words, " ")), r.reason});
  table.flush();
}

}  // namespace erbs
