// erbs effects SCENE.lua: the cost of each effect of a scene, and the change of its metrics without it. Each effect is switched off in
// a run of its own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/base/system/interrupt.h"
#include "engine/base/system/process.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/figure.h"
#include "engine/scene/effects.h"
#include "engine/study/pool.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

struct Measured {
  std::string effect, because, trouble;
  double cpu = 0;     // s, of the whole child process
  double memory = 0;  // bytes, peak
  double steps = 0, points = 0;
  std::string status;
  Json metrics = Json::object();  // of the scene
  bool collapsed = false;
};

// One run at a time, so that runs do not compete for processor and memory.
Measured run_without(const std::string& scene, const SceneOptions& options, const std::string& directory, const std::string& effect) {
  std::string name = effect.empty() ? "all" : effect;
  std::replace(name.begin(), name.end(), ' ', '_');
  const std::string folder = directory + "/" + name;
  std::vector<std::string> command{own_path(), "run", scene, "-o", folder, "--force", "--quiet", "--threads", "1", "--no-figures"};
  if (!effect.empty()) command.insert(command.end(), {"--without", effect});
  const std::vector<std::string> more = scene_arguments(options);
  command.insert(command.end(), more.begin(), more.end());
  Measured out;
  out.effect = effect;
  study::Pool pool(1);
  pool.add(0, {command, {.output = folder + ".log", .errors = folder + ".log"}});
  std::optional<study::Finished> ended;
  while (!(ended = pool.wait(1.0)))
    if (is_interrupted()) pool.interrupt_all();
  out.cpu = ended->cpu;
  if (!fs::exists(run_file(folder, "metrics.json"))) {
    out.trouble = last_words(folder + ".log", ended->code, fs::path(scene).filename().string());
    return out;
  }
  const Json metrics = read_json(run_file(folder, "metrics.json"));
  out.memory = metrics["peak_memory_bytes"].get<double>();
  out.steps = metrics["steps"].get<double>();
  out.points = metrics["contact_points"].get<double>();
  out.status = metrics["status"].get<std::string>();
  out.metrics = metrics.value("metrics", Json::object());
  const Json* collapsed = find_key(metrics, "collapse.collapsed");
  out.collapsed = collapsed != nullptr && *collapsed == true;
  return out;
}

// The metric with the largest relative change, and the change.
std::pair<std::string, double> moved(const Measured& all, const Measured& without) {
  if (all.collapsed != without.collapsed) return {all.collapsed ? "stands" : "collapses", 1};
  std::pair<std::string, double> out{"-", 0};
  for (const auto& [name, value] : all.metrics.items()) {
    if (!value.is_number() || !without.metrics.contains(name) || !without.metrics[name].is_number()) continue;
    const double a = value.get<double>(), b = without.metrics[name].get<double>(), scale = std::max(std::fabs(a), std::fabs(b));
    const double change = scale > 0 ? std::fabs(b - a) / scale : 0;
    if (change > out.second) out = {name, change};
  }
  return out;
}

struct Row {
  Measured without;
  double ns, percent;  // per step
  double steps;        // %, of the steps of the run; negative: without the effect the run takes more
  double bytes;
  std::pair<std::string, double> moved;
};

void print_row(const Row& r) {
  if (!r.without.trouble.empty()) {
    say("{:<26} without it: {}\n", r.without.effect, r.without.trouble);
    return;
  }
  say("{:<26} {:9.4f} {:7.1f} {:7.1f} {:9.1f}  {:>10.3g}  {:<28} {}\n", r.without.effect, r.ns, r.percent, r.steps, r.bytes, r.moved.second,
      r.moved.first, r.without.because);
  std::fflush(stdout);
}

void write_table(const std::vector<Row>& rows, const std::string& path) {
  CsvWriter table(path, {"effect", "called_for_by", "ns_per_point_step", "percent", "steps_percent", "bytes_per_point", "moves", "metric"});
  for (const Row& r : rows)
    table.text_row({r.without.effect, r.without.because, fmt::format("{}", r.ns), fmt::format("{}", r.percent), fmt::format("{}", r.steps),
                    fmt::format("{}", r.bytes), fmt::format("{}", r.moved.second), r.moved.first});
  table.flush();
}

void draw(const std::vector<Row>& rows, const std::string& scene, const std::string& path) {
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

}  // namespace

int verb_effects(const TimingCommand& command) {
  if (command.words.size() != 1) throw Error("effects takes one scene; write erbs effects SCENE.lua");
  const std::string path = command.words.front();
  Script script(script_options(command.scene, true));
  const Scene scene = script.load(path, command.scene.overrides);
  const std::string directory = command.output.directory.empty() ? "runs/" + scene.name + "_effects" : command.output.directory;
  if (fs::exists(directory + "/effects.csv") && !command.output.force)
    throw Error(fmt::format("\"{}\" holds an earlier table; overwrite it with --force, or choose another folder with -o DIR", directory));
  fs::create_directories(directory);
  const Measured all = run_without(path, command.scene, directory, "");
  if (!all.trouble.empty()) throw Error(path + ": " + all.trouble);
  const double updates = std::max(1.0, all.points) * all.steps;
  say("{}: {:.3g} s of one core, {:g} steps, {:g} points: {:.4f} ns per point and step, {:.1f} bytes per point\n\n", scene.name, all.cpu,
      all.steps, all.points, 1e9 * all.cpu / updates, all.memory / std::max(1.0, all.points));
  say("{:<26} {:>9} {:>7} {:>7} {:>9}  {:>10}  {:<28} {}\n", "effect", "ns/point", "%", "steps %", "B/point", "moves", "metric",
      "called for by");
  std::vector<Row> rows;
  for (const Effect& effect : effects_of(scene)) {
    if (!effect.on) continue;
    Row row{run_without(path, command.scene, directory, effect.name), 0, 0, 0, 0, {}};
    row.without.because = effect.because;
    // per step: without an effect a run may end earlier or take other steps
    const double each = all.cpu / all.steps, now = row.without.cpu / std::max(1.0, row.without.steps);
    row.ns = 1e9 * (each - now) / std::max(1.0, all.points);
    row.percent = 100 * (each - now) / each;
    row.steps = 100 * (all.steps - row.without.steps) / all.steps;
    row.bytes = (all.memory - row.without.memory) / std::max(1.0, all.points);
    row.moved = moved(all, row.without);
    print_row(row);
    if (row.without.trouble.empty()) rows.push_back(std::move(row));
  }
  write_table(rows, directory + "/effects.csv");
  draw(rows, scene.name, directory + "/effects.svg");
  say("\n{}\n{}\n", directory + "/effects.csv", directory + "/effects.svg");
  return exit_ok;
}

}  // namespace erbs::lua
