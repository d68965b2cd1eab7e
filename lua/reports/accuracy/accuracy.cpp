#include "lua/reports/accuracy/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>

#include "engine/record/folder/manifest.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/scene/scene.h"
#include "lua/reports/accuracy/settings.h"
#include "lua/reports/setting_runs.h"

namespace erbs::lua {
namespace {

constexpr const char* did_not_fit = "not run: the time limit of the study was reached";
constexpr const char* own_updates = "point_updates";
constexpr const char* study_updates = "study_point_updates";

bool ends_with_any(const std::string& text, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(), [&](const char* ending) { return text.ends_with(ending); });
}

// The numeric quantities of the scene: its metrics, the keys of its expectations, and the residual of the energy ledger.
std::vector<study::Goal> quantities_of(const Script& script) {
  const Scene& scene = script.scene();
  std::vector<study::Goal> all;
  for (const auto& [name, unit] : scene.metric_units)
    if (!ends_with_any(name, {"_runs", "_failed"})) all.push_back({"metrics." + name, unit, std::nullopt, 0, 0, ""});
  for (const Expectation& e : scene.expectations) {
    if (e.kind != Expectation::Kind::rel && e.kind != Expectation::Kind::abs) continue;
    auto found = std::find_if(all.begin(), all.end(), [&](const study::Goal& q) { return q.name == e.key; });
    if (found == all.end()) found = all.insert(all.end(), {e.key, "", std::nullopt, 0, 0, ""});
    found->expected = e.value;
  }
  if (all.empty())
    throw Error(
        fmt::format("{} has no number whose error can be measured; add a metric, such as metric(\"drift\", \"m\", function(run) return "
                    "run.peak(\"top_ux_rel_m\") end), or an expectation, such as expect(\"collapse.time_s\", 1.2, {{ rel = 0.01 }})",
                    scene.file));
  all.push_back({"energy.residual_relative", "", 0.0, 0, 0, ""});
  return all;
}

std::size_t main_of(const std::vector<study::Goal>& all, const std::string& asked) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == asked || all[i].name == "metrics." + asked) return i;
  if (!asked.empty()) {
    std::vector<std::string> names;
    for (const study::Goal& q : all) names.push_back(q.name);
    throw Error(fmt::format("--quantity {}: the scene has {}", asked, fmt::join(names, ", ")));
  }
  return 0;
}

// Index of the first quantity that any setting changes; a quantity with an expected value goes before the others.
// The last one, the residual of the energy ledger, is never chosen.
std::size_t telling(const std::vector<study::Goal>& goals, const std::vector<study::Measured>& all) {
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i + 1 < goals.size(); ++i) {
    std::optional<double> first;
    const bool moves = std::any_of(all.begin(), all.end(), [&](const study::Measured& m) {
      if (!m.values[i]) return false;
      if (!first) first = m.values[i];
      return *m.values[i] != *first;
    });
    if (moves) moved.push_back(i);
  }
  for (const std::size_t i : moved)
    if (goals[i].expected && *goals[i].expected != 0) return i;
  return moved.empty() ? 0 : moved.front();
}

// A scene with its settings, before its runs.
struct Asked {
  AccuracyStudy study;
  AccuracyPlan plan;
  std::string identity;          // hashes of all that it reads
  std::vector<std::size_t> row;  // of each setting, in the rows of all runs; equal settings share one
};

Asked ask(const std::string& scene, const AccuracyCommand& command) {
  Script script(script_options(command.scene, true));
  script.load(scene, command.scene.overrides);
  Asked asked;
  AccuracyStudy& study = asked.study;
  study.scene = scene, study.name = script.scene().name, study.title = title_of(whole_text(scene));
  study.command = "erbs run " + scene + " --threads 1";
  for (const auto& [name, value] : command.scene.overrides) study.command += fmt::format(" -D '{}={}'", name, value);
  if (command.scene.allow_unstable) study.command += " --allow-unstable";
  study.quantities = quantities_of(script);
  study.main = main_of(study.quantities, command.quantity);
  asked.plan = plan_of(script, command);
  study.not_applicable = asked.plan.not_applicable;
  for (const auto& [file, hash] : script.scene().inputs) asked.identity += hash + "\n";
  return asked;
}

// The runs of all settings of all scenes.
SettingRuns runs_of(std::vector<Asked>& all, const std::string& directory, const AccuracyCommand& command) {
  SettingRuns runs;
  runs.directory = directory, runs.jobs = command.batch.jobs, runs.quiet = command.output.quiet;
  runs.max_wall = command.batch.max_wall.value_or(command.whole_study ? 900 : 300);
  runs.budget = command.whole_study ? 0 : command.within;
  std::vector<std::string> common = scene_arguments(command.scene);
  if (command.scene.allow_unstable) common.emplace_back("--allow-unstable");
  runs.identity = fmt::format("{}", fmt::join(common, " "));
  runs.keys = {own_updates, study_updates};
  const auto want = [&](const std::string& key) {
    if (!key.empty() && std::find(runs.keys.begin(), runs.keys.end(), key) == runs.keys.end()) runs.keys.push_back(key);
  };
  std::map<std::string, std::size_t> index;  // by scene and words
  for (Asked& asked : all) {
    runs.identity += "\n" + asked.identity;
    for (const study::Goal& q : asked.study.quantities) want(q.name);
    for (const study::Knob& knob : asked.plan.knobs) want(knob.error);
    for (const study::Setting& s : asked.plan.settings) {
      const auto [found, is_new] = index.emplace(fmt::format("{} {}", asked.study.scene, fmt::join(s.words, " ")), runs.settings.size());
      asked.row.push_back(found->second);
      if (!is_new) continue;
      study::Variant how{asked.study.scene, s.words};
      how.arguments.insert(how.arguments.end(), common.begin(), common.end());
      runs.settings.emplace_back(all.size() > 1 ? asked.study.name + ": " + s.name : s.name, std::move(how));
    }
  }
  return runs;
}

std::optional<double> value_at(const SettingRow& row, const std::string& key) {
  const auto found = row.values.find(key);
  return found == row.values.end() || !row.answered() ? std::nullopt : std::optional(found->second);
}

study::Measured measured_of(const SettingRow& row, const study::Setting& setting, const Asked& asked) {
  study::Measured m{setting, std::vector<std::optional<double>>(asked.study.quantities.size()), "", row.cpu, 0};
  m.updates = value_at(row, own_updates).value_or(0) + value_at(row, study_updates).value_or(0);
  if (!row.done) m.reason = did_not_fit;
  else if (!row.answered()) m.reason = row.reason.empty() ? row.status : row.reason;
  if (!m.reason.empty()) return m;
  for (std::size_t i = 0; i < m.values.size(); ++i) m.values[i] = value_at(row, asked.study.quantities[i].name);
  for (const study::Knob& knob : asked.plan.knobs)
    if (!knob.error.empty()) m.scatter = value_at(row, knob.error);
  return m;
}

void settle(Asked& asked, const std::vector<SettingRow>& rows, bool choose_main) {
  AccuracyStudy& study = asked.study;
  for (std::size_t i = 0; i < asked.plan.settings.size(); ++i)
    study.all.push_back(measured_of(rows[asked.row[i]], asked.plan.settings[i], asked));
  for (const study::Measured& m : study.all) study.waiting += m.reason == did_not_fit;
  if (choose_main) study.main = telling(study.quantities, study.all);
  for (const study::Knob& knob : asked.plan.knobs)
    if (!knob.error.empty()) study.quantities[study.main].scatters = true;
  for (std::size_t i = 0; i < study.quantities.size(); ++i) settle_reference(study.quantities[i], i, study.all);
}

}  // namespace

std::optional<double> AccuracyStudy::error(const study::Measured& m) const { return error_of(quantity(), main, m, all); }
std::optional<double> AccuracyStudy::own_error(const study::Measured& m) const { return own_error_of(quantity(), main, m, all); }

AccuracyResult carry_out_accuracy(const std::vector<std::string>& scenes, const std::string& directory, const AccuracyCommand& command) {
  std::vector<Asked> asked;
  for (const std::string& scene : scenes) asked.push_back(ask(scene, command));
  const SettingRuns runs = runs_of(asked, directory, command);
  // A mistake in a scene or an option has been told by now, so that --force loses no earlier results to it.
  prepare_settings_folder(directory, command.batch.resume, command.output.force, {"accuracy.csv", "accuracy.svg", "accuracy.png"});
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<SettingRow> rows = run_settings(runs);
  AccuracyResult result;
  result.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.runs = rows.size();
  for (const SettingRow& row : rows) result.cpu += row.cpu;
  for (Asked& one : asked) {
    settle(one, rows, command.quantity.empty());
    result.studies.push_back(std::move(one.study));
  }
  return result;
}

void write_accuracy_csv(const std::vector<AccuracyStudy>& studies, const std::string& path) {
  CsvWriter table(path, {"problem", "knob", "setting", "quantity", "unit", "value", "reference", "uncertainty", "error", "own_limit",
                         "own_error", "cpu_s", "point_updates", "command", "reason"});
  const auto number = [](const std::optional<double>& value) {
    return value && std::isfinite(*value) ? fmt::format("{}", *value) : std::string("nan");
  };
  for (const AccuracyStudy& study : studies)
    for (const study::Measured& m : study.all)
      for (std::size_t i = 0; i < study.quantities.size(); ++i) {
        const study::Goal& q = study.quantities[i];
        table.text_row({study.name, m.setting.knob, m.setting.name, q.name, q.unit, number(m.values[i]), number(q.reference),
                        number(q.uncertainty), number(error_of(q, i, m, study.all)), number(q.own_limit),
                        number(own_error_of(q, i, m, study.all)), fmt::format("{:.3f}", m.cpu), fmt::format("{:.0f}", m.updates),
                        fmt::format("{} {}", study.command, fmt::join(m.setting.words, " ")), m.reason});
      }
  table.flush();
}

}  // namespace erbs::lua
