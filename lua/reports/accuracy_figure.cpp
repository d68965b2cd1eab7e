// Work-precision figures: error over cost, one line per kind of setting.
#include <algorithm>
#include <cmath>

#include "engine/record/plot/gnuplot.h"
#include "lua/reports/accuracy.h"

namespace erbs {
namespace {

constexpr double least = 1e-13;  // an error of zero is drawn here
// Color and marker of a kind of setting; the same in every panel.
struct Look {
  const char *knob, *color;
  int mark;
};
constexpr Look looks[] = {{"time step", "#1b4f8a", 7},           {"points, simpson", "#c0502d", 5},
                          {"points, midpoint", "#3f8f46", 9},    {"points, trapezoid", "#8a5a9e", 11},
                          {"points, gauss", "#a07810", 13},      {"lazy rotation", "#2f9aa8", 4},
                          {"block size", "#111111", 15},         {"sequential, literal", "#a33a5a", 6},
                          {"sequential, centred", "#d08a70", 8}, {"sequential, coloured", "#7d7d7d", 12}};

const Look& look_of(const std::string& knob) {
  for (const Look& look : looks)
    if (knob == look.knob) return look;
  return looks[std::size(looks) - 1];
}

struct Picture {
  std::string script, plots;
  int block = 0, curve = 0;
  void add(const std::string& data, const std::string& style) {
    if (data.empty()) return;
    script += fmt::format("$d{} << END\n{}END\n", block, data);
    plots += fmt::format("{}$d{} {}{}", plots.empty() ? "" : ", ", block++, style.starts_with("using") ? "" : "using 1:2 ", style);
  }
};

std::string row(const AccuracyStudy& s, std::size_t i, bool by_updates) {
  const double cost = by_updates ? s.all[i].updates : s.all[i].cpu;
  return cost > 0 ? fmt::format("{:.6g} {:.6g}\n", cost, std::max(least, *error_of(s.quantity(), s.all[i].values[s.main]))) : "";
}

std::string legend(const Curve& c) {
  if (!c.slope) return c.knob;
  if (c.knob == "time step") return fmt::format("time step: dt^{{{:.2f}}}", *c.slope);
  if (c.knob.starts_with("points")) return fmt::format("{}: n^{{-{:.2f}}}", c.knob, *c.slope);
  if (c.knob.starts_with("sequential")) return fmt::format("{}: 1/n^{{{:.2f}}}", c.knob, *c.slope);
  return fmt::format("{}: slope {:.2f}", c.knob, *c.slope);
}

// The curves of one panel; their titles only in the panel with the legend.
std::string panel(const AccuracyStudy& s, bool by_updates, bool titles, Picture& picture) {
  picture.plots.clear();
  std::string front;
  for (const std::size_t i : pareto(s.quantity(), s.main, s.all, by_updates)) front += row(s, i, by_updates);
  picture.add(front, fmt::format("with linespoints lw 7 pt 6 ps 2.2 lc rgb '#f0c75e' {}", titles ? "title 'Pareto front'" : "notitle"));
  for (const Curve& c : curves_of(s.quantity(), s.main, s.all)) {
    std::string data;
    for (const std::size_t i : c.at) data += row(s, i, by_updates);
    const Look& look = look_of(c.knob);
    picture.add(data, fmt::format("with linespoints lw 1.8 pt {} ps 1.0 lc rgb '{}' {}", look.mark, look.color,
                                  titles ? "title " + gnuplot_quoted(legend(c)) : "notitle"));
  }
  for (std::size_t i = 0; i < s.all.size(); ++i)
    if (s.all[i].setting.knob == quality_knob && titles && error_of(s.quantity(), s.all[i].values[s.main])) {
      std::string data = row(s, i, by_updates);
      if (data.empty()) continue;
      data.back() = ' ';
      picture.add(data + s.all[i].setting.name.substr(8) + "\n",
                  "using 1:2:3 with labels point pt 2 ps 1.2 lw 2 lc rgb '#000000' offset 0,-0.9 font ',10' notitle");
    }
  for (std::size_t i = 0; i < s.all.size(); ++i)
    if (s.all[i].setting.knob.empty() && error_of(s.quantity(), s.all[i].values[s.main]))
      picture.add(row(s, i, by_updates),
                  fmt::format("with points pt 3 ps 1.8 lw 2 lc rgb '#000000' {}", titles ? "title 'the scene as it is'" : "notitle"));
  return picture.plots;
}

std::string head(const std::string& path, int width, int height) {
  const bool svg = path.ends_with(".svg");
  return fmt::format(
      "set terminal {} size {},{} {} font 'DejaVu Sans,{}' background '#ffffff'\n"
      "set encoding utf8\nset multiplot\nset border 3 lc rgb '#5a5a5a' lw 1\nset tics out nomirror scale 0.6 tc rgb '#222222'\n"
      "set grid lc rgb '#e3e3e3' lw 1 lt 1\nset logscale xy\nset format x '10^{{%T}}'\nset format y '10^{{%T}}'\n",
      svg ? "svg" : "pngcairo", width, height, svg ? "dynamic enhanced" : "enhanced", svg ? 14 : 12);
}

std::string words_of(std::string name) {
  if (name.starts_with("metrics.")) name = name.substr(8);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string error_label(const Goal& q) {
  return q.reference != 0 ? fmt::format("relative error of {}", words_of(q.name))
                          : fmt::format("error of {} [{}]", words_of(q.name), q.unit.empty() ? "-" : q.unit);
}

}  // namespace

void draw_accuracy(const AccuracyStudy& s, const std::string& path) {
  Picture picture;
  const std::string left = panel(s, false, false, picture), right = panel(s, true, true, picture);
  if (left.empty() && right.empty()) return;
  std::string script = head(path, 1500, 720) + picture.script;
  const Goal& q = s.quantity();
  script += fmt::format("set label 1 {} at screen 0.03,0.965 left font ',18' noenhanced tc rgb '#111111'\n",
                        gnuplot_quoted(fmt::format("What accuracy costs: {}", s.name)));
  script += fmt::format("set label 2 {} at screen 0.03,0.925 left noenhanced tc rgb '#555555'\n",
                        gnuplot_quoted(fmt::format("{} = {:.6g} {} by {}{}", words_of(q.name), q.reference, q.unit, q.from,
                                                   q.uncertainty > 0 ? fmt::format(", uncertainty {:.1g}", q.uncertainty) : "")));
  const auto place = [&](double from, double to, const char* x, const std::string& y) {
    return fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen 0.11\nset tmargin at screen 0.88\nset xlabel '{}'\n"
        "set ylabel {} noenhanced\n",
        from, to, x, gnuplot_quoted(y));
  };
  if (!left.empty())
    script += place(0.075, 0.39, "seconds of processor", error_label(q)) + "unset key\nplot " + left + "\nunset label 1\nunset label 2\n";
  if (!right.empty())
    script += place(0.46, 0.775, "contact points evaluated", "") +
              "set key at screen 0.79,0.88 left top Left reverse samplen 2 spacing 1.25\nplot " + right + "\n";
  run_gnuplot(script + "unset multiplot\n", path);
}

namespace {

// Subtitle of a panel: the observed orders of its curves, abbreviated to fit the width.
std::string orders(const AccuracyStudy& s) {
  std::string text;
  for (const Curve& c : curves_of(s.quantity(), s.main, s.all)) {
    if (!c.slope || c.knob == "lazy rotation") continue;
    std::string name = c.knob == "time step" ? "step" : c.knob == "block size" ? "size" : c.knob;
    for (const char* kind : {"points, ", "sequential, "})
      if (name.starts_with(kind)) name = name.substr(std::string_view(kind).size());
    if (c.knob.starts_with("points, ")) name.resize(std::min<std::size_t>(name.size(), 4));
    text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", name, *c.slope);
  }
  return text.empty() ? "no knob shows an order" : text;
}

// Range of the error axis: at least one decade, with a margin beyond the curves.
std::string error_range(const AccuracyStudy& s) {
  double low = 1e300, high = 0;
  for (const Measured& m : s.all)
    if (const auto error = error_of(s.quantity(), m.values[s.main]))
      low = std::min(low, std::max(least, *error)), high = std::max(high, std::max(least, *error));
  if (high == 0) return "set yrange [*:*]\n";
  const double middle = std::sqrt(low * high), reach = std::max(std::sqrt(10.0), 2 * std::sqrt(high / low));
  return fmt::format("set yrange [{:.4g}:{:.4g}]\n", middle / reach, middle * reach);
}

// One legend for all panels, at the bottom, five entries a row.
std::string common_legend(const std::vector<AccuracyStudy>& studies, double height) {
  std::vector<std::string> knobs;
  for (const AccuracyStudy& s : studies)
    for (const Curve& c : curves_of(s.quantity(), s.main, s.all))
      if (std::find(knobs.begin(), knobs.end(), c.knob) == knobs.end()) knobs.push_back(c.knob);
  std::string script;
  int tag = 100;
  const auto add = [&](const std::string& name, const char* color, int mark, double size) {
    const int k = tag - 100;
    script += fmt::format(
        "set label {} {} at screen {:.4f},{:.4f} left offset 1.5,0 noenhanced point pt {} ps {} lw 2 lc rgb '{}' tc rgb '#222222'\n", tag++,
        gnuplot_quoted(name), 0.06 + 0.19 * (k % 5), (66.0 - 22 * (k / 5)) / height, mark, size, color);
  };
  add("the scene as it is", "#000000", 3, 1.6);
  add("Pareto front", "#f0c75e", 7, 2.2);
  for (const auto& knob : knobs) add(knob, look_of(knob).color, look_of(knob).mark, 1.1);
  return script;
}

}  // namespace

void draw_accuracies(const std::vector<AccuracyStudy>& studies, const std::string& path) {
  const int columns = studies.size() > 4 ? 4 : int(std::max<std::size_t>(1, studies.size()));
  const int rows = (int(studies.size()) + columns - 1) / columns, width = 470 * columns, height = 430 * rows + 125;
  Picture picture;
  std::string panels;
  for (std::size_t k = 0; k < studies.size(); ++k) {
    const AccuracyStudy& s = studies[k];
    const std::string plots = panel(s, true, false, picture);
    if (plots.empty()) continue;
    const double x = double(int(k) % columns), y = double(int(k) / columns), w = 1.0 / columns, h = 430.0 / height, top = 1 - 45.0 / height;
    panels += fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
        (x + 0.17) * w, (x + 0.97) * w, top - y * h - 0.13 * h, top - y * h - 0.84 * h);
    panels += fmt::format(
        "set label 2 {} at graph 0, graph 1.12 left noenhanced font ',13'\nset label 3 {} at graph 0, graph 1.05 left noenhanced font ',9' "
        "tc rgb '#555555'\n",
        gnuplot_quoted(s.name), gnuplot_quoted(orders(s)));
    panels += fmt::format("set xlabel 'contact points evaluated' font ',10'\nset ylabel {} noenhanced font ',10'\n{}unset key\n",
                          gnuplot_quoted(error_label(s.quantity())), error_range(s));
    panels += "plot " + plots + "\n" + (k == 0 ? "unset label\n" : "");
  }
  if (panels.empty()) return;
  std::string script = head(path, width, height) + picture.script + common_legend(studies, height);
  script += fmt::format("set label 1 'What accuracy costs: error over work, one line a knob' at screen 0.5,{:.4f} center font ',16'\n",
                        1 - 22.0 / height);
  run_gnuplot(script + panels + "unset multiplot\n", path);
}

}  // namespace erbs
