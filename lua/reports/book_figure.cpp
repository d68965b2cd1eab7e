// The figure of a family in the verification book.
#include <algorithm>
#include <cmath>

#include "engine/record/plot/figure.h"
#include "engine/record/plot/gnuplot.h"
#include "lua/reports/book.h"

namespace erbs::lua {
namespace {

constexpr double axis_start = 1e-6, axis_end = 30;  // ends of the axis; points beyond them are drawn at the ends

std::string point(const Verdict& v, double y) {
  const double x = std::isfinite(v.used) ? std::clamp(v.used, axis_start, axis_end) : v.passed ? axis_start : axis_end;
  return fmt::format("{:.5g} {:.5g}\n", x, y);
}

// The points of a case are spread over the height of its row, so that equal points do not hide each other.
double height(size_t i, size_t n) { return n < 2 ? 0 : 0.5 * (double(i) / double(n - 1) - 0.5); }

}  // namespace

void draw_family(const Family& family, const std::string& path) {
  const double n = double(family.cases.size()), height_px = 150 + 26 * n;
  std::string good, bad, names;
  for (size_t row = 0; row < family.cases.size(); ++row) {
    const CaseResult& result = *family.cases[row];
    const double y = n - double(row);
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", gnuplot_quoted(result.name), y);
    for (size_t i = 0; i < result.verdicts.size(); ++i) {
      const Verdict& v = result.verdicts[i];
      (v.passed ? good : bad) += point(v, y - height(i, result.verdicts.size()));
    }
    if (!result.trouble.empty()) bad += fmt::format("{} {}\n", axis_end, y);
  }
  plot::Figure figure{1240, height_px, 14};
  figure.labels = {{family.title, fmt::format("screen 0.02,{:.5f}", 1 - 28 / height_px), "left font ',18'"}};
  plot::Panel p;
  p.axes = {0.30, 0.97, 85 / height_px, 1 - 60 / height_px};
  p.x = {"error as a share of its tolerance; right of the line it fails",
         fmt::format("[{}:{}]", 0.7 * axis_start, 1.5 * axis_end),
         fmt::format("('0' {}, '10^{{-5}}' 1e-5, '10^{{-4}}' 1e-4, '10^{{-3}}' 1e-3, '10^{{-2}}' 1e-2, '0.1' 0.1, '1' 1, 'none' {})",
                     axis_start, axis_end),
         "",
         "",
         true};
  p.y = {"", fmt::format("[0.4:{}]", n + 0.6), "noenhanced (" + names + ")"};
  p.settings = "set object rectangle from 1, graph 0 to graph 1, graph 1 fc rgb '#f8e4df' fs solid noborder behind\n";
  p.add_vertical(1, "lc rgb '#b5432e' lw 2");
  if (!good.empty()) p.series.push_back({figure.add_rows(good) + " using 1:2", "points pt 7 ps 0.75 lc rgb '#2f6b8f'"});
  if (!bad.empty()) p.series.push_back({figure.add_rows(bad) + " using 1:2", "points pt 5 ps 0.95 lc rgb '#b5432e'"});
  figure.panels = {p};
  plot::draw(figure, path);
}

}  // namespace erbs::lua
