#include "engine/study/sweep/sweep_figure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/record/format/csv.h"
#include "engine/record/plot/figure.h"
#include "engine/record/plot/unit.h"

namespace erbs::study {
namespace {

constexpr std::size_t most_lines = 12;
const char* const colors[] = {"#1f5f8b", "#b5432e", "#2e8b57", "#8a5fa8", "#c08a1e", "#5a5a5a"};

std::size_t column_of(const CsvTable& table, const std::string& name) { return std::size_t(std::max(0, table.find(name))); }

bool any_number(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

// Values of an axis of one numeric param, in rising order; empty for any other axis.
std::vector<double> numbers_of(const Axis& axis) {
  std::vector<double> values;
  for (const auto& row : axis.rows)
    if (row.size() != 1 || !std::holds_alternative<double>(row[0])) return {};
    else values.push_back(std::get<double>(row[0]));
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// From where to where the cell of a value reaches: half way to its neighbours.
std::pair<double, double> cell_of(const std::vector<double>& values, double x) {
  const auto i = std::size_t(std::lower_bound(values.begin(), values.end(), x) - values.begin());
  const double before = i > 0 ? values[i] - values[i - 1] : values[i + 1] - values[i];
  const double after = i + 1 < values.size() ? values[i + 1] - values[i] : before;
  return {x - before / 2, x + after / 2};
}

void add_curves(plot::Figure& figure, plot::Panel& panel, const Plan& plan, bool on_map) {
  int i = 0;
  for (const PlanCurve& curve : plan.curves) {
    std::string rows;
    for (std::size_t k = 0; k < curve.x.size(); ++k) rows += fmt::format("{} {}\n", curve.x[k], curve.y[k]);
    panel.series.push_back({figure.add_rows(rows) + " using 1:2",
                            fmt::format("lines lw 3 dt {} lc rgb '{}'", 1 + i, on_map ? "#111111" : "#777777"), curve.label});
    ++i;
  }
}

// A map over two params: the first along x, the second along y. An answer of yes and no has two colours.
void add_map(plot::Figure& figure, plot::Panel& panel, const Sweep& s, const CsvTable& table, const std::string& answer) {
  const std::vector<double> xs = numbers_of(s.plan.axes[0]), ys = numbers_of(s.plan.axes[1]);
  const auto &x = table.columns[column_of(table, s.params[0])], &y = table.columns[column_of(table, s.params[1])];
  const auto& z = table.columns[column_of(table, answer)];
  const bool binary = std::all_of(z.begin(), z.end(), [](double v) { return !std::isfinite(v) || v == 0 || v == 1; });
  std::map<std::string, std::string> rows;  // by look
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto [x0, x1] = cell_of(xs, x[i]);
    const auto [y0, y1] = cell_of(ys, y[i]);
    const std::string look = !std::isfinite(z[i]) ? "rgb '#9a9a9a'" : !binary ? "palette" : z[i] == 1 ? "rgb '#e2907f'" : "rgb '#cfe3ee'";
    rows[look] += fmt::format("{} {} {} {} {} {} {}\n", x[i], y[i], x0, x1, y0, y1, std::isfinite(z[i]) ? z[i] : 0);
  }
  for (const auto& [look, text] : rows) {
    const std::string title = look == "palette"                ? ""
                              : look.find("9a9a") != look.npos ? "no answer"
                              : look.find("e290") != look.npos ? answer + " = 1"
                                                               : answer + " = 0";
    panel.series.push_back(
        {figure.add_rows(text) + (look == "palette" ? " using 1:2:3:4:5:6:7" : " using 1:2:3:4:5:6"), "boxxyerror lc " + look, title});
  }
  const auto edge = [](const std::vector<double>& v) {
    return fmt::format("[{}:{}]", cell_of(v, v.front()).first, cell_of(v, v.back()).second);
  };
  panel.x = {plot::label_of(s.params[0]), edge(xs), "", "", "noenhanced"};
  panel.y = {plot::label_of(s.params[1]), edge(ys), "", "", "noenhanced"};
  panel.settings = "set style fill solid 1.0 noborder\nset palette defined (0 '#f7fbff', 0.5 '#6baed6', 1 '#08306b')\n";
  if (!binary) panel.settings += "set cblabel \"" + plot::label_of(answer) + "\" noenhanced\n";
  if (!binary) figure.labels.back().text += ": " + plot::label_of(answer);
}

// The param along x: of the longest axis of numbers.
std::size_t param_along_x(const Plan& plan) {
  std::size_t best = 0, most = 0, param = 0;
  for (const Axis& axis : plan.axes) {
    const bool number = !axis.rows.empty() && std::holds_alternative<double>(axis.rows[0][0]);
    if (number && axis.rows.size() > most) most = axis.rows.size(), best = param;
    param += axis.params.size();
  }
  return best;
}

// Lines over one param, one for each choice of the others; points where params change together.
void add_lines(plot::Figure& figure, plot::Panel& panel, const Sweep& s, const CsvTable& table, const std::string& answer) {
  const std::size_t along = param_along_x(s.plan);
  const bool together = std::any_of(s.plan.axes.begin(), s.plan.axes.end(), [](const Axis& axis) { return axis.params.size() > 1; });
  const auto &x = table.columns[column_of(table, s.params[along])], &z = table.columns[column_of(table, answer)];
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::pair<double, double>>> lines;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    std::string name;
    for (std::size_t k = 0; k < s.params.size() && !together; ++k) {
      if (k == along) continue;
      const std::size_t c = column_of(table, s.params[k]);
      name += fmt::format("{}{} {}", name.empty() ? "" : ", ", s.params[k],
                          table.text[c].empty() ? fmt::format("{:.4g}", table.columns[c][i]) : table.text[c][i]);
    }
    if (!lines.contains(name)) order.push_back(name);
    if (std::isfinite(z[i]) && std::isfinite(x[i])) lines[name].emplace_back(x[i], z[i]);
  }
  for (std::size_t i = 0; i < order.size() && i < most_lines; ++i) {
    auto& points = lines[order[i]];
    if (points.empty()) continue;
    std::sort(points.begin(), points.end());
    std::string rows;
    for (const auto& [u, v] : points) rows += fmt::format("{} {}\n", u, v);
    panel.series.push_back(
        {figure.add_rows(rows) + " using 1:2",
         fmt::format("{} lc rgb '{}'", together ? "points pt 7 ps 0.7" : fmt::format("linespoints lw 2 pt 7 ps 0.6 dt {}", 1 + i / 6),
                     colors[i % 6]),
         order[i]});
  }
  panel.x = {plot::label_of(s.params[along]), "", "", "", "noenhanced"};
  panel.y = {plot::label_of(answer), "", "", "", "noenhanced"};
}

}  // namespace

void draw_results(const Sweep& s, const std::string& path) {
  if (s.plan.axes.empty()) return;
  const CsvTable table = read_csv(s.directory + "/" + results_file);
  std::string answer = s.bisected;
  for (const std::string& name : s.collected)
    if (answer.empty() && table.find(name) >= 0 && any_number(table.columns[column_of(table, name)])) answer = name;
  if (answer.empty() || !any_number(table.columns[column_of(table, answer)])) return;
  const bool map =
      s.bisected.empty() && s.plan.axes.size() == 2 && numbers_of(s.plan.axes[0]).size() > 2 && numbers_of(s.plan.axes[1]).size() > 2;
  plot::Figure figure{900, 680};
  figure.grid = map ? "" : "x y";
  figure.labels = {
      {s.plan.title.empty() ? s.scene.substr(s.scene.find_last_of('/') + 1) : s.plan.title, "screen 0.5,0.965", "center font ',16'"}};
  plot::Panel panel;
  panel.cell = {0, 1, 0, 0.94};
  if (map) add_map(figure, panel, s, table, answer);
  else add_lines(figure, panel, s, table, answer);
  add_curves(figure, panel, s.plan, map);
  panel.key = panel.series.size() > 1 || !s.plan.curves.empty() ? "outside bottom center horizontal noenhanced" : "";
  figure.panels = {panel};
  plot::draw(figure, path);
}

}  // namespace erbs::study
