// The figure of a family in the verification book.
#include <algorithm>
#include <cmath>

#include "engine/record/plot/gnuplot.h"
#include "lua/reports/book.h"

namespace erbs {
namespace {

constexpr double least = 1e-6, most = 30;  // ends of the axis; points beyond them are drawn at the ends

std::string point(const Verdict& v, double y) {
  const double x = std::isfinite(v.used) ? std::clamp(v.used, least, most) : v.passed ? least : most;
  return fmt::format("{:.5g} {:.5g}\n", x, y);
}

// The points of a case are spread over the height of its row, so that equal points do not hide each other.
double height(size_t i, size_t n) { return n < 2 ? 0 : 0.5 * (double(i) / double(n - 1) - 0.5); }

}  // namespace

void draw_family(const Family& family, const std::string& path) {
  const double n = double(family.cases.size());
  std::string good = "$good << END\n", bad = "$bad << END\n", names;
  bool any_good = false, any_bad = false;
  for (size_t row = 0; row < family.cases.size(); ++row) {
    const CaseResult& result = *family.cases[row];
    const double y = n - double(row);
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", gnuplot_quoted(result.name), y);
    for (size_t i = 0; i < result.verdicts.size(); ++i) {
      const Verdict& v = result.verdicts[i];
      (v.passed ? good : bad) += point(v, y - height(i, result.verdicts.size()));
      (v.passed ? any_good : any_bad) = true;
    }
    if (!result.trouble.empty()) bad += fmt::format("{} {}\n", most, y), any_bad = true;
  }
  std::string script = fmt::format(
      "set terminal svg size 1240,{:.0f} dynamic font 'DejaVu Sans,14' background '#ffffff'\nset encoding utf8\n"
      "set border 3 lc rgb '#5a5a5a' lw 1\nset tics out nomirror scale 0.6 tc rgb '#222222'\nset grid lc rgb '#dddddd' lw 1 lt 1\n"
      "unset key\nset lmargin at screen 0.30\nset rmargin at screen 0.97\nset bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n",
      150 + 26 * n, 85 / (150 + 26 * n), 1 - 60 / (150 + 26 * n));
  script += fmt::format("set label 1 {} at screen 0.02,{:.5f} left font ',18' tc rgb '#111111'\n", gnuplot_quoted(family.title),
                        1 - 28 / (150 + 26 * n));
  script += good + "END\n" + bad + "END\n";
  script += fmt::format("set logscale x\nset xrange [{}:{}]\nset yrange [0.4:{}]\nset ytics noenhanced ({})\n", 0.7 * least, 1.5 * most,
                        n + 0.6, names);
  script += fmt::format(
      "set xtics ('0' {}, '10^{{-5}}' 1e-5, '10^{{-4}}' 1e-4, '10^{{-3}}' 1e-3, '10^{{-2}}' 1e-2, '0.1' 0.1, '1' 1, 'none' {})\n", least,
      most);
  script += "set xlabel 'error as a share of its tolerance; right of the line it fails' tc rgb '#222222'\n";
  script += "set object 1 rectangle from 1, graph 0 to graph 1, graph 1 fc rgb '#f8e4df' fs solid noborder behind\n";
  script += "set arrow 1 from 1, graph 0 to 1, graph 1 nohead lc rgb '#b5432e' lw 2\n";
  std::vector<std::string> curves;
  if (any_good) curves.emplace_back("$good using 1:2 with points pt 7 ps 0.75 lc rgb '#2f6b8f'");
  if (any_bad) curves.emplace_back("$bad using 1:2 with points pt 5 ps 0.95 lc rgb '#b5432e'");
  if (curves.empty()) return;
  run_gnuplot(script + fmt::format("plot {}\n", fmt::join(curves, ", ")), path);
}

}  // namespace erbs
