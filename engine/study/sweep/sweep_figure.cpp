#include "engine/study/sweep/sweep_figure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/text.h"
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

// What one figure shows: with Plan::split the rows of one value of that param, and the other params.
struct View {
  const Sweep& sweep;
  const CsvTable& table;
  std::vector<std::size_t> rows;
  std::vector<Axis> axes;
  std::vector<std::string> params;  // column names with units
  std::string answer;
};

// A cell as the legend and the name of a file show it.
std::string word_of(const CsvTable& table, std::size_t column, std::size_t row) {
  return table.text[column].empty() ? fmt::format("{:.4g}", table.columns[column][row]) : table.text[column][row];
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
void add_map(plot::Figure& figure, plot::Panel& panel, const View& view) {
  const std::string& answer = view.answer;
  const CsvTable& table = view.table;
  const std::vector<double> xs = numbers_of(view.axes[0]), ys = numbers_of(view.axes[1]);
  const auto &x = table.columns[column_of(table, view.params[0])], &y = table.columns[column_of(table, view.params[1])];
  const auto& z = table.columns[column_of(table, answer)];
  const bool binary = std::all_of(z.begin(), z.end(), [](double v) { return !std::isfinite(v) || v == 0 || v == 1; });
  std::map<std::string, std::string> rows;  // by look
  for (const std::size_t i : view.rows) {
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
  panel.x = {plot::label_of(view.params[0]), edge(xs), "", "", "noenhanced"};
  panel.y = {plot::label_of(view.params[1]), edge(ys), "", "", "noenhanced"};
  panel.settings = "set style fill solid 1.0 noborder\nset palette defined (0 '#f7fbff', 0.5 '#6baed6', 1 '#08306b')\n";
  if (!binary) panel.settings += "set cblabel \"" + plot::label_of(answer) + "\" noenhanced\n";
  if (!binary) figure.labels.back().text += ": " + plot::label_of(answer);
}

// The param along x: of the longest axis of numbers. The seeds of perturbations are no quantity.
std::size_t param_along_x(const std::vector<Axis>& axes) {
  std::size_t best = 0, most = 0, param = 0;
  for (const Axis& axis : axes) {
    const bool number = !axis.rows.empty() && std::holds_alternative<double>(axis.rows[0][0]);
    const std::size_t length = is_perturbation(axis) ? 1 : axis.rows.size();
    if (number && length > most) most = length, best = param;
    param += axis.params.size();
  }
  return best;
}

struct Line {
  std::string name;
  std::vector<std::pair<double, double>> points;
  std::size_t absent = 0;  // rows without an answer
};

// One line for each choice of the params but the one along x. Twins belong to one line.
std::vector<Line> lines_of(const View& view, std::size_t along, bool together) {
  const CsvTable& table = view.table;
  const auto &x = table.columns[column_of(table, view.params[along])], &z = table.columns[column_of(table, view.answer)];
  std::vector<std::size_t> named;
  for (std::size_t k = 0; k < view.params.size() && !together; ++k) {
    const std::size_t column = column_of(table, view.params[k]);
    const auto differs = [&](std::size_t i) { return word_of(table, column, i) != word_of(table, column, view.rows.front()); };
    if (k != along && view.params[k] != perturbation && std::any_of(view.rows.begin(), view.rows.end(), differs)) named.push_back(k);
  }
  std::vector<Line> lines;
  for (const std::size_t i : view.rows) {
    std::string name;
    for (const std::size_t k : named) {
      const std::string unit = plot::unit_name(view.params[k]);
      name += fmt::format("{}{} {}{}{}", name.empty() ? "" : ", ", plot::words_of(view.params[k]),
                          word_of(table, column_of(table, view.params[k]), i), unit.empty() ? "" : " ", unit);
    }
    auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& one) { return one.name == name; });
    if (line == lines.end()) line = lines.insert(lines.end(), {name, {}, 0});
    if (std::isfinite(z[i]) && std::isfinite(x[i])) line->points.emplace_back(x[i], z[i]);
    else ++line->absent;
  }
  for (Line& line : lines) std::sort(line.points.begin(), line.points.end());
  return lines;
}

// The mean over the points of one x each.
std::vector<std::pair<double, double>> means_of(const std::vector<std::pair<double, double>>& points) {
  std::vector<std::pair<double, double>> means;
  for (std::size_t i = 0, j = 0; i < points.size(); i = j) {
    double sum = 0;
    for (j = i; j < points.size() && points[j].first == points[i].first; ++j) sum += points[j].second;
    means.emplace_back(points[i].first, sum / double(j - i));
  }
  return means;
}

std::string rows_of(const std::vector<std::pair<double, double>>& points) {
  std::string rows;
  for (const auto& [u, v] : points) rows += fmt::format("{} {}\n", u, v);
  return rows;
}

// Lines over one param, one for each choice of the others; points where params change together. Of several answers at one x the line shows
// their mean, and points show each.
void add_lines(plot::Figure& figure, plot::Panel& panel, const View& view) {
  const std::size_t along = param_along_x(view.axes);
  const bool together = std::any_of(view.axes.begin(), view.axes.end(), [](const Axis& axis) { return axis.params.size() > 1; });
  const std::vector<Line> lines = lines_of(view, along, together);
  for (std::size_t i = 0; i < lines.size() && i < most_lines; ++i) {
    const Line& line = lines[i];
    const char* const color = colors[i % 6];
    const auto means = means_of(line.points);
    const bool scatter = !together && means.size() < line.points.size();
    std::string title = line.name + (scatter ? (line.name.empty() ? "mean of the runs" : ": mean") : "");
    if (line.absent > 0) panel.key = "on";  // of one line too
    if (line.absent > 0)
      title += fmt::format("{}{} of {} without an answer", title.empty() ? "" : ": ", line.absent, line.absent + line.points.size());
    if (scatter)
      panel.series.push_back({figure.add_rows(rows_of(line.points)) + " using 1:2", fmt::format("points pt 6 ps 0.6 lc rgb '{}'", color),
                              line.name.empty() ? "each run" : ""});
    const std::string how = together ? "points pt 7 ps 0.7" : fmt::format("linespoints lw 2 pt 7 ps 0.6 dt {}", 1 + i / 6);
    panel.series.push_back(
        {line.points.empty() ? "1/0" : figure.add_rows(rows_of(means)) + " using 1:2", fmt::format("{} lc rgb '{}'", how, color), title});
  }
  if (lines.size() > most_lines) {
    panel.series.push_back({"1/0", "points pt 0", fmt::format("and {} more in {}", lines.size() - most_lines, results_file)});
  }
  // What has no answer has its place along x all the same.
  const auto& x = view.table.columns[column_of(view.table, view.params[along])];
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const std::size_t i : view.rows)
    if (std::isfinite(x[i])) low = std::min(low, x[i]), high = std::max(high, x[i]);
  const bool absent = std::ranges::any_of(lines, [](const Line& line) { return line.absent > 0; });
  panel.x = {plot::label_of(view.params[along]), absent && low < high ? fmt::format("[{:.8g}:{:.8g}]", low, high) : "", "", "",
             "noenhanced"};
  // Only yes and no, or shares of twins between them.
  const bool binary = std::all_of(lines.begin(), lines.end(), [](const Line& line) {
    return std::all_of(line.points.begin(), line.points.end(), [](const auto& point) { return point.second == 0 || point.second == 1; });
  });
  panel.y = {plot::label_of(view.answer), binary ? "[-0.05:1.05]" : "", "", "", "noenhanced"};
}

// The legend below the label of the x axis, in as many columns as the sheet holds; the axes leave it room.
void place_legend(plot::Figure& figure, plot::Panel& panel, bool with_scale) {
  constexpr double character = 9, sample = 80, line = 20, labels = 72, title = 46, left = 96;  // px
  constexpr double few = 4;                                                                    // rows that the sheet has room for
  std::size_t entries = 0, longest = 0;
  for (const plot::Series& series : panel.series) entries += !series.title.empty(), longest = std::max(longest, series.title.size());
  if (entries > 1 || !panel.key.empty()) {
    const double width = character * double(longest) + sample;
    const double room = 0.97 * figure.width - left;  // gnuplot makes no more columns than fit below the axes
    const auto columns = std::clamp<std::size_t>(std::size_t(room / width), 1, std::max<std::size_t>(entries, 1));
    const double rows = double((entries + columns - 1) / columns);
    figure.height += line * std::max(0.0, rows - few);
    panel.key = fmt::format("at screen 0.5,{:.4f} center bottom horizontal maxcols {} samplen 3 noenhanced", 8 / figure.height, columns);
    panel.axes = {std::nullopt, with_scale ? 0.86 : 0.97, (labels + line * rows) / figure.height, 1 - title / figure.height};
  } else {
    panel.axes = {std::nullopt, with_scale ? 0.86 : 0.97, labels / figure.height, 1 - title / figure.height};
  }
}

// A map needs two axes of numbers. It is drawn for answers of yes and no, which lines show badly, and where both axes are long.
bool is_map(const View& view, const std::vector<double>& z) {
  if (!view.sweep.bisected.empty() || view.axes.size() != 2 || std::any_of(view.axes.begin(), view.axes.end(), is_perturbation))
    return false;
  const std::size_t least = std::min(numbers_of(view.axes[0]).size(), numbers_of(view.axes[1]).size());
  const bool binary =
      std::all_of(view.rows.begin(), view.rows.end(), [&](std::size_t i) { return !std::isfinite(z[i]) || z[i] == 0 || z[i] == 1; });
  return least >= (binary ? 3U : 5U);
}

void draw_view(const View& view, const std::string& title, const std::string& stem) {
  const Plan& plan = view.sweep.plan;
  const auto& z = view.table.columns[column_of(view.table, view.answer)];
  if (std::none_of(view.rows.begin(), view.rows.end(), [&](std::size_t i) { return std::isfinite(z[i]); })) return;
  const bool map = is_map(view, z);
  plot::Figure figure{900, 680};
  figure.grid = map ? "" : "x y";
  const double wanted = 16 * figure.width / (12 * double(std::max<std::size_t>(1, title.size())));  // px of type that fit the sheet
  figure.labels = {{title, "screen 0.5,0.965", fmt::format("center font ',{:.0f}'", std::clamp(wanted, 9.0, 16.0))}};
  plot::Panel panel;
  if (map) add_map(figure, panel, view);
  else add_lines(figure, panel, view);
  add_curves(figure, panel, plan, map);
  if (!plan.x.empty()) panel.x.label = plan.x;
  if (!plan.y.empty()) panel.y.label = plan.y;
  if (!plan.curves.empty() || map) panel.key = "on";  // one colour of a map says nothing by itself
  place_legend(figure, panel, panel.settings.find("cblabel") != std::string::npos);
  figure.panels = {panel};
  for (const char* format : {".svg", ".png"}) plot::draw(figure, view.sweep.directory + "/" + stem + format);
}

}  // namespace

void draw_results(const Sweep& s) {
  const Plan& plan = s.plan;
  if (plan.axes.empty()) return;
  const CsvTable table = read_csv(s.directory + "/" + results_file);
  std::string answer = s.bisected;
  for (const std::string& name : s.collected)
    if (answer.empty() && table.find(name) >= 0 && any_number(table.columns[column_of(table, name)])) answer = name;
  if (answer.empty() || !any_number(table.columns[column_of(table, answer)])) return;
  const std::string title = plan.title.empty() ? s.scene.substr(s.scene.find_last_of('/') + 1) : plan.title;
  View whole{s, table, {}, plan.axes, s.params, answer};
  for (std::size_t i = 0; i < table.rows(); ++i) whole.rows.push_back(i);
  const std::vector<std::string> varied = varied_params(plan);
  const auto split = std::size_t(std::find(varied.begin(), varied.end(), plan.split) - varied.begin());
  if (plan.split.empty() || split == varied.size() || varied.size() == 1) return draw_view(whole, title, results_stem);
  const std::size_t column = column_of(table, s.params[split]);
  std::vector<std::string> words;  // in the order of the table
  for (const std::size_t i : whole.rows)
    if (const std::string word = word_of(table, column, i); std::find(words.begin(), words.end(), word) == words.end())
      words.push_back(word);
  View part = whole;
  part.params.erase(part.params.begin() + std::ptrdiff_t(split));
  for (Axis& axis : part.axes)
    if (const auto k = std::find(axis.params.begin(), axis.params.end(), plan.split); k != axis.params.end()) {
      for (auto& row : axis.rows) row.erase(row.begin() + (k - axis.params.begin()));
      axis.params.erase(k);
    }
  std::erase_if(part.axes, [](const Axis& axis) { return axis.params.empty(); });
  for (const std::string& word : words) {
    part.rows.clear();
    for (const std::size_t i : whole.rows)
      if (word_of(table, column, i) == word) part.rows.push_back(i);
    draw_view(part, fmt::format("{}: {} {}", title, s.params[split], word),
              file_stem(fmt::format("{}_{}_{}", results_stem, plan.split, word)));
  }
}

}  // namespace erbs::study
