#include "lua/reports/figures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/record/folder/run_folder.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/figure.h"
#include "engine/record/plot/gnuplot.h"
#include "engine/record/results/metrics.h"
#include "lua/reading/context.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr const char* colours[] = {"#2f6b8f", "#b5432e", "#4d7a3a", "#8a5a9e", "#b8860b", "#5a5a5a"};

std::string numbers_of(const FigureCurve& curve, const std::string& directory) {
  std::vector<std::pair<double, double>> points;
  if (curve.study.empty()) {
    for (size_t i = 0; i < curve.y.size(); ++i) points.emplace_back(curve.x[i], curve.y[i]);
    const Json all = curve.metrics.empty() ? Json() : read_metrics(directory);
    for (size_t i = 0; i < curve.metrics.size(); ++i)
      if (const Json* value = find_key(all, "metrics." + curve.metrics[i]); value != nullptr && value->is_number())
        points.emplace_back(curve.x[i], value->get<double>());
  } else {
    const CsvTable table = read_csv(run_file(directory, "studies/" + curve.study + ".csv"));
    for (size_t i = 0; i < table.rows(); ++i) points.emplace_back(table.columns[0][i], table.columns[1][i]);
    std::sort(points.begin(), points.end());
  }
  std::string text;
  for (const auto& [x, y] : points)
    if (std::isfinite(x) && std::isfinite(y)) text += fmt::format("{:.6g} {:.6g}\n", x, y);
  return text;
}

// The title in the first line of a gnuplot script: a comment that holds it as a JSON string, so that no title can end the line.
std::string title_in(const std::string& script) {
  const Json title = Json::parse(script.substr(2, script.find('\n') - 2), nullptr, false);
  return title.is_string() ? title.get<std::string>() : "";
}

std::string script_for(const Figure& figure, const std::string& directory) {
  plot::Panel panel;
  plot::Figure sheet{860, 420};
  for (size_t i = 0; i < figure.curves.size(); ++i) {
    const FigureCurve& curve = figure.curves[i];
    const std::string numbers = numbers_of(curve, directory);
    if (numbers.empty()) continue;
    panel.series.push_back(
        {sheet.add_rows(numbers) + " using 1:2",
         fmt::format("{} lc rgb '{}'", curve.measured() ? "points pt 7 ps 0.8" : "lines lw 2", colours[i % std::size(colours)]),
         curve.label});
  }
  if (panel.series.empty()) return "";
  panel.key = "below spacing 1.4 noenhanced";
  panel.settings = fmt::format("set title {} noenhanced tc rgb '#111111'\n", gnuplot_quoted(figure.title));
  panel.x.label = figure.x, panel.y.label = figure.y, panel.x.look = panel.y.look = "noenhanced";
  sheet.panels = {panel};
  return fmt::format("# {}\n", Json(figure.title).dump(-1, ' ', false, Json::error_handler_t::replace)) + script_of(sheet);
}

}  // namespace

void write_figures(const Script& script, const std::string& directory, bool draw) {
  for (const Figure& figure : script.figures()) {
    const std::string text = script_for(figure, directory);
    if (text.empty()) continue;
    const std::string stem = run_file(directory, "figures/" + figure.name);
    fs::create_directories(fs::path(stem).parent_path());
    write_text_atomically(stem + ".gnuplot", text);
    if (draw) run_gnuplot(text, stem + ".svg");
  }
}

std::vector<LeftFigure> figures_of(const std::string& directory) {
  std::vector<LeftFigure> found;
  const std::string folder = run_file(directory, "figures");
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".gnuplot") continue;
    const std::string text = whole_text(entry.path());
    found.push_back({entry.path().stem().string(), title_in(text), text});
  }
  std::sort(found.begin(), found.end(), [](const LeftFigure& a, const LeftFigure& b) { return a.name < b.name; });
  return found;
}

}  // namespace erbs::lua
