// Work-precision figures: error over processor time and over work, one line per knob.
#include <algorithm>
#include <cmath>

#include "engine/record/plot/figure.h"
#include "lua/reports/accuracy/accuracy.h"

namespace erbs::lua {
namespace {

constexpr double least = 1e-13;  // an error of zero is drawn here
// Color and marker of a knob; the same in every panel.
struct Look {
  std::string knob, color;
  int mark = 0;
};
const Look built_in[] = {
    {"time step", "#1b4f8a", 7},           {"points, simpson", "#c0502d", 5},     {"points, midpoint", "#3f8f46", 9},
    {"points, trapezoid", "#8a5a9e", 11},  {"points, gauss", "#a07810", 13},      {"lazy rotation", "#2f9aa8", 4},
    {"sequential, literal", "#a33a5a", 6}, {"sequential, centred", "#d08a70", 8}, {"sequential, coloured", "#7d7d7d", 12},
    {study::together_knob, "#111111", 15}};
// Of the knobs that scenes declare, in their order.
const std::pair<const char*, int> further[] = {{"#d1337e", 7}, {"#0f8f80", 9}, {"#6a4bc4", 11}, {"#7a5230", 13}, {"#4d7ca8", 5}};
constexpr const char *front_look = "linespoints lw 7 pt 6 ps 2.2 lc rgb '#f0c75e'",
                     *own_front_look = "linespoints lw 2.5 dt (6,4) pt 1 ps 1.1 lc rgb '#8a8a8a'";

// What a panel shows.
struct View {
  bool points = false;   // cost: points evaluated, else processor time
  bool own = false;      // errors against the limit that the scene itself approaches
  bool titles = false;   // with the legend
  bool compared = true;  // with the settings that are there for comparison only
};

class Looks {
 public:
  explicit Looks(const std::vector<const AccuracyStudy*>& studies) : looks_(std::begin(built_in), std::end(built_in)) {
    std::size_t next = 0;
    for (const AccuracyStudy* s : studies)
      for (const study::Measured& m : s->all)
        if (const std::string& knob = m.setting.knob; m.setting.declared && !has(knob)) {
          const auto& [color, mark] = further[next++ % std::size(further)];
          looks_.push_back({knob, color, mark});
        }
  }
  const Look& of(const std::string& knob) const {
    for (const Look& look : looks_)
      if (knob == look.knob) return look;
    return looks_[0];
  }

 private:
  bool has(const std::string& knob) const {
    return std::any_of(looks_.begin(), looks_.end(), [&](const Look& look) { return look.knob == knob; });
  }
  std::vector<Look> looks_;
};

std::optional<double> error_in(const AccuracyStudy& s, const View& view, const study::Measured& m) {
  return view.own ? s.own_error(m) : s.error(m);
}

std::string row(const AccuracyStudy& s, const View& view, std::size_t i) {
  const double cost = view.points ? s.all[i].updates : s.all[i].cpu;
  const auto error = error_in(s, view, s.all[i]);
  return cost > 0 && error ? fmt::format("{:.6g} {:.6g}\n", cost, std::max(least, *error)) : "";
}

std::string rows_of(const AccuracyStudy& s, const View& view, const std::vector<std::size_t>& which) {
  std::string rows;
  for (const std::size_t i : which) rows += row(s, view, i);
  return rows;
}

std::string legend(const study::Curve& c) {
  if (!c.slope) return c.knob;
  if (c.knob == "time step") return fmt::format("time step: dt^{{{:.2f}}}", *c.slope);
  if (c.knob.starts_with("points")) return fmt::format("{}: n^{{-{:.2f}}}", c.knob, *c.slope);
  if (c.knob.starts_with("sequential")) return fmt::format("{}: 1/n^{{{:.2f}}}", c.knob, *c.slope);
  return fmt::format("{}: order {:.2f}", c.knob, *c.slope);
}

// The settings of all knobs of the scene together, from coarse to fine.
std::vector<std::size_t> together(const AccuracyStudy& s) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < s.all.size(); ++i)
    if (s.all[i].setting.knob == study::together_knob && s.error(s.all[i])) found.push_back(i);
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) { return s.all[a].setting.size > s.all[b].setting.size; });
  return found;
}

// Knobs whose curves a panel shows.
std::vector<study::Curve> curves_in(const AccuracyStudy& s, bool compared) {
  std::vector<study::Curve> curves = curves_of(s.quantity(), s.main, s.all);
  std::erase_if(curves,
                [&](const study::Curve& c) { return !compared && (c.knob.starts_with("sequential") || c.knob == "lazy rotation"); });
  return curves;
}

plot::Panel panel_of(const AccuracyStudy& s, const View& view, const Looks& looks, plot::Figure& figure) {
  plot::Panel p;
  p.x.format = p.y.format = "10^{%T}";
  p.x.log = p.y.log = true;
  const auto add = [&](const std::string& rows, const std::string& look, const std::string& title, const char* columns = "1:2") {
    if (!rows.empty()) p.series.push_back({figure.add_rows(rows) + " using " + columns, look, view.titles ? title : ""});
  };
  add(rows_of(s, view, pareto(s.quantity(), s.main, s.all, view.points, view.own)), front_look, "Pareto front");
  for (const study::Curve& c : curves_in(s, view.compared)) {
    if (view.own && s.all[c.at.front()].setting.declared && s.quantity().scatters) continue;
    const Look& look = looks.of(c.knob);
    add(rows_of(s, view, c.at), fmt::format("linespoints lw 1.8 pt {} ps 1.0 lc rgb '{}'", look.mark, look.color), legend(c));
  }
  const Look& all_knobs = looks.of(study::together_knob);
  add(rows_of(s, view, together(s)), fmt::format("linespoints lw 2.2 pt {} ps 1.1 lc rgb '{}'", all_knobs.mark, all_knobs.color),
      study::together_knob);
  for (std::size_t i = 0; i < s.all.size() && view.titles; ++i) {
    std::string data = s.all[i].setting.knob == study::quality_knob ? row(s, view, i) : "";
    if (data.empty()) continue;
    data.back() = ' ';
    add(data + s.all[i].setting.name.substr(8) + "\n", "labels point pt 2 ps 1.2 lw 2 lc rgb '#000000' offset 0,-0.9 font ',10'", "",
        "1:2:3");
  }
  for (std::size_t i = 0; i < s.all.size(); ++i)
    if (s.all[i].setting.knob.empty()) add(row(s, view, i), "points pt 3 ps 1.8 lw 2 lc rgb '#000000'", "the scene as it is");
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

std::string limit_text(double value, double uncertainty, const std::string& unit, const std::string& from) {
  return fmt::format("{:.6g} {} by {}{}", value, unit, from, uncertainty > 0 ? fmt::format(", uncertainty {:.1g}", uncertainty) : "");
}

}  // namespace

void draw_accuracy(const AccuracyStudy& s, const std::string& path) {
  const study::Goal& q = s.quantity();
  const Looks looks({&s});
  std::vector<std::pair<View, const char*>> views{{{false, false, false}, q.expected ? "against theory" : "against its own limit"},
                                                  {{true, false, true}, q.expected ? "against theory, over work" : "the same over work"}};
  if (q.expected) views.insert(views.begin() + 1, {{false, true, false}, "against its own limit"});
  const double panel = 460, gap = 95, key = 330, left = 100, width = left + double(views.size()) * (panel + gap) - gap + 20 + key;
  plot::Figure figure{width, 720, 14};
  std::string subtitle = fmt::format("{} = {}", words_of(q.name), limit_text(q.reference, q.uncertainty, q.unit, q.from));
  if (q.expected) subtitle += fmt::format("; own limit {:.6g} {}", q.own_limit, q.unit);
  figure.labels = {{"What accuracy costs: " + s.name, fmt::format("screen {:.4f},0.965", 30 / width), "left font ',18'"},
                   {subtitle, fmt::format("screen {:.4f},0.92", 30 / width), "left tc rgb '#555555'"}};
  for (std::size_t i = 0; i < views.size(); ++i) {
    plot::Panel p = panel_of(s, views[i].first, looks, figure);
    const double from = left + double(i) * (panel + gap);
    p.axes = {from / width, (from + panel) / width, 0.11, 0.83};
    p.x.label = views[i].first.points ? "contact points evaluated" : "processor time [s]";
    p.labels = {{views[i].second, "graph 0, graph 1.03", "left tc rgb '#555555'"}};
    if (i == 0) p.y.label = error_label(q), p.y.look = "noenhanced";
    if (views[i].first.titles)
      p.key = fmt::format("at screen {:.4f},0.83 left top Left reverse samplen 2 spacing 1.25", (from + panel + 20) / width);
    figure.panels.push_back(p);
  }
  plot::draw(figure, path);
}

namespace {

// Subtitle of a panel: how far the front falls, and what ends it.
std::string fall(const AccuracyStudy& s) {
  const std::vector<std::size_t> front = pareto(s.quantity(), s.main, s.all, false);
  const auto ending = ending_of(s.quantity(), s.main, s.all);
  if (front.empty() || !ending) return "no run gave a value";
  const double first = s.error(s.all[front.front()]).value_or(least), last = s.error(s.all[front.back()]).value_or(least);
  return fmt::format("{:.1f} decades; ended by {}", std::log10(std::max(least, first) / std::max(least, last)),
                     ending->knob.empty() ? "the model" : ending->knob);
}

// Range of the error axis: at least one decade, with a margin beyond the curves shown.
std::string error_range(const AccuracyStudy& s, const View& view) {
  double low = 1e300, high = 0;
  for (const study::Curve& c : curves_in(s, view.compared))
    for (const std::size_t i : c.at)
      if (const auto error = error_in(s, view, s.all[i]))
        low = std::min(low, std::max(least, *error)), high = std::max(high, std::max(least, *error));
  if (high == 0) return "[*:*]";
  const double middle = std::sqrt(low * high), reach = std::max(std::sqrt(10.0), 2 * std::sqrt(high / low));
  double from = middle / reach, to = middle * reach;
  if (to < 100 * from)  // else only one number, a power of ten, might stand at the axis
    from = std::pow(10.0, std::floor(std::log10(from))), to = std::pow(10.0, std::ceil(std::log10(to)));
  return fmt::format("[{:.4g}:{:.4g}]", from, to);
}

std::vector<std::string> knobs_of(const std::vector<AccuracyStudy>& studies) {
  std::vector<std::string> knobs;
  for (const AccuracyStudy& s : studies) {
    for (const study::Curve& c : curves_in(s, false))
      if (std::find(knobs.begin(), knobs.end(), c.knob) == knobs.end()) knobs.push_back(c.knob);
    if (!together(s).empty() && std::find(knobs.begin(), knobs.end(), study::together_knob) == knobs.end())
      knobs.emplace_back(study::together_knob);
  }
  return knobs;
}

// One legend for all panels, at the bottom, `across` entries a row.
constexpr int across = 5;
std::vector<plot::Label> common_legend(const std::vector<std::string>& knobs, int rows, const Looks& looks, double height) {
  std::vector<plot::Label> labels;
  const auto add = [&](const std::string& name, const std::string& color, int mark, double size) {
    const int k = int(labels.size());
    labels.push_back({name, fmt::format("screen {:.4f},{:.4f}", 0.06 + 0.19 * (k % across), 22.0 * (rows - k / across) / height),
                      fmt::format("left offset 1.5,0 point pt {} ps {} lw 2 lc rgb '{}'", mark, size, color)});
  };
  add("the scene as it is", "#000000", 3, 1.6);
  add("Pareto front", "#f0c75e", 7, 2.2);
  add("step and points against the own limit", "#8a8a8a", 1, 1.4);
  for (const auto& knob : knobs) add(knob, looks.of(knob).color, looks.of(knob).mark, 1.1);
  return labels;
}

}  // namespace

void draw_accuracies(const std::vector<AccuracyStudy>& studies, const std::string& path) {
  std::vector<const AccuracyStudy*> pointers;
  for (const AccuracyStudy& s : studies) pointers.push_back(&s);
  const Looks looks(pointers);
  const int columns = studies.size() > 4 ? 4 : int(std::max<std::size_t>(1, studies.size()));
  const std::vector<std::string> knobs = knobs_of(studies);
  const int legend_rows = (3 + int(knobs.size()) + across - 1) / across;
  const int rows = (int(studies.size()) + columns - 1) / columns, width = 470 * columns, height = 430 * rows + 59 + 22 * legend_rows;
  plot::Figure figure{double(width), double(height), 14};
  figure.labels = common_legend(knobs, legend_rows, looks, height);
  figure.labels.push_back({"What accuracy costs: error over processor time, one line a knob",
                           fmt::format("screen 0.5,{:.4f}", 1 - 22.0 / height), "center font ',16'"});
  const View view{.compared = false};
  for (std::size_t k = 0; k < studies.size(); ++k) {
    const AccuracyStudy& s = studies[k];
    plot::Panel p = panel_of(s, view, looks, figure);
    // Where theory ends the fall, step and points may go on towards the scene's own limit.
    const View own{.own = true, .compared = false};
    std::vector<std::size_t> own_front = pareto(s.quantity(), s.main, s.all, false, true);
    std::erase_if(own_front, [&](std::size_t i) { return !(s.own_error(s.all[i]).value_or(0) > least); });  // they change nothing at all
    const std::string rest = s.quantity().expected ? rows_of(s, own, own_front) : "";
    if (!rest.empty()) p.series.push_back({figure.add_rows(rest) + " using 1:2", own_front_look, ""});
    const double x = double(int(k) % columns), y = double(int(k) / columns), w = 1.0 / columns, h = 430.0 / height, top = 1 - 45.0 / height;
    p.axes = {(x + 0.17) * w, (x + 0.97) * w, top - y * h - 0.84 * h, top - y * h - 0.13 * h};
    p.labels = {{s.name, "graph 0, graph 1.12", "left font ',13'"}, {fall(s), "graph 0, graph 1.05", "left font ',10' tc rgb '#555555'"}};
    p.x.label = "processor time [s]", p.x.look = "font ',10'";
    p.y.label = error_label(s.quantity()) + (s.quantity().expected ? "" : " (own limit)"), p.y.look = "noenhanced font ',10'",
    p.y.range = error_range(s, view);
    figure.panels.push_back(p);
  }
  plot::draw(figure, path);
}

}  // namespace erbs::lua
