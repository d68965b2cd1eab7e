#include "lua/reports/setting_runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/hash.h"
#include "engine/base/system/affinity.h"
#include "engine/base/system/interrupt.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/format/csv.h"
#include "engine/study/machine.h"
#include "engine/study/sweep/study_folder.h"
#include "lua/program/sweep_printer.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

std::string in(const std::string& directory, const std::string& file) { return directory + "/" + file; }

study::Sweep sweep_of(const SettingRuns& runs) {
  study::Sweep sweep;
  sweep.directory = runs.directory;
  sweep.plan.keep = "none";
  sweep.plan.collect = sweep.collected = runs.keys;
  sweep.plan.max_wall = runs.max_wall;
  sweep.at_once = runs.jobs > 0 ? runs.jobs : usable_processors();
  sweep.plan.memory = study::machine_memory() / sweep.at_once;
  sweep.budget = runs.budget;
  study::Axis axis;
  axis.params = sweep.params = {study::variant};
  std::string key = program_version() + "\n" + runs.identity;
  for (const auto& [name, how] : runs.settings) {
    axis.rows.push_back({name});
    sweep.variants[name] = how;
    key += fmt::format("\n{} {} {}", name, how.scene, fmt::join(how.arguments, " "));
  }
  ERBS_ASSERT(sweep.variants.size() == runs.settings.size());
  for (const std::string& one : runs.keys) key += "\n" + one;
  sweep.plan.axes = {axis};
  sweep.key = hash_text(key);
  return sweep;
}

// Calls visit(row of the table, its setting) for every row.
template <class F>
void each_row(const CsvTable& table, std::vector<SettingRow>& rows, F&& visit) {
  const std::vector<double>& index = table.column("index");
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (index[i] >= 0 && index[i] < double(rows.size())) visit(i, rows[std::size_t(index[i])]);
}

std::string word(const CsvTable& table, const char* column, std::size_t row) {
  const int found = table.find(column);
  return found < 0 || table.text[std::size_t(found)].empty() ? "" : table.text[std::size_t(found)][row];
}

std::vector<SettingRow> read_rows(const SettingRuns& runs) {
  std::vector<SettingRow> rows(runs.settings.size());
  const CsvTable results = read_csv(in(runs.directory, study::results_file));
  each_row(results, rows, [&](std::size_t i, SettingRow& row) {
    row.done = true;
    row.status = word(results, "status", i), row.reason = word(results, "reason", i);
    for (const std::string& key : runs.keys)
      if (const double value = results.column(key)[i]; std::isfinite(value)) row.values[key] = value;
  });
  const CsvTable made = read_csv(in(runs.directory, study::runs_file));
  each_row(made, rows, [&](std::size_t i, SettingRow& row) {
    row.cpu = made.column("cpu_s")[i], row.wall = made.column("wall_s")[i], row.memory = made.column("peak_memory_bytes")[i];
  });
  return rows;
}

}  // namespace

void prepare_settings_folder(const std::string& directory, bool resume, bool force, const std::vector<std::string>& products) {
  const bool there = fs::exists(directory) && !(fs::is_directory(directory) && fs::is_empty(directory));
  if (there && !force && !resume)
    throw Error(fmt::format("{} exists; write --resume to keep its runs, or --force to make them again", directory));
  if (there && force) {
    if (!study::holds_tables(directory))
      throw Error(fmt::format("\"{}\" holds no results of such runs and is left alone, --force or not; choose another folder with -o DIR",
                              directory));
    study::remove_tables(directory);
    for (const std::string& file : products) fs::remove(in(directory, file));
  }
  fs::create_directories(directory);
}

std::vector<SettingRow> run_settings(const SettingRuns& runs) {
  study::Sweep sweep = sweep_of(runs);
  const std::atomic<bool>& interrupted = catch_interrupts();
  sweep.interrupted = &interrupted;
  SweepPrinter printer(runs.quiet, false);
  sweep.progress = [&](const study::Sweep::Progress& now) { printer.show(now); };
  const study::Swept swept = carry_out(sweep);
  if (swept.interrupted)
    throw Interrupted(fmt::format("interrupted; {} of {} runs are done: continue with --resume", swept.done, swept.points));
  return read_rows(runs);
}

}  // namespace erbs::lua
