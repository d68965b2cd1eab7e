#include "lua/reports/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "engine/base/hash.h"
#include "engine/base/system/process.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/csv.h"
#include "engine/scene/scene.h"
#include "lua/reading/quality.h"
#include "lua/reports/cases.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr const char* did_not_fit = "not run: the time limit of the study was reached";

bool has_setting(const std::string& key) {
  const auto fields = Analysis::fields();
  return std::any_of(fields.begin(), fields.end(), [&](const auto& field) { return field.name == key; });
}

void add_steps(std::vector<study::Setting>& all, double finest) {
  for (double f = finest; f < 1; f = f < 0.5 ? 2 * f : f + 0.4)
    all.push_back({"time step",
                   fmt::format("dt {:g} of the limit", f),
                   fmt::format("analysis {{ dt_fraction = {} }}", f),
                   {"--dt-fraction", fmt::format("{}", f)},
                   f});
}

void add_points(std::vector<study::Setting>& all, bool fine, bool all_rules) {
  for (const char* rule : {"simpson", "midpoint", "trapezoid", "gauss"})
    for (const int side : {13, 9, 7, 5, 3, 2, 1}) {
      const std::string_view name = rule;
      if ((side > 7 && !fine) || (name != "simpson" && !all_rules)) continue;
      if (side == 1 && name != "midpoint") continue;  // the other rules need at least two points
      if (side > 3 && name == "gauss") continue;      // exact in bending from two points on: more points gain nothing
      const int n = side * side;
      all.push_back({fmt::format("points, {}", rule),
                     fmt::format("{} point{}, {}", n, n > 1 ? "s" : "", rule),
                     fmt::format("joint {{ rule = \"{}\", points = {} }}", rule, n),
                     {"--rule", rule, "--points", std::to_string(n)},
                     name == "trapezoid" ? 1.0 / (side - 1) : 1.0 / side});  // the error is a power of this size
    }
}

void add_lazy(std::vector<study::Setting>& all) {
  for (const double angle : {1e-6, 1e-4, 1e-3, 1e-2})
    all.push_back({"lazy rotation",
                   fmt::format("lazy_rotation {:g}", angle),
                   fmt::format("analysis {{ lazy_rotation = {:g} }}", angle),
                   {"--set", fmt::format("lazy_rotation={:g}", angle)},
                   angle});
}

// The solver of Gu and Miao and its repairs. They are here for comparison only; nobody should use them for results.
void add_sequential(std::vector<study::Setting>& all) {
  static const struct {
    const char *name, *variant, *order;
  } kinds[] = {{"literal", "literal", "random"}, {"centred", "centred", "random"}, {"coloured", "literal", "coloured"}};
  for (const auto& kind : kinds)
    for (const int n : {1, 2, 4, 8})
      all.push_back({fmt::format("sequential, {}", kind.name),
                     fmt::format("sequential {}, {} iterations", kind.name, n),
                     fmt::format("analysis {{ solver = \"sequential\", variant = \"{}\", order = \"{}\", iterations = {} }}", kind.variant,
                                 kind.order, n),
                     {"--allow-unstable", "--set", "solver=sequential", "--set", fmt::format("variant={}", kind.variant), "--set",
                      fmt::format("order={}", kind.order), "--set", fmt::format("iterations={}", n)},
                     1.0 / n,
                     false});
}

void add_units(std::vector<study::Setting>& all) {
  for (const double unit : {0.5, 1.0, 2.0})
    all.push_back(
        {"block size", fmt::format("unit {:g}", unit), fmt::format("-D unit={:g}", unit), {"-D", fmt::format("unit={:g}", unit)}, unit});
}

// The settings that each word of `quality` stands for. A setting that the scene fixes itself is left out.
void add_qualities(std::vector<study::Setting>& all, bool steps, bool points) {
  for (const Quality& q : qualities) {
    study::Setting s{study::quality_knob,
                     fmt::format("quality {}", q.name),
                     fmt::format("analysis {{ quality = \"{}\" }}", q.name),
                     {},
                     q.dt_fraction / (q.points * q.points)};
    if (steps) s.words.insert(s.words.end(), {"--dt-fraction", fmt::format("{}", q.dt_fraction)});
    if (points) s.words.insert(s.words.end(), {"--rule", "simpson", "--points", std::to_string(q.points * q.points)});
    all.push_back(std::move(s));
  }
}

struct Plan {
  std::vector<study::Setting> settings;
  std::vector<std::string> not_applicable;
};

Plan plan_of(const Scene& scene) {
  Plan plan;
  plan.settings.push_back({"", "the scene as it is", "", {}, 0});
  const auto labelled = [&](const char* label) { return std::find(scene.labels.begin(), scene.labels.end(), label) != scene.labels.end(); };
  const bool steps = !labelled("fixed_dt"), brief = labelled("quality_only");
  if (!steps) plan.not_applicable.emplace_back("time step: the scene fixes it (label \"fixed_dt\")");
  else add_steps(plan.settings, labelled("coarse_study") ? 1.0 / 8 : labelled("fine_study") ? 1.0 / 512 : 1.0 / 32);
  const bool joints = std::any_of(scene.joint_rules.begin(), scene.joint_rules.end(), [](const JointRule& rule) { return !rule.none; });
  if (joints) {
    add_points(plan.settings, labelled("fine_points"), !brief);
    if (!brief) add_lazy(plan.settings);
  } else {
    plan.not_applicable.emplace_back("points, lazy rotation: the scene has no joints");
  }
  if (steps || joints) add_qualities(plan.settings, steps, joints);
  if (brief) return plan;
  if (has_setting("solver") && joints) add_sequential(plan.settings);
  else plan.not_applicable.emplace_back(joints ? "solver: this program has one" : "solver: the scene has no joints");
  const bool unit = std::any_of(scene.params.begin(), scene.params.end(), [](const Param& p) { return p.name == "unit"; });
  if (unit) add_units(plan.settings);
  else plan.not_applicable.emplace_back("block size: the scene declares no param(\"unit\", 1)");
  return plan;
}

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

std::string file_name(const study::Setting& s) {
  std::string name = s.knob.empty() ? "as_it_is" : s.name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '_';
  return name;
}

// A number of metrics.json; true counts as 1, false as 0.
std::optional<double> value_at(const Json& metrics, const std::string& key) {
  const Json* value = find_key(metrics, key);
  if (value == nullptr) return std::nullopt;
  if (value->is_boolean()) return value->get<bool>() ? 1 : 0;
  if (!value->is_number() || !std::isfinite(value->get<double>())) return std::nullopt;
  return value->get<double>();
}

study::Measured measured_of(const Case& run, const study::Setting& setting, const std::vector<study::Goal>& quantities) {
  study::Measured m{setting, std::vector<std::optional<double>>(quantities.size()), "", run.cpu, 0};
  const CaseResult result = result_of(run);
  m.updates = result.updates;
  const bool bad = run.overdue || (run.code != exit_ok && run.code != exit_expectation);
  if (bad) {
    m.reason = result.trouble;
    return m;
  }
  const Json metrics = read_metrics(run.directory);
  for (std::size_t i = 0; i < quantities.size(); ++i) m.values[i] = value_at(metrics, quantities[i].name);
  return m;
}

Json json_of(const study::Measured& m, const std::string& key) {
  Json values = Json::array();
  for (const auto& value : m.values) values.push_back(value ? Json(*value) : Json());
  return {{"key", key}, {"values", values}, {"reason", m.reason}, {"cpu_s", m.cpu}, {"updates", m.updates}};
}

bool read_note(const std::string& path, const std::string& key, study::Measured& m) {
  try {
    if (!fs::exists(path)) return false;
    const Json note = read_json(path);
    if (note.value("key", "") != key || note.at("values").size() != m.values.size()) return false;
    for (std::size_t i = 0; i < m.values.size(); ++i)
      if (note["values"][i].is_number()) m.values[i] = note["values"][i].get<double>();
    m.reason = note.value("reason", ""), m.cpu = note.value("cpu_s", 0.0), m.updates = note.value("updates", 0.0);
    return true;
  } catch (const std::exception&) { return false; }
}

// Rough cost of a run relative to the scene as it is. Points cost time only in cracked joints; one sweep costs about six steps.
double dearness(const study::Setting& s) {
  if (s.knob.empty()) return 0;  // the unit of this measure
  if (s.knob == "time step") return 0.9 / s.size;
  if (s.knob == "block size") return 1 / s.size;
  if (s.knob == study::quality_knob) return 0.8 / s.size / 9;
  if (s.knob.starts_with("sequential")) return 6 / s.size;
  return s.knob.starts_with("points") ? 0.5 + 1 / (18 * s.size * s.size) : 1;
}

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

AccuracyStudy carry_out_accuracy(const std::string& scene, const std::string& directory, const AccuracyCommand& command) {
  BatchOptions batch = command.batch;
  batch.quiet = command.output.quiet;
  batch.threads = 1;
  if (!batch.max_wall) batch.max_wall = 300;
  batch.budget = command.whole_study ? 0 : command.within;
  Script script(script_options(command.scene, true));
  script.load(scene, command.scene.overrides);
  AccuracyStudy study;
  study.scene = scene, study.directory = directory, study.name = script.scene().name, study.title = title_of(text_of(scene));
  study.command = "erbs run " + scene + " --threads 1";
  for (const auto& [name, value] : command.scene.overrides) study.command += fmt::format(" -D '{}={}'", name, value);
  if (command.scene.allow_unstable) study.command += " --allow-unstable";
  study.quantities = quantities_of(script);
  study.main = main_of(study.quantities, command.quantity);
  Plan plan = plan_of(script.scene());
  study.not_applicable = plan.not_applicable;
  std::stable_sort(plan.settings.begin(), plan.settings.end(),
                   [](const study::Setting& a, const study::Setting& b) { return dearness(a) > dearness(b); });
  std::string key = program_version();
  for (const auto& [file, hash] : script.scene().inputs) key += "\n" + hash;
  for (const auto& [name, value] : command.scene.overrides) key += "\n" + name + "=" + value;
  std::vector<Case> runs;
  std::map<std::string, std::size_t> index;
  for (const study::Setting& s : plan.settings) {
    Case run;
    run.scene = scene, run.name = file_name(s), run.directory = directory + "/runs/" + run.name, run.log = run.directory + ".log",
    run.extra = s.words, run.within_budget = true;
    study::Measured m{s, std::vector<std::optional<double>>(study.quantities.size()), "", 0, 0};
    const bool known = batch.resume && read_note(run.directory + ".json", hash_text(fnv1a(key + run.name)), m);
    if (!known) m.reason = did_not_fit;
    index[run.name] = study.all.size();
    study.all.push_back(std::move(m));
    if (!known) runs.push_back(std::move(run));
  }
  const auto begin = std::chrono::steady_clock::now();
  // With a time limit the cheapest runs go first, so that only expensive runs are left out.
  // Without a limit the most expensive runs go first, so that the processors finish together.
  const auto cost = [&](const Case& run) { return dearness(study.all[index.at(run.name)].setting); };
  if (batch.budget > 0) std::stable_sort(runs.begin(), runs.end(), [&](const Case& a, const Case& b) { return cost(a) < cost(b); });
  const auto time_is_up = [&] {
    return batch.budget > 0 && std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > batch.budget - 1;
  };
  run_cases(runs, command.scene, batch, [&](const Case& run) {
    study::Measured& m = study.all[index.at(run.name)];
    const bool cut = (run.overdue || run.code == exit_stopped) && time_is_up();
    if (cut) return;
    m = measured_of(run, m.setting, study.quantities);
    if (run.overdue || !was_killed(run.code)) write_json(run.directory + ".json", json_of(m, hash_text(fnv1a(key + run.name))));
  });
  study.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const study::Measured& m : study.all) study.cpu += m.cpu, study.waiting += m.reason == did_not_fit;
  if (command.quantity.empty()) study.main = telling(study.quantities, study.all);
  for (std::size_t i = 0; i < study.quantities.size(); ++i) settle_reference(study.quantities[i], i, study.all);
  return study;
}

void write_accuracy_csv(const AccuracyStudy& study, const std::string& path) {
  CsvWriter table(path, {"knob", "setting", "quantity", "unit", "value", "reference", "uncertainty", "error", "cpu_s", "point_updates",
                         "command", "reason"});
  const auto number = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string("nan"); };
  for (const study::Measured& m : study.all)
    for (std::size_t i = 0; i < study.quantities.size(); ++i) {
      const study::Goal& q = study.quantities[i];
      table.text_row({m.setting.knob, m.setting.name, q.name, q.unit, number(m.values[i]), number(q.reference), number(q.uncertainty),
                      number(error_of(q, m.values[i])), fmt::format("{:.3f}", m.cpu), fmt::format("{:.0f}", m.updates),
                      fmt::format("{} {}", study.command, fmt::join(m.setting.words, " ")), m.reason});
    }
  table.flush();
}

}  // namespace erbs::lua
