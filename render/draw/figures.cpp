#include "render/draw/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/plot/figure.h"
#include "engine/record/plot/gnuplot.h"
#include "render/draw/draw.h"
#include "render/draw/push_figure.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;

double peak_of(const CsvTable& table, const std::vector<int>& columns) {
  double peak = 0;
  for (int c : columns)
    for (double value : table.columns[static_cast<std::size_t>(c)])
      if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  return peak;
}

void choose_unit(Panel& panel, const CsvTable& table, const std::string& suffix) {
  const plot::Unit* unit = plot::find_unit(suffix);
  if (!unit) return;
  const plot::ShownUnit& shown = plot::shown_unit(*unit, peak_of(table, panel.columns));
  panel.factor = shown.factor;
  panel.label += fmt::format(" [{}]", shown.name);
}

// Okabe and Ito (2008), which the colour-blind can tell apart; with a dash for each further round.
constexpr std::array<const char*, 8> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"};

std::string name_of(const CsvTable& table, int column) { return words_of(table.names[static_cast<std::size_t>(column)]); }

constexpr std::size_t most_names = 2 * colors.size();  // beside a panel; what is more is grey, and lies behind

// All curves of a panel. The name of the file is quoted, since a run folder may come from anywhere.
std::vector<plot::Series> curves(const std::string& file, const CsvTable& table, const Panel& panel, const std::string& value) {
  std::vector<plot::Series> all, behind;
  const std::size_t named = panel.columns.size() > most_names ? most_names - 1 : most_names;
  for (const int column : panel.columns) {
    const std::size_t i = all.size();
    const std::string source =
        fmt::format("{} every {}::1 using 1:({})", gnuplot_quoted(file), std::max<std::size_t>(1, table.rows() / 6000),
                    fmt::format(fmt::runtime(value), fmt::arg("c", column + 1), fmt::arg("f", panel.factor)));
    if (i == named) behind.push_back({source, "lines lw 1 lc rgb '#cccccc'"});
    else
      all.push_back({source, fmt::format("lines lw 1.3 lc rgb '{}'{}", colors[i % colors.size()], i >= colors.size() ? " dashtype 2" : ""),
                     name_of(table, column)});
  }
  if (!behind.empty()) all.push_back({"1/0", "lines lw 1 lc rgb '#cccccc'", fmt::format("and {} more", behind.size())});
  behind.insert(behind.end(), all.begin(), all.end());
  return behind;
}

// Tics at a fifth of the height. A quantity without a unit is labelled by its column name.
plot::Axis vertical(const CsvTable& table, const Panel& panel) {
  const auto [low, high] = shown_range(table, panel);
  return {panel.label, fmt::format("[{:.8g}:{:.8g}]", low, high), fmt::format("{:g}", round_length((high - low) / 5)), "", "noenhanced"};
}

// A vertical line at the first event of each kind; its name only with `named`.
void add_marks(const Run& run, double last_time, bool named, plot::Panel& p) {
  double row = 0.7;  // names stand below each other to avoid overlap
  for (const Mark& mark : run.marks) {
    if (mark.t > last_time) continue;
    p.add_vertical(mark.t, "back lc rgb '#8a2f20' lw 1 dashtype 3");
    if (!named) continue;
    const bool right = mark.t > 0.7 * last_time;
    p.labels.push_back(
        {fmt::format("{} {}", mark.name, mark.when), fmt::format("first {},graph 1", mark.t),
         fmt::format("{} offset {},-{} front boxed tc rgb '#8a2f20' font ',11'", right ? "right" : "left", right ? -0.6 : 0.6, row)});
    row += 1;
  }
}

constexpr double above_panels = 22, panel_height = 210;  // px

// A sheet of panels that are together `height` px high, with room at the right of each for names of `name_length` letters.
plot::Figure sheet(double height, std::size_t columns, std::size_t name_length, const std::string& title) {
  plot::Figure figure{columns == 1 ? 1000 : 850 * double(columns), height};
  figure.settings = fmt::format(
      "set datafile separator comma\nset datafile missing 'nan'\nset zeroaxis lc rgb '#b0b0b0' lt 1 lw 0.8\n"
      "set style textbox opaque noborder fc rgb '#ffffff' margins 0.4,0.2\nset lmargin 12\nset rmargin {}\n",
      8 + name_length * 4 / 5);
  figure.labels = {{title, fmt::format("screen 0.5,{:.5f}", 1 - 19 / figure.height), "center font ',15'"}};
  return figure;
}

constexpr const char* beside = "at graph 1.015,1 left top Left reverse samplen 1.6 spacing 1.05 noenhanced";

plot::Figure histories_figure(const std::string& csv, const CsvTable& table, const Run& run) {
  std::vector<std::string> left_out;
  const std::vector<Panel> panels = history_panels(table, &left_out);
  const std::size_t columns = panels.size() > 6 ? 2 : 1, rows = (panels.size() + columns - 1) / columns;
  const double last_time = table.columns[0].back();
  std::size_t longest = 0;
  for (const Panel& panel : panels)
    for (int c : panel.columns) longest = std::max(longest, name_of(table, c).size());
  std::vector<double> heights(rows, panel_height);  // px: gnuplot writes the names of a panel beside each other if they do not fit below
  for (std::size_t i = 0; i < panels.size(); ++i)
    heights[i % rows] = std::max(heights[i % rows], 95 + 21 * double(std::min(panels[i].columns.size(), most_names)));
  plot::Figure figure = sheet(std::accumulate(heights.begin(), heights.end(), above_panels + 48), columns, longest, run.title);
  const double width = 1 / double(columns), share = (1 - above_panels / figure.height) / (figure.height - above_panels - 48);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    plot::Panel p;
    const std::size_t row = i % rows;
    const double left = double(i / rows) * width,
                 bottom = share * std::accumulate(heights.begin() + std::ptrdiff_t(row) + 1, heights.end(), 0.0);
    p.cell = {left, left + width, bottom, bottom + share * heights[row]};
    p.key = beside;
    p.x = {"", fmt::format("[0:{}]", last_time), "", "", "noenhanced"};
    p.y = vertical(table, panels[i]);
    if ((i + 1) % rows == 0 || i + 1 == panels.size()) p.x.label = "time [s]";
    if (i + 1 == panels.size() && !left_out.empty())
      p.x.label += fmt::format("     (not drawn, below 2 % of the other direction: {})", fmt::join(left_out, ", "));
    add_marks(run, last_time, i % rows == 0, p);
    p.series = curves(csv, table, panels[i], "column({c})*{f}");
    figure.panels.push_back(p);
  }
  return figure;
}

plot::Figure energy_figure(const std::string& csv, const CsvTable& table, const Run& run) {
  Panel large{"energy", 1, {}}, small{"energy, small terms", 1, {}};
  std::vector<int> terms;
  for (std::size_t c = 1; c < table.names.size(); ++c)
    if (unit_of(table.names[c]) == "J" && table.names[c] != "residual_J" && peak_of(table, {static_cast<int>(c)}) > 0)
      terms.push_back(static_cast<int>(c));
  // Beside the potential energy of a fall, the terms that caused it would be flat lines.
  const double largest = peak_of(table, terms);
  for (const int c : terms) (peak_of(table, {c}) < 0.05 * largest ? small : large).columns.push_back(c);
  choose_unit(large, table, "J"), choose_unit(small, table, "J");
  const double last_time = table.columns[0].back();
  const int residual = table.find("residual_relative");
  const double worst = residual >= 0 ? peak_of(table, {residual}) : 0;
  plot::Figure figure = sheet(70 + panel_height * (small.columns.empty() ? 3 : 4), 1, 18, run.title + ": energy");
  const double top = 1 - 30 / figure.height, rest = small.columns.empty() ? 0.36 : 0.27, middle = small.columns.empty() ? rest : 0.54;
  plot::Panel above, between, below;
  above.cell = {0, 1, middle, top};
  between.cell = {0, 1, rest, middle};
  below.cell = {0, 1, 0, rest};
  above.key = between.key = beside;
  above.x.range = between.x.range = below.x.range = fmt::format("[0:{}]", last_time);
  above.y = vertical(table, large);
  add_marks(run, last_time, true, above), add_marks(run, last_time, false, between), add_marks(run, last_time, false, below);
  above.series = curves(csv, table, large, "column({c})*{f}");
  if (above.series.empty()) above.series = {{"0", "lines"}};
  if (!small.columns.empty()) {
    between.y = vertical(table, small);
    between.series = curves(csv, table, small, "column({c})*{f}");
  }
  // Energy tolerance of the run. If the scene leaves it to the kind of run, all three standard tolerances.
  std::vector<std::pair<double, std::string>> tolerances{{run.energy_tolerance, "gate"}};
  if (run.energy_tolerance <= 0) tolerances = {{1e-6, "gate, elastic"}, {1e-3, "gate, cracked"}, {1e-2, "gate, collapse"}};
  below.x.label = "time [s]";
  below.y = {"residual, relative",
             fmt::format("[{}:{}]", std::min(1e-12, worst > 0 ? worst * 1e-4 : 1e-12), std::max(worst, tolerances.back().first) * 10),
             "1e-18,1e3",
             "10^{%T}",
             "",
             true};
  below.settings = "unset mytics\n";
  for (const auto& [tolerance, name] : tolerances) {
    below.add_horizontal(tolerance, "lc rgb '#c07060' dashtype 2");
    below.labels.push_back(
        {fmt::format("{} {:g}", name, tolerance), fmt::format("graph 1.015, first {:g}", tolerance), "left tc rgb '#b03020' font ',11'"});
  }
  below.series = {{"1e-16", "lines"}};
  if (worst > 0) below.series = curves(csv, table, {"", 1, {residual}}, "abs(column({c})) > 1e-16 ? abs(column({c})) : 1e-16");
  figure.panels = {above, between, below};  // one without series is left out
  return figure;
}

// The two files have the same rows, but for the one in which a run may have been ended.
void warn_of_ends(const std::string& csv, const CsvTable& table, double& other_end) {
  if (table.rows() < 2) return;
  const std::vector<double>& t = table.columns[0];
  const double end = t.back(), step = (end - t.front()) / static_cast<double>(t.size() - 1);
  if (std::abs(end - other_end) > 1.5 * step)
    tell(stderr,
         fmt::format("warning: {} ends at {:g} s, histories.csv at {:g} s: a file was cut off; run the scene again", csv, end, other_end));
  other_end = end;
}

}  // namespace

std::pair<double, double> shown_range(const CsvTable& table, const Panel& panel) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const int c : panel.columns)
    for (const double value : table.columns[static_cast<std::size_t>(c)])
      if (std::isfinite(value)) low = std::min(low, value * panel.factor), high = std::max(high, value * panel.factor);
  if (low > high) return {-1, 1};
  const double span = high - low, most = std::max(std::abs(low), std::abs(high));
  if (!(span > 1e-4 * most)) return most > 0 ? std::pair{std::min(0.0, 1.1 * low), std::max(0.0, 1.1 * high)} : std::pair{-1.0, 1.0};
  // Zero is shown if the curves then still fill two thirds of the height.
  if (low > 0 && low < 0.5 * span) low = 0;
  if (high < 0 && -high < 0.5 * span) high = 0;
  const double air = 0.04 * (high - low);
  return {low == 0 ? 0 : low - air, high == 0 ? 0 : high + air};
}

std::vector<Panel> history_panels(const CsvTable& table, std::vector<std::string>* left_out) {
  Panel ground{"ground [g]", 1 / standard_g, {}}, gravity{"gravity [g]", 1 / standard_g, {}};
  std::vector<std::pair<std::string, Panel>> by_unit;
  for (std::size_t c = 1; c < table.names.size(); ++c) {
    const std::string& name = table.names[c];
    const int column = static_cast<int>(c);
    if (name.rfind("ground_a", 0) == 0 && unit_of(name) == "m_s2") {
      if (peak_of(table, {column}) > 0) ground.columns.push_back(column);
      continue;
    }
    if (name.rfind("gravity_a", 0) == 0 && unit_of(name) == "m_s2") {
      if (peak_of(table, {column}) > 0) gravity.columns.push_back(column);
      continue;
    }
    const std::string unit = unit_of(name);
    // Each direction of a quantity gets its own panel. On a common scale, directions with small values would be flat lines.
    const std::string words = words_of(name);
    std::string axis, frame;
    for (const char* f : {" rel", " abs"})
      if (words.size() > 4 && words.compare(words.size() - 4, 4, f) == 0) frame = f;
    for (const char* a : {"x", "y", "z"})
      for (const std::string& end : {std::string(a), a + std::string(" rel"), a + std::string(" abs")})
        // "ux" and "u x", not "max"
        if (const std::size_t at = words.size() - end.size(); words.size() > end.size() + 1 && words.compare(at, end.size(), end) == 0)
          if (words[at - 1] == ' ' || words[at - 2] == ' ') axis = a;
    // A quantity without a unit gets an axis of its own.
    const std::string key = unit + "/" + axis + frame + (unit.empty() ? words : "");
    auto known = std::find_if(by_unit.begin(), by_unit.end(), [&](const auto& p) { return p.first == key; });
    if (known == by_unit.end()) {
      const plot::Unit* u = plot::find_unit(unit);
      by_unit.push_back({key, {(u ? u->quantity : words) + (axis.empty() ? "" : " " + axis) + frame, 1, {}, !axis.empty()}});
      known = by_unit.end() - 1;
    }
    known->second.columns.push_back(column);
  }
  std::vector<Panel> panels;
  if (!ground.columns.empty()) panels.push_back(ground);
  if (!gravity.columns.empty()) panels.push_back(gravity);
  // Panels with hardly any movement, compared to another direction of the same quantity, are left out.
  std::map<std::string, double> largest;  // largest value by unit and frame
  const auto sort_of = [](const std::string& key, bool directed) {
    const std::size_t slash = key.find('/');
    return directed ? key.substr(0, slash) + key.substr(slash + 2) : key;
  };
  for (const auto& [key, panel] : by_unit)
    if (panel.directed) {
      double& most = largest[sort_of(key, true)];
      most = std::max(most, peak_of(table, panel.columns));
    }
  for (auto& [key, panel] : by_unit) {
    if (left_out && panel.directed && peak_of(table, panel.columns) < 0.02 * largest[sort_of(key, true)]) {
      left_out->push_back(panel.label);
      continue;
    }
    choose_unit(panel, table, key.substr(0, key.find('/')));
    panels.push_back(panel);
  }
  return panels;
}

std::vector<std::string> write_figures(const Run& run) {
  std::vector<std::string> written;
  const fs::path dir(run.dir);
  if (fs::exists(dir / "curve.csv")) {  // a push has states instead of time
    const CsvTable curve = read_csv((dir / "curve.csv").string());
    if (curve.rows() < 2) return written;
    written.push_back((dir / "curve.svg").string());
    plot::draw(push_figure("curve.csv", curve, run), written.back());
    return written;
  }
  double other_end = NAN;  // s, of the histories
  for (const std::string name : {"histories", "energy"}) {
    const std::string csv = name + ".csv", svg = (dir / (name + ".svg")).string();
    if (!fs::exists(dir / csv)) continue;
    const CsvTable table = read_csv((dir / csv).string());
    warn_of_ends(csv, table, other_end);
    if (table.rows() < 2 || table.names.size() < 2 || table.columns[0].back() <= 0) continue;
    plot::draw(name == "energy" ? energy_figure(csv, table, run) : histories_figure(csv, table, run), svg);
    written.push_back(svg);
  }
  return written;
}

}  // namespace erbs::render
