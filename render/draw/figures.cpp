#include "render/draw/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/plot/gnuplot.h"
#include "render/draw/draw.h"

namespace erbs::render {
namespace {

namespace fs = std::filesystem;

// A unit in column names, its quantity, and its displayed units. The first displayed unit applies whose `from` is not above the peak.
struct Shown {
  double from, factor;
  const char* unit;
};
struct Unit {
  const char* suffix;
  const char* quantity;
  std::vector<Shown> shown;
};
// Longer endings come first.
const std::vector<Unit>& units() {
  static const std::vector<Unit> list{
      {"rad_s2", "angular acceleration", {{0, 1, "rad/s²"}}},
      {"m_s2", "acceleration", {{0, 1, "m/s²"}}},
      {"rad_s", "spin", {{0, 1, "rad/s"}}},
      {"m_s", "velocity", {{0.5, 1, "m/s"}, {0, 1e3, "mm/s"}}},
      {"N_m", "moment", {{1e3, 1e-3, "kN m"}, {0, 1, "N m"}}},
      {"Pa", "stress", {{1e5, 1e-6, "MPa"}, {1e2, 1e-3, "kPa"}, {0, 1, "Pa"}}},
      {"rad", "rotation", {{0.05, 1, "rad"}, {0, 1e3, "mrad"}}},
      {"deg", "angle", {{0, 1, "deg"}}},
      {"Hz", "frequency", {{0, 1, "Hz"}}},
      {"kg", "mass", {{0, 1, "kg"}}},
      {"N", "force", {{1e6, 1e-6, "MN"}, {1e3, 1e-3, "kN"}, {0, 1, "N"}}},
      {"J", "energy", {{1e6, 1e-6, "MJ"}, {1e3, 1e-3, "kJ"}, {1, 1, "J"}, {0, 1e3, "mJ"}}},
      {"m", "displacement", {{1, 1, "m"}, {1e-4, 1e3, "mm"}, {0, 1e6, "µm"}}},
  };
  return list;
}

const Unit* find_unit(const std::string& suffix) {
  for (const Unit& u : units())
    if (suffix == u.suffix) return &u;
  return nullptr;
}

double peak_of(const CsvTable& table, const std::vector<int>& columns) {
  double peak = 0;
  for (int c : columns)
    for (double value : table.columns[static_cast<std::size_t>(c)])
      if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
  return peak;
}

void choose_unit(Panel& panel, const CsvTable& table, const std::string& suffix) {
  const Unit* unit = find_unit(suffix);
  if (!unit) return;
  const double peak = peak_of(table, panel.columns);
  for (const Shown& s : unit->shown) {
    if (peak < s.from) continue;
    panel.factor = s.factor;
    panel.label += fmt::format(" [{}]", s.unit);
    return;
  }
}

constexpr std::array<const char*, 8> colors{"#23527c", "#c0502d", "#4f8a4c", "#8a5a9e", "#b08a1e", "#3b9aa8", "#7d7d7d", "#a33a5a"};

// A quantity without a unit is labelled by its column name. The label is quoted, since a run folder may come from anywhere.
std::string label(const Panel& panel) { return gnuplot_quoted(panel.label); }

// All curves of a panel, every `every`-th row.
std::string plot(const std::string& file, const CsvTable& table, const Panel& panel, const std::string& value, std::size_t every) {
  std::string script = "plot ";
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    const int column = panel.columns[i];
    const char* style = panel.columns.size() > colors.size() && i >= colors.size() ? " dashtype 2" : "";
    script += fmt::format("{}{} every {}::1 using 1:({}) with lines lw 1.3 lc rgb '{}'{} title {}", i ? ", " : "", gnuplot_quoted(file),
                          every, fmt::format(fmt::runtime(value), fmt::arg("c", column + 1), fmt::arg("f", panel.factor)),
                          colors[i % colors.size()], style, gnuplot_quoted(words_of(table.names[static_cast<std::size_t>(column)])));
  }
  return script + "\n";
}

// Range that holds the whole curves, with tics at a fifth of the height.
std::string vertical(const CsvTable& table, const Panel& panel) {
  double low = 0, high = 0;
  for (int c : panel.columns)
    for (double value : table.columns[static_cast<std::size_t>(c)])
      if (std::isfinite(value)) low = std::min(low, value * panel.factor), high = std::max(high, value * panel.factor);
  if (!(high > low)) return "set yrange [-1:1]\nset ytics 1\n";
  const double step = round_length((high - low) / 5);
  return fmt::format("set yrange [{:g}:{:g}]\nset ytics {:g}\n", step * std::floor(low / step), step * std::ceil(high / step), step);
}

// A vertical line at the first event of each kind, in the plots that follow; its name only with `named`.
std::string marks_script(const Run& run, double last_time, bool named) {
  std::string script = "unset arrow\nunset label\n";
  double row = 0.7;  // names stand below each other to avoid overlap
  for (const Mark& mark : run.marks) {
    if (mark.t > last_time) continue;
    script += fmt::format("set arrow from first {0},graph 0 to first {0},graph 1 nohead back lc rgb '#8a2f20' lw 1 dashtype 3\n", mark.t);
    if (named) {
      const bool right = mark.t > 0.75 * last_time;
      script += fmt::format("set label {} at first {},graph 1 {} offset {},-{} front textcolor rgb '#8a2f20' font ',11' noenhanced\n",
                            gnuplot_quoted(fmt::format("{} {:.2f} s", mark.name, mark.t)), mark.t, right ? "right" : "left",
                            right ? -0.6 : 0.6, row);
      row += 1;
    }
  }
  return script;
}

// A sheet of `rows` by `columns` panels, with room at the right of each for names of `name_length` letters.
std::string opening(std::size_t rows, std::size_t columns, std::size_t name_length, double last_time, const std::string& title) {
  return fmt::format(
      "set terminal svg size {},{} dynamic enhanced font 'DejaVu Sans,13' background rgb 'white'\n"
      "set encoding utf8\nset datafile separator comma\nset datafile missing 'nan'\n"
      "set border 3 lc rgb '#707070'\nset tics nomirror out scale 0.6 textcolor rgb '#303030'\n"
      "set grid xtics ytics lc rgb '#e3e3e3' lt 1 lw 0.8\nset zeroaxis lc rgb '#b0b0b0' lt 1 lw 0.8\n"
      "set key at graph 1.015,1 left top Left reverse samplen 1.6 spacing 1.05 noenhanced\n"
      "set lmargin 12\nset rmargin {}\nset xrange [0:{}]\n"
      "set multiplot layout {},{} columnsfirst title {} noenhanced font ',15'\n",
      columns == 1 ? 1000 : 850 * columns, 70 + 210 * rows, 8 + name_length * 4 / 5, last_time, rows, columns, gnuplot_quoted(title));
}

std::string histories_script(const std::string& csv, const CsvTable& table, const Run& run) {
  std::vector<std::string> left_out;
  const std::vector<Panel> panels = history_panels(table, &left_out);
  const std::size_t every = std::max<std::size_t>(1, table.rows() / 6000);
  const std::size_t columns = panels.size() > 6 ? 2 : 1, rows = (panels.size() + columns - 1) / columns;
  std::size_t longest = 0;
  for (const Panel& panel : panels)
    for (int c : panel.columns) longest = std::max(longest, words_of(table.names[static_cast<std::size_t>(c)]).size());
  std::string script = opening(rows, columns, longest, table.columns[0].back(), run.title);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    script += marks_script(run, table.columns[0].back(), i % rows == 0);
    if ((i + 1) % rows == 0 || i + 1 == panels.size()) script += "set xlabel 'time [s]'\n";
    else script += "unset xlabel\n";
    if (i + 1 == panels.size() && !left_out.empty())
      script += fmt::format(
          "set xlabel {} noenhanced\n",
          gnuplot_quoted(fmt::format("time [s]     (not drawn, below 2 % of the other direction: {})", fmt::join(left_out, ", "))));
    script += vertical(table, panels[i]) + "set ylabel " + label(panels[i]) + " noenhanced\n" +
              plot(csv, table, panels[i], "column({c})*{f}", every);
  }
  return script + "unset multiplot\n";
}

std::string energy_script(const std::string& csv, const CsvTable& table, const Run& run) {
  Panel terms{"energy", 1, {}};
  for (std::size_t c = 1; c < table.names.size(); ++c)
    if (unit_of(table.names[c]) == "J" && table.names[c] != "residual_J" && peak_of(table, {static_cast<int>(c)}) > 0)
      terms.columns.push_back(static_cast<int>(c));
  choose_unit(terms, table, "J");
  const int residual = table.find("residual_relative");
  const std::size_t every = std::max<std::size_t>(1, table.rows() / 6000);
  std::string script = opening(3, 1, 18, table.columns[0].back(), run.title + ": energy");
  script += fmt::format("set size 1,0.60\nset origin 0,0.36\nset ylabel {} noenhanced\n", label(terms));
  script += marks_script(run, table.columns[0].back(), true) + vertical(table, terms);
  script += terms.columns.empty() ? "plot 0 notitle\n" : plot(csv, table, terms, "column({c})*{f}", every);
  script +=
      "set size 1,0.36\nset origin 0,0.0\nset xlabel 'time [s]'\nset ylabel 'residual, relative'\nset logscale y\nset format y "
      "'10^{%T}'\nset ytics 1e-18,1e3\nunset mytics\n";
  const double worst = residual >= 0 ? peak_of(table, {residual}) : 0;
  // Energy tolerance of the run. If the scene leaves it to the kind of run, all three standard tolerances.
  std::vector<std::pair<double, std::string>> tolerances{{run.energy_tolerance, "gate"}};
  if (run.energy_tolerance <= 0) tolerances = {{1e-6, "gate, elastic"}, {1e-3, "gate, cracked"}, {1e-2, "gate, collapse"}};
  script +=
      fmt::format("set yrange [{}:{}]\n", std::min(1e-12, worst > 0 ? worst * 1e-4 : 1e-12), std::max(worst, tolerances.back().first) * 10);
  script += "unset label\nset key off\n";
  for (const auto& [tolerance, name] : tolerances) {
    script += fmt::format(
        "set arrow from graph 0, first {0} to graph 1, first {0} nohead lc rgb '#c07060' dashtype 2\n"
        "set label '{1} {0:g}' at graph 1.015, first {0} left textcolor rgb '#b03020' font ',11' noenhanced\n",
        tolerance, name);
  }
  if (worst > 0) script += plot(csv, table, {"", 1, {residual}}, "abs(column({c})) > 1e-16 ? abs(column({c})) : 1e-16", every);
  else script += "plot 1e-16 notitle\n";
  return script + "unset multiplot\n";
}

}  // namespace

std::string unit_of(const std::string& column) {
  for (const Unit& u : units()) {
    const std::string end = std::string("_") + u.suffix;
    if (column.size() > end.size() && column.compare(column.size() - end.size(), end.size(), end) == 0) return u.suffix;
  }
  return "";
}

std::string words_of(const std::string& column) {
  const std::string unit = unit_of(column);
  std::string words = column.substr(0, column.size() - (unit.empty() ? 0 : unit.size() + 1));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::vector<Panel> history_panels(const CsvTable& table, std::vector<std::string>* left_out) {
  Panel ground{"ground [g]", 1 / standard_g, {}};
  std::vector<std::pair<std::string, Panel>> by_unit;
  for (std::size_t c = 1; c < table.names.size(); ++c) {
    const std::string& name = table.names[c];
    const int column = static_cast<int>(c);
    if (name.rfind("ground_a", 0) == 0 && unit_of(name) == "m_s2") {
      if (peak_of(table, {column}) > 0) ground.columns.push_back(column);
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
        if (words.size() > end.size() + 1 && words.compare(words.size() - end.size(), end.size(), end) == 0) axis = a;
    // A quantity without a unit gets an axis of its own.
    const std::string key = unit + "/" + axis + frame + (unit.empty() ? words : "");
    auto known = std::find_if(by_unit.begin(), by_unit.end(), [&](const auto& p) { return p.first == key; });
    if (known == by_unit.end()) {
      const Unit* u = find_unit(unit);
      by_unit.push_back({key, {(u ? u->quantity : words) + (axis.empty() ? "" : " " + axis) + frame, 1, {}, !axis.empty()}});
      known = by_unit.end() - 1;
    }
    known->second.columns.push_back(column);
  }
  std::vector<Panel> panels;
  if (!ground.columns.empty()) panels.push_back(ground);
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
  for (const std::string name : {"histories", "energy"}) {
    const std::string csv = name + ".csv", svg = (dir / (name + ".svg")).string();
    if (!fs::exists(dir / csv)) continue;
    const CsvTable table = read_csv((dir / csv).string());
    if (table.rows() < 2 || table.names.size() < 2 || table.columns[0].back() <= 0) continue;
    run_gnuplot(name == "energy" ? energy_script(csv, table, run) : histories_script(csv, table, run), svg);
    written.push_back(svg);
  }
  return written;
}

}  // namespace erbs::render
