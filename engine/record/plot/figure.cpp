#include "engine/record/plot/figure.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/record/plot/gnuplot.h"

namespace erbs::plot {
namespace {

std::string line(const std::string& command, const std::string& value) { return value.empty() ? "" : command + " " + value + "\n"; }

std::string script_of(const std::string& name, const Axis& a) {
  std::string text = fmt::format("set {}label {} tc rgb '#333333' {}\n", name, gnuplot_quoted(a.label), a.look);
  if (a.log) text += "set logscale " + name + "\n";
  if (!a.format.empty()) text += fmt::format("set format {} '{}'\n", name, a.format == "none" ? "" : a.format);
  return text + line("set " + name + "range", a.range) + line("set " + name + "tics", a.tics);
}

std::string script_of(const Label& l) {
  return fmt::format("set label {} at {} noenhanced {} {}\n", gnuplot_quoted(l.text), l.at,
                     l.look.find("tc rgb") == std::string::npos ? "tc rgb '#222222'" : "", l.look);
}

std::string script_of(const Panel& p) {
  std::string text = fmt::format("set origin {:.6g},{:.6g}\nset size {:.6g},{:.6g}\n", p.cell.left, p.cell.bottom,
                                 p.cell.right - p.cell.left, p.cell.top - p.cell.bottom);
  if (p.axes && p.axes->left) text += fmt::format("set lmargin at screen {:.6g}\n", *p.axes->left);
  if (p.axes)
    text += fmt::format("set rmargin at screen {:.6g}\nset bmargin at screen {:.6g}\nset tmargin at screen {:.6g}\n", p.axes->right,
                        p.axes->bottom, p.axes->top);
  text += (p.key.empty() ? "unset key\n" : "set key " + p.key + "\n") + p.settings + script_of("x", p.x) + script_of("y", p.y);
  for (const std::string& one : p.lines) text += "set arrow " + one + "\n";
  for (const Label& label : p.labels) text += script_of(label);
  text += "plot ";
  for (const Series& s : p.series)
    text += fmt::format("{}{} with {} {}", &s == p.series.data() ? "" : ", ", s.source, s.look,
                        s.title.empty() ? "notitle" : "title " + gnuplot_quoted(s.title));
  return text + "\n";
}

}  // namespace

void Panel::add_vertical(double x_at, const std::string& look) {
  lines.push_back(fmt::format("from first {0:.8g}, graph 0 to first {0:.8g}, graph 1 nohead {1}", x_at, look));
}

void Panel::add_horizontal(double y_at, const std::string& look) {
  lines.push_back(fmt::format("from graph 0, first {0:.8g} to graph 1, first {0:.8g} nohead {1}", y_at, look));
}

std::string Figure::add_rows(const std::string& rows) {
  data += fmt::format("$d{} << END\n{}END\n", blocks, rows);
  return fmt::format("$d{}", blocks++);
}

bool Figure::empty() const {
  return std::all_of(panels.begin(), panels.end(), [](const Panel& p) { return p.series.empty(); });
}

std::string script_of(const Figure& f, bool png) {
  std::string text =
      fmt::format("set terminal {} size {:.0f},{:.0f} {} font 'DejaVu Sans,{}' background '#ffffff'\nset encoding utf8\n{}set multiplot\n",
                  png ? "pngcairo" : "svg", f.width, f.height, png ? "enhanced" : "dynamic enhanced", png ? f.font - 2 : f.font, f.data);
  bool first = true;
  for (const Panel& p : f.panels) {
    if (p.series.empty()) continue;
    text += "reset\nset border 3 lc rgb '#5a5a5a' lw 1\nset tics out nomirror scale 0.6 tc rgb '#333333'\n" + f.settings;
    if (!f.grid.empty()) text += "set grid " + f.grid + " lc rgb '#e3e3e3' lw 1 lt 1\n";
    if (std::exchange(first, false))
      for (const Label& label : f.labels) text += script_of(label);
    text += script_of(p);
  }
  return text + "unset multiplot\n";
}

void draw(const Figure& figure, const std::string& path) {
  if (!figure.empty()) run_gnuplot(script_of(figure, path.ends_with(".png")), path);
}

}  // namespace erbs::plot
