// Work-precision figures: error over cost, one line per kind of setting.
#include <algorithm>
#include <cmath>

#include "engine/record/plot/figure.h"
#include "lua/reports/accuracy.h"

namespace erbs::lua {
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

std::string row(const AccuracyStudy& s, std::size_t i, bool by_updates) {
  const double cost = by_updates ? s.all[i].updates : s.all[i].cpu;
  return cost > 0 ? fmt::format("{:.6g} {:.6g}\n", cost, std::max(least, *error_of(s.quantity(), s.all[i].values[s.main]))) : "";
}

std::string legend(const study::Curve& c) {
  if (!c.slope) return c.knob;
  if (c.knob == "time step") return fmt::format("time step: dt^{{{:.2f}}}", *c.slope);
  if (c.knob.starts_with("points")) return fmt::format("{}: n^{{-{:.2f}}}", c.knob, *c.slope);
  if (c.knob.starts_with("sequential")) return fmt::format("{}: 1/n^{{{:.2f}}}", c.knob, *c.slope);
  return fmt::format("{}: slope {:.2f}", c.knob, *c.slope);
}

// The curves of a panel; their titles only in the panel with the legend.
plot::Panel panel_of(const AccuracyStudy& s, bool by_updates, bool titles, plot::Figure& figure) {
  plot::Panel p;
  p.x.format = p.y.format = "10^{%T}";
  p.x.log = p.y.log = true;
  const auto add = [&](const std::string& rows, const std::string& look, const std::string& title, const char* columns = "1:2") {
    if (!rows.empty()) p.series.push_back({figure.add_rows(rows) + " using " + columns, look, titles ? title : ""});
  };
  const auto is_point = [&](const study::Measured& m, const std::string& knob) {
    return m.setting.knob == knob && error_of(s.quantity(), m.values[s.main]);
  };
  std::string front;
  for (const std::size_t i : pareto(s.quantity(), s.main, s.all, by_updates)) front += row(s, i, by_updates);
  add(front, "linespoints lw 7 pt 6 ps 2.2 lc rgb '#f0c75e'", "Pareto front");
  for (const study::Curve& c : curves_of(s.quantity(), s.main, s.all)) {
    std::string data;
    for (const std::size_t i : c.at) data += row(s, i, by_updates);
    const Look& look = look_of(c.knob);
    add(data, fmt::format("linespoints lw 1.8 pt {} ps 1.0 lc rgb '{}'", look.mark, look.color), legend(c));
  }
  for (std::size_t i = 0; i < s.all.size() && titles; ++i) {
    std::string data = is_point(s.all[i], study::quality_knob) ? row(s, i, by_updates) : "";
    if (data.empty()) continue;
    data.back() = ' ';
    add(data + s.all[i].setting.name.substr(8) + "\n", "labels point pt 2 ps 1.2 lw 2 lc rgb '#000000' offset 0,-0.9 font ',10'", "",
        "1:2:3");
  }
  for (std::size_t i = 0; i < s.all.size(); ++i)
    if (is_point(s.all[i], "")) add(row(s, i, by_updates), "points pt 3 ps 1.8 lw 2 lc rgb '#000000'", "the scene as it is");
  return p;
}

std::string words_of(std::string name) {
  if (name.starts_with("metrics.")) name = name.substr(8);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string error_label(const study::Goal& q) {
  return q.reference != 0 ? fmt::format("relative error of {}", words_of(q.name))
                          : fmt::format("error of {} [{}]", words_of(q.name), q.unit.empty() ? "-" : q.unit);
}

}  // namespace

void draw_accuracy(const AccuracyStudy& s, const std::string& path) {
  const study::Goal& q = s.quantity();
  plot::Figure figure{1500, 720, 14};
  figure.labels = {{"What accuracy costs: " + s.name, "screen 0.03,0.965", "left font ',18'"},
                   {fmt::format("{} = {:.6g} {} by {}{}", words_of(q.name), q.reference, q.unit, q.from,
                                q.uncertainty > 0 ? fmt::format(", uncertainty {:.1g}", q.uncertainty) : ""),
                    "screen 0.03,0.925", "left tc rgb '#555555'"}};
  plot::Panel left = panel_of(s, false, false, figure), right = panel_of(s, true, true, figure);
  left.axes = {0.075, 0.39, 0.11, 0.88};
  left.x.label = "processor time [s]";
  left.y.label = error_label(q), left.y.look = "noenhanced";
  right.axes = {0.46, 0.775, 0.11, 0.88};
  right.x.label = "contact points evaluated";
  right.key = "at screen 0.79,0.88 left top Left reverse samplen 2 spacing 1.25";
  figure.panels = {left, right};
  plot::draw(figure, path);
}

namespace {

// Subtitle of a panel: the observed orders of its curves, abbreviated to fit the width.
std::string orders(const AccuracyStudy& s) {
  std::string text;
  for (const study::Curve& c : curves_of(s.quantity(), s.main, s.all)) {
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
  for (const study::Measured& m : s.all)
    if (const auto error = error_of(s.quantity(), m.values[s.main]))
      low = std::min(low, std::max(least, *error)), high = std::max(high, std::max(least, *error));
  if (high == 0) return "[*:*]";
  const double middle = std::sqrt(low * high), reach = std::max(std::sqrt(10.0), 2 * std::sqrt(high / low));
  return fmt::format("[{:.4g}:{:.4g}]", middle / reach, middle * reach);
}

// One legend for all panels, at the bottom, five entries a row.
std::vector<plot::Label> common_legend(const std::vector<AccuracyStudy>& studies, double height) {
  std::vector<std::string> knobs;
  for (const AccuracyStudy& s : studies)
    for (const study::Curve& c : curves_of(s.quantity(), s.main, s.all))
      if (std::find(knobs.begin(), knobs.end(), c.knob) == knobs.end()) knobs.push_back(c.knob);
  std::vector<plot::Label> labels;
  const auto add = [&](const std::string& name, const char* color, int mark, double size) {
    const int k = int(labels.size());
    labels.push_back({name, fmt::format("screen {:.4f},{:.4f}", 0.06 + 0.19 * (k % 5), (66.0 - 22 * (k / 5)) / height),
                      fmt::format("left offset 1.5,0 point pt {} ps {} lw 2 lc rgb '{}'", mark, size, color)});
  };
  add("the scene as it is", "#000000", 3, 1.6);
  add("Pareto front", "#f0c75e", 7, 2.2);
  for (const auto& knob : knobs) add(knob, look_of(knob).color, look_of(knob).mark, 1.1);
  return labels;
}

}  // namespace

void draw_accuracies(const std::vector<AccuracyStudy>& studies, const std::string& path) {
  const int columns = studies.size() > 4 ? 4 : int(std::max<std::size_t>(1, studies.size()));
  const int rows = (int(studies.size()) + columns - 1) / columns, width = 470 * columns, height = 430 * rows + 125;
  plot::Figure figure{double(width), double(height), 14};
  figure.labels = common_legend(studies, height);
  figure.labels.push_back(
      {"What accuracy costs: error over work, one line a knob", fmt::format("screen 0.5,{:.4f}", 1 - 22.0 / height), "center font ',16'"});
  for (std::size_t k = 0; k < studies.size(); ++k) {
    const AccuracyStudy& s = studies[k];
    plot::Panel p = panel_of(s, true, false, figure);
    const double x = double(int(k) % columns), y = double(int(k) / columns), w = 1.0 / columns, h = 430.0 / height, top = 1 - 45.0 / height;
    p.axes = {(x + 0.17) * w, (x + 0.97) * w, top - y * h - 0.84 * h, top - y * h - 0.13 * h};
    p.labels = {{s.name, "graph 0, graph 1.12", "left font ',13'"}, {orders(s), "graph 0, graph 1.05", "left font ',9' tc rgb '#555555'"}};
    p.x.label = "contact points evaluated", p.x.look = "font ',10'";
    p.y.label = error_label(s.quantity()), p.y.look = "noenhanced font ',10'", p.y.range = error_range(s);
    figure.panels.push_back(p);
  }
  plot::draw(figure, path);
}

}  // namespace erbs::lua
