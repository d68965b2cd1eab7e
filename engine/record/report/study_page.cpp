#include "engine/record/report/study_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/unit.h"
#include "engine/record/report/fill.h"
#include "engine/record/report/pack.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

// Files of a folder with this ending, by name; none where there is no folder.
std::vector<fs::path> files_with(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> found;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent))
    if (entry.path().extension() == ending) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::string way_to(const fs::path& target, const std::string& page) {
  std::error_code failed;
  const fs::path way = fs::relative(fs::weakly_canonical(target), fs::weakly_canonical(fs::absolute(page)).parent_path(), failed);
  return failed ? "" : way.generic_string();
}

// The page of a run where it has one, else its folder; "" where the run was not kept.
std::string link_of(const fs::path& run, const std::string& page) {
  if (fs::exists(run / "report.html")) return way_to(run / "report.html", page);
  return fs::is_directory(run) ? way_to(run, page) : "";
}

// "m/s2" reads "m/s²".
std::string with_square(std::string unit) {
  if (const std::size_t at = unit.find("s2"); at != std::string::npos) unit.replace(at, 2, "s²");
  return unit;
}

std::string number_text(double value) { return fmt::format("{:.6g}", value); }

// Columns by name; the first that is there, -1 without one.
int first_of(const CsvTable& table, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    for (std::size_t c = 0; c < table.names.size(); ++c)
      if (table.names[c] == name || table.names[c].starts_with(name + "_")) return static_cast<int>(c);
  return -1;
}

void read_sweep(const fs::path& dir, const std::string& page, ReportedStudy& study) {
  study.kind = "sweep";
  StudyTable table{"Results", read_csv((dir / "results.csv").string()), {}};
  std::vector<std::string> params, collected;
  if (fs::exists(dir / "study.json")) {
    const Json json = read_json((dir / "study.json").string());
    if (const Json* axes = find_key(json, "study.axes"); axes && axes->is_array())
      for (const Json& axis : *axes)
        for (const Json& name : axis.value("params", Json::array())) params.push_back(name.get<std::string>());
    if (const Json* bisected = find_key(json, "study.bisect.param"); bisected && bisected->is_string())
      collected.push_back(bisected->get<std::string>());  // the answer of each point
    if (const Json* keys = find_key(json, "study.collect"); keys && keys->is_array())
      for (const Json& key : *keys) {
        const std::string name = key.get<std::string>();
        collected.push_back(name.substr(name.rfind('.') == std::string::npos ? 0 : name.rfind('.') + 1));
        collected.push_back(name);
      }
    if (json.contains("scene")) {
      study.answers.emplace_back("scene", json["scene"].get<std::string>());
      if (study.title == study.kind) study.title = fs::path(study.answers.back().second).stem().string();  // else it would stand twice
    }
    if (const std::string title = json.value("title", ""); !title.empty()) study.title = title;
  }
  const CsvTable& rows = table.table;
  const int first = params.empty() ? -1 : first_of(rows, {params[0]}), second = params.size() < 2 ? -1 : first_of(rows, {params[1]});
  const int answer = first_of(rows, collected);
  table.x = std::max(first, 0), table.y = second >= 0 ? second : std::max(answer, 0), table.colour = second >= 0 ? answer : -1;
  const int status = rows.find("status"), index = rows.find("index");
  std::size_t done = 0;
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    if (status >= 0 && !rows.text[static_cast<std::size_t>(status)].empty() &&
        rows.text[static_cast<std::size_t>(status)][row] == "completed")
      ++done;
    const double place = index >= 0 ? rows.columns[static_cast<std::size_t>(index)][row] : static_cast<double>(row);
    table.links.push_back(link_of(dir / "runs" / fmt::format("{:06.0f}", place), page));
  }
  study.answers.emplace_back("points", fmt::format("{}, {} completed", rows.rows(), done));
  if (answer >= 0) {
    std::vector<double> values;
    for (const double v : rows.columns[static_cast<std::size_t>(answer)])
      if (std::isfinite(v)) values.push_back(v);
    if (!values.empty()) {
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      study.answers.emplace_back(plot::label_of(rows.names[static_cast<std::size_t>(answer)]),
                                 fmt::format("{} to {}", number_text(*low), number_text(*high)));
    }
  }
  study.tables.push_back(std::move(table));
}

void read_accuracy(const fs::path& dir, ReportedStudy& study) {
  study.kind = "cost of accuracy";
  StudyTable table{"Errors over cost", read_csv((dir / "accuracy.csv").string()), {}};
  const CsvTable& rows = table.table;
  table.x = std::max(0, first_of(rows, {"cpu_s", "point_updates"})), table.y = std::max(0, rows.find("error")),
  table.colour = rows.find("knob");
  table.logarithmic = true;
  table.links.assign(rows.rows(), "");
  table.only = rows.find("quantity");
  const auto texts = [&](int column) { return column < 0 ? std::vector<std::string>{} : rows.text[static_cast<std::size_t>(column)]; };
  const std::vector<std::string> quantities = texts(table.only), problems = texts(rows.find("problem"));
  if (!problems.empty() && std::ranges::count(problems, problems.front()) == std::ssize(problems)) study.title = problems.front();
  if (quantities.empty()) study.answers.emplace_back("rows", fmt::format("{}", rows.rows()));
  else {
    study.answers.emplace_back("first quantity", quantities.front());
    study.answers.emplace_back("quantities", fmt::format("{}", std::set(quantities.begin(), quantities.end()).size()));
    study.answers.emplace_back("settings", fmt::format("{}", std::ranges::count(quantities, quantities.front())));
  }
  study.tables.push_back(std::move(table));
}

// What a metric of a study of a scene is, and whether it is a value of the param. `ending`: what follows the name of the study.
std::pair<std::string, bool> metric_words(const std::string& ending, bool of_convergence) {
  const std::map<std::string, std::pair<std::string, bool>> words{{"", {"middle of the bracket", true}},
                                                                  {"_lo", {"lower end of the bracket", true}},
                                                                  {"_hi", {"upper end of the bracket", true}},
                                                                  {"_slope", {"order of convergence", false}},
                                                                  {"_mean", {"mean answer", false}},
                                                                  {"_deviation", {"standard deviation", false}},
                                                                  {"_median", {"median answer", false}},
                                                                  {"_least", {"least answer", false}},
                                                                  {"_most", {"largest answer", false}},
                                                                  {"_runs", {"runs", false}},
                                                                  {"_failed", {"runs without an answer", false}}};
  if (ending == "_error") return {of_convergence ? "error of the finest" : "standard error of the mean", false};
  const auto found = words.find(ending);
  return found == words.end() ? std::pair<std::string, bool>{ending.substr(1), false} : found->second;
}

void read_scene_studies(const fs::path& dir, const std::string& page, ReportedStudy& study) {
  study.kind = "studies of a scene";
  const Manifest manifest = read_manifest(dir.string());
  study.title = manifest.title.empty() ? manifest.scene_name : manifest.title;
  const Json metrics = fs::exists(dir / "metrics.json") ? read_json((dir / "metrics.json").string()) : Json::object();
  for (const fs::path& file : files_with(dir / "studies", ".csv")) {
    const std::string name = file.stem().string();
    StudyTable table{name, read_csv(file.string()), {}};
    const CsvTable& rows = table.table;
    table.x = 0, table.y = std::max(0, rows.find("answer"));
    const auto param = std::ranges::find(manifest.params, rows.names.front(), &Param::name);
    table.first_unit = param == manifest.params.end() ? "" : with_square(param->unit);
    if (const int run = rows.find("run"); run >= 0)
      for (const std::string& place : rows.text[static_cast<std::size_t>(run)])
        table.links.push_back(link_of(dir / "studies" / name / place, page));
    if (const Json* all = find_key(metrics, "metrics"); all && all->is_object())
      for (const auto& [key, value] : all->items()) {
        if ((key != name && !key.starts_with(name + "_")) || !value.is_number()) continue;
        const auto [what, of_param] = metric_words(key.substr(name.size()), all->contains(name + "_slope"));
        study.answers.emplace_back(
            name + ": " + what, number_text(value.get<double>()) + (of_param && !table.first_unit.empty() ? " " + table.first_unit : ""));
      }
    study.tables.push_back(std::move(table));
  }
}

Json table_json(const StudyTable& table) {
  const CsvTable& csv = table.table;
  Json rows = Json::array(), labels = Json::array(), links = Json::array();
  // The hash of the study in its last column tells a reader nothing.
  const std::size_t columns = csv.names.size() - (!csv.names.empty() && csv.names.back() == "study" ? 1 : 0);
  for (const std::string& name : csv.names) labels.push_back(for_files(plot::label_of(name)));
  if (!labels.empty() && !table.first_unit.empty() && plot::unit_of(csv.names.front()).empty())
    labels.front() = for_files(plot::label_of(csv.names.front()) + " [" + table.first_unit + "]");
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    Json cells = Json::array();
    for (std::size_t c = 0; c < columns; ++c) {
      if (!csv.text[c].empty()) cells.push_back(for_files(csv.text[c][row]));
      else cells.push_back(std::isfinite(csv.columns[c][row]) ? Json(csv.columns[c][row]) : Json(nullptr));
    }
    rows.push_back(cells);
    links.push_back(row < table.links.size() && !table.links[row].empty() ? Json(for_files(table.links[row])) : Json(nullptr));
  }
  labels.erase(labels.begin() + static_cast<std::ptrdiff_t>(columns), labels.end());
  return {{"name", for_files(table.name)},
          {"columns", std::vector<std::string>(csv.names.begin(), csv.names.begin() + static_cast<std::ptrdiff_t>(columns))},
          {"labels", labels},
          {"rows", rows},
          {"links", links},
          {"x", table.x},
          {"y", table.y},
          {"colour", table.colour},
          {"only", table.only},
          {"log", table.logarithmic}};
}

}  // namespace

bool is_study_folder(const std::string& dir) {
  const fs::path folder(dir);
  return fs::exists(folder / "results.csv") || fs::exists(folder / "accuracy.csv") || !files_with(folder / "studies", ".csv").empty();
}

std::string study_page_path(const std::string& dir) {
  const fs::path folder(dir);
  const bool of_scene = !fs::exists(folder / "results.csv") && !fs::exists(folder / "accuracy.csv");
  return (of_scene ? folder / "studies/report.html" : folder / "report.html").string();
}

ReportedStudy read_reported_study(const std::string& dir, const std::string& page) {
  ReportedStudy study;
  const fs::path folder(dir);
  if (!is_study_folder(dir))
    throw Error("it holds no study; name the folder of erbs sweep, of erbs accuracy, or of a run with studies", {dir, 0});
  study.title = fs::canonical(folder).filename().string();
  if (fs::exists(folder / "accuracy.csv")) read_accuracy(folder, study);  // its runs are those of a sweep, in results.csv
  else if (fs::exists(folder / "results.csv")) read_sweep(folder, page, study);
  else read_scene_studies(folder, page, study);
  const bool of_scene = study.kind == "studies of a scene";
  for (const fs::path& file : files_with(of_scene ? folder / "studies" : folder, ".svg"))
    study.figures.push_back({file.filename().string(), whole_text(file)});
  for (const char* name : {"results.csv", "runs.csv", "study.json", "accuracy.csv", "manifest.json", "metrics.json", "report.html"})
    if (fs::exists(folder / name) && fs::weakly_canonical(folder / name) != fs::weakly_canonical(page))
      study.files.push_back(way_to(folder / name, page));
  for (const fs::path& file : files_with(folder / "studies", ".csv")) study.files.push_back(way_to(file, page));
  return study;
}

std::string study_html(const ReportedStudy& study, std::string_view html, std::string_view style) {
  std::string cards, figures, files;
  for (const auto& [what, value] : study.answers)
    cards += fmt::format("<div class=\"card\"><span class=\"quiet\">{}</span><strong>{}</strong></div>\n", safe_html(for_files(what)),
                         safe_html(for_files(value)));
  for (const StudyFigure& figure : study.figures)
    figures += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\"><figcaption class=\"quiet\">{0}</figcaption></figure>\n",
        safe_html(for_files(figure.name)), base64(figure.svg));
  for (const std::string& file : study.files)
    files += fmt::format("{}<a href=\"{}\">{}</a>", files.empty() ? "" : ", ", safe_html(for_files(file)), safe_html(for_files(file)));
  if (!files.empty()) files = "<h2>Files</h2>\n<p>" + files + "</p>\n";
  Json tables = Json::array();
  for (const StudyTable& table : study.tables) tables.push_back(table_json(table));
  return filled(html, {{"title", safe_html(for_files(study.title))},
                       {"style", std::string(style)},
                       {"kind", safe_html(study.kind)},
                       {"cards", cards},
                       {"figures", figures},
                       {"files", files},
                       {"study", safe_json({{"tables", tables}})}});
}

}  // namespace erbs
