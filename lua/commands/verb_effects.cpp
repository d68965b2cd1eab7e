// erbs effects SCENE.lua: the cost of each effect of a scene, and the change of its metrics without it. Each effect is switched off in
// a run of its own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "engine/record/format/csv.h"
#include "engine/record/plot/figure.h"
#include "engine/scene/effects.h"
#include "lua/program/options.h"
#include "lua/program/say.h"
#include "lua/reports/setting_runs.h"

namespace erbs::lua {
namespace {

constexpr const char *steps = "steps", *points = "contact_points", *memory = "peak_memory_bytes", *collapse_key = "collapse.collapsed";

struct Measured {
  std::string effect, because, trouble;
  bool inaccurate = false;
  double cpu = 0;     // s, of the whole child process
  double memory = 0;  // bytes, peak
  double steps = 0, points = 0;
  std::map<std::string, double> metrics;  // of the scene
  bool collapsed = false;
};

Measured measured_of(const SettingRow& row, const std::string& effect, const std::string& because) {
  Measured m;
  m.effect = effect, m.because = because, m.cpu = row.cpu;
  m.inaccurate = row.status == "inaccurate";
  if (!row.answered() && !m.inaccurate) m.trouble = row.status == "error" ? row.reason : row.status + ": " + row.reason;
  const auto at = [&](const char* key) { return row.values.contains(key) ? row.values.at(key) : 0; };
  m.steps = at(steps), m.points = at(points), m.memory = at(memory), m.collapsed = at(collapse_key) != 0;
  for (const auto& [key, value] : row.values)
    if (key.starts_with("metrics.")) m.metrics[key.substr(8)] = value;
  return m;
}

// The scene as it is, without each of its effects, and as it is once more, which shows how much times scatter. One run at a time unless the
// user wants more, so that runs do not compete for processor and memory.
SettingRuns runs_of(const Script& script, const std::vector<Effect>& effects, const std::string& path, const std::string& directory,
                    const EffectsCommand& command) {
  SettingRuns runs;
  runs.directory = directory, runs.jobs = std::max(1, command.batch.jobs), runs.quiet = command.output.quiet;
  runs.max_wall = command.batch.max_wall.value_or(0);
  for (const auto& [file, hash] : script.scene().inputs) runs.identity += hash + "\n";
  runs.keys = {steps, points, memory, collapse_key};
  for (const auto& [name, unit] : script.scene().metric_units) runs.keys.push_back("metrics." + name);
  std::vector<std::string> common = scene_arguments(command.scene);
  if (command.scene.allow_unstable) common.emplace_back("--allow-unstable");
  runs.settings.push_back({"all", {path, common}});
  for (const Effect& effect : effects) {
    study::Variant how{path, {"--without", effect.name}};
    how.arguments.insert(how.arguments.end(), common.begin(), common.end());
    runs.settings.emplace_back("without " + effect.name, std::move(how));
  }
  runs.settings.push_back({"all again", {path, common}});
  return runs;
}

// A cause without the words for its program: "diverged: exit code 1: wall.lua: the run diverged at ...; take ..." ends before its remedy,
// which is that of a run and not that of a comparison.
std::string cause_of(const Measured& m, const std::string& path) {
  const std::string& whole = m.trouble;
  const std::size_t named = whole.rfind(path + ": ");
  const std::string cause = named == std::string::npos ? whole : whole.substr(named + path.size() + 2);
  return cause.substr(0, std::min(cause.find(';'), cause.find(" (dt")));
}

// The metric with the largest relative change, and the change.
std::pair<std::string, double> moved(const Measured& all, const Measured& without) {
  if (all.collapsed != without.collapsed) return {all.collapsed ? "stands" : "collapses", 1};
  std::pair<std::string, double> out{"-", 0};
  for (const auto& [name, a] : all.metrics) {
    const auto other = without.metrics.find(name);
    if (other == without.metrics.end()) continue;
    const double b = other->second, scale = std::max(std::fabs(a), std::fabs(b));
    const double change = scale > 0 ? std::fabs(b - a) / scale : 0;
    if (change > out.second) out = {name, change};
  }
  return out;
}

struct EffectRow {
  Measured without;
  double ns, percent;  // per step
  double steps;        // %, of the steps of the run; negative: without the effect the run takes more
  double bytes;
  std::pair<std::string, double> moved;
};

// What two equal runs of the scene leave in doubt.
struct Noise {
  double differ = 0, percent = 0;  // %, of processor time: of the two runs; below which a cost of a step is in doubt
  double memory = 0;               // bytes, likewise
};

Noise noise_of(const Measured& all, const Measured& again) {
  constexpr double least = 2, least_memory = 0.01;  // % of time, share of memory: even if two runs agree by chance
  Noise out{0, 2 * least, 2 * least_memory * all.memory};
  if (!again.trouble.empty()) return out;
  out.differ = 100 * std::fabs(again.cpu - all.cpu) / all.cpu;
  out.percent = std::max(out.percent, 2 * out.differ);
  out.memory = std::max(out.memory, 2 * std::fabs(again.memory - all.memory));
  return out;
}

void print_rows(const std::vector<EffectRow>& rows, const Noise& noise, const Measured& all, const std::string& path) {
  say("{:<26} {:>9} {:>7} {:>7} {:>8}  {:>8}  {:<28} {}\n", "effect", "ns/point", "%", "steps %", "B/point", "moves %", "metric",
      "called for by");
  for (const EffectRow& r : rows) {
    if (!r.without.trouble.empty()) {
      say("{:<26} without it: {}\n", r.without.effect, cause_of(r.without, path));
      continue;
    }
    const bool costs = std::fabs(r.percent) >= noise.percent;
    const bool fills = std::fabs(r.bytes) * std::max(1.0, all.points) >= noise.memory;
    say("{:<26} {:>9} {:>7} {:>7} {:>8}  {:>8}  {:<28} {}{}\n", r.without.effect, costs ? fmt::format("{:.3g}", r.ns) : "noise",
        costs ? fmt::format("{:.0f}", r.percent) : "", fmt::format("{:.0f}", r.steps + 0.0), fills ? fmt::format("{:.0f}", r.bytes) : "-",
        fmt::format("{:.3g}", 100 * r.moved.second), r.moved.first, r.without.because,
        r.without.inaccurate ? "  (inaccurate without it)" : "");
  }
}

void write_table(const std::vector<EffectRow>& rows, const std::string& path) {
  CsvWriter table(path, {"effect", "called_for_by", "ns_per_point_step", "percent", "steps_percent", "bytes_per_point", "moves_percent",
                         "metric", "reason"});
  for (const EffectRow& r : rows)
    table.text_row({r.without.effect, r.without.because, fmt::format("{}", r.ns), fmt::format("{}", r.percent), fmt::format("{}", r.steps),
                    fmt::format("{}", r.bytes), fmt::format("{}", 100 * r.moved.second), r.moved.first,
                    r.without.inaccurate ? "inaccurate" : r.without.trouble});
  table.flush();
}

void draw(const std::vector<EffectRow>& rows, const std::string& scene, const std::string& path) {
  std::string text;
  for (size_t i = 0; i < rows.size(); ++i)
    text += fmt::format("{} \"{}\" {:.6g} {:.6g}\n", i, rows[i].without.effect, rows[i].percent, std::max(1e-6, rows[i].moved.second));
  const double height = 140 + 34 * double(rows.size());
  plot::Figure figure{1100, height};
  figure.grid = "x";
  figure.labels = {{"What the effects of " + scene + " cost and change", fmt::format("screen 0.5,{:.5f}", 1 - 20 / height), "center"}};
  const std::string data = figure.add_rows(text);
  plot::Panel cost, change;
  cost.axes = {0.215, 0.475, 69 / height, 1 - 39 / height};
  change.axes = {0.533, 0.975, 69 / height, 1 - 39 / height};
  cost.x.label = "cost: share of the run (%)";
  change.x = {"largest relative change of a metric without it", "[1e-6:2]", "", "10^{%T}", "", true};
  cost.y = change.y = {"", fmt::format("[-0.6:{}] reverse", double(rows.size()) - 0.4), "noenhanced"};
  change.y.format = "none";
  cost.settings = change.settings = "set style fill solid 1.0 noborder\n";
  cost.series = {{data + " using (0.5*$3):0:(0.5*abs($3)):(0.35):ytic(2)", "boxxyerror lc rgb '#2f6b8f'"}};
  change.series = {{data + " using (sqrt(1e-6*$4)):0:(1e-6):4:($0-0.35):($0+0.35)", "boxxyerror lc rgb '#b5432e'"}};
  figure.panels = {cost, change};
  plot::draw(figure, path);
}

void print_legend(const std::vector<EffectRow>& rows, const Noise& noise, const Measured& all) {
  const auto within =
      std::ranges::count_if(rows, [&](const EffectRow& r) { return r.without.trouble.empty() && std::fabs(r.percent) < noise.percent; });
  say("\n%: of a step; below zero, the rest of a step costs more without the effect. steps %: of the run's steps; below zero, more steps "
      "without it\nmoves: change of the metric that changes most, in % of its larger value; from 100 on, it changes its sign, or the "
      "verdict changes\ntwo equal runs of {:.2g} s differ by {:.1f} % in their time, so that costs below {:.0f} % are noise: {} of {} "
      "effects{}\n",
      all.cpu, noise.differ, noise.percent, within, rows.size(), within > 0 && all.cpu < 10 ? "; a longer run tells them apart" : "");
}

}  // namespace

int verb_effects(const EffectsCommand& command) {
  if (command.words.size() != 1) throw Error("effects takes one scene; write erbs effects SCENE.lua");
  const std::string path = command.words.front();
  Script script(script_options(command.scene, true));
  const Scene scene = script.load(path, command.scene.overrides);
  const std::string directory = command.output.directory.empty() ? "runs/" + scene.name + "_effects" : command.output.directory;
  std::vector<Effect> effects = effects_of(scene);
  std::erase_if(effects, [](const Effect& effect) { return !effect.on; });
  prepare_settings_folder(directory, command.batch.resume, command.output.force, {"effects.csv", "effects.svg"});
  const std::vector<SettingRow> made = run_settings(runs_of(script, effects, path, directory, command));
  const Measured all = measured_of(made.front(), "", "");
  if (!all.trouble.empty()) throw Error(path + ": " + all.trouble);
  if (all.inaccurate)
    tell(stderr, fmt::format("warning: {}: the run of the whole scene is inaccurate: {}; its changes are not to be relied on", path,
                             made.front().reason));
  const double updates = std::max(1.0, all.points) * all.steps;
  say("{}: {:.3g} s of one core, {:.0f} steps, {:.0f} points: {:.3g} ns per point and step, {:.3g} MB\n\n", scene.name, all.cpu, all.steps,
      all.points, 1e9 * all.cpu / updates, 1e-6 * all.memory);
  std::vector<EffectRow> rows;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    EffectRow row{measured_of(made[i + 1], effects[i].name, effects[i].because), NAN, NAN, NAN, NAN, {"-", NAN}};
    if (row.without.trouble.empty()) {
      // per step: without an effect a run may end earlier or take other steps
      const double each = all.cpu / all.steps, now = row.without.cpu / std::max(1.0, row.without.steps);
      row.ns = 1e9 * (each - now) / std::max(1.0, all.points);
      row.percent = 100 * (each - now) / each;
      row.steps = 100 * (all.steps - row.without.steps) / all.steps;
      row.bytes = (all.memory - row.without.memory) / std::max(1.0, all.points);
      row.moved = moved(all, row.without);
    }
    rows.push_back(std::move(row));
  }
  const Noise noise = noise_of(all, measured_of(made.back(), "", ""));
  print_rows(rows, noise, all, path);
  print_legend(rows, noise, all);
  write_table(rows, directory + "/effects.csv");
  std::erase_if(rows, [](const EffectRow& row) { return !row.without.trouble.empty(); });
  draw(rows, scene.name, directory + "/effects.svg");
  say("\n{}\n{}\n", directory + "/effects.csv", directory + "/effects.svg");
  return exit_ok;
}

}  // namespace erbs::lua
