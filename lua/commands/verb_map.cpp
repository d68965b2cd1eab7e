// erbs accuracy SCENE.lua --map: which time steps, stiffnesses and dampings let a scene converge. This is the parameter study of Gu and
// Miao for any structure. All runs first simulate the beginning of the window; the bounded ones continue from their checkpoints.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/analysis/start/prepare.h"
#include "engine/base/hash.h"
#include "engine/base/system/process.h"
#include "engine/base/units.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/folder/run_folder.h"
#include "engine/solve/sequential/sweep_feed.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"
#include "lua/reports/cases.h"
#include "lua/reports/stability_map.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;
using RunVerdict = study::MapRun::Verdict;

// Shares of the window that the runs reach one after the other. Runs that diverge do so early. If the time runs out, every run has at
// least been tried.
constexpr double shares[] = {0.001, 0.005, 0.05, 0.25, 1};
// A sweep is judged to generate its own motion in two cases: its ledger lacks half of the energy that passed through, or joints and
// contacts have lost a thousand times the energy of the structure and its loads. The second criterion is needed because beyond a limit
// joints may crack and rub so much that the ledger looks better again.
constexpr double wrong_ledger = 0.5, too_much_lost = 1000;

// Displacements relative to the ground take precedence, because Fig. 6 of Gu and Miao shows them.
void choose_quantity(MapStudy& study, const Scene& scene, const std::string& asked) {
  if (scene.metric_units.empty())
    throw Error(
        fmt::format("{} has no metric to compare runs by; add one, such as metric(\"drift\", \"m\", function(run) return "
                    "run.peak(\"top_ux_rel_m\") end)",
                    scene.file));
  const auto& all = scene.metric_units;
  auto found = std::find_if(all.begin(), all.end(), [&](const auto& m) {
    return asked.empty() ? m.second == "m" && m.first.find("abs") == std::string::npos : m.first == asked || "metrics." + m.first == asked;
  });
  if (found == all.end() && !asked.empty()) {
    std::vector<std::string> names;
    for (const auto& [name, unit] : all) names.push_back(name);
    throw Error(fmt::format("--quantity {}: the scene has {}", asked, fmt::join(names, ", ")));
  }
  if (found == all.end()) found = all.begin();
  study.quantity = found->first, study.unit = found->second;
}

// The window is centred at the peak of the ground acceleration.
void choose_window(MapStudy& study, const Scene& scene, double asked) {
  const double length = scene.analysis.duration;
  study.window = std::min(asked > 0 ? asked : 2.0, length);
  double peak = 0, at = 0;
  constexpr int samples = 200000;
  for (int i = 0; i <= samples; ++i) {
    const double t = length * i / samples;
    Vec3 a = Vec3::Zero();
    for (const Load& load : scene.loads)
      if (load.kind == Load::Kind::ground) a += value(load.wave, t) * load.direction;
    if (a.norm() > peak) peak = a.norm(), at = t;
  }
  study.from = std::clamp(at - 0.5 * study.window, 0.0, length - study.window);
}

// The step rules of Gu and Miao, at the stiffness of the scene.
void choose_steps(MapStudy& study, const Scene& scene) {
  Scene free = scene;
  free.analysis.solver = "leapfrog";
  const analysis::Prepared p = analysis::prepare(free, true);
  if (!std::isfinite(p.bounds.critical))
    throw Error(fmt::format("{} has no joints: nothing in it is elastic, and no time step is too long", scene.file));
  study.nominal = {p.bounds.critical, std::sqrt(2.0) * p.bounds.block, sweep_feed(p.model, p.state)};
  study.critical_damping = 2 * 2 * pi / p.bounds.element_period;
  for (const Load& load : scene.loads)
    if (const auto* record = std::get_if<Record>(&load.wave); record != nullptr && record->file_dt > 0 && load.kind == Load::Kind::ground) {
      study.steps.emplace_back("record's step / 10 000", record->file_dt * record->time_factor / 10000);
      break;
    }
  study.steps.emplace_back("T / 10, eq. (3)", p.bounds.element_period / 10);
  study.steps.emplace_back("0.9 of 2 / omega_max", 0.9 * p.bounds.critical);
  study.steps.emplace_back("0.9 of 2 / max omega_i, eq. (4)", 0.9 * p.bounds.element_period / pi);
  study.steps.emplace_back("D / 2 v_p, half of eq. (5)", 0.5 * p.bounds.wave_passage);
  study.steps.emplace_back("T, eq. (2)", p.bounds.element_period);
  study.steps.emplace_back("D / v_p, eq. (5)", p.bounds.wave_passage);
  std::stable_sort(study.steps.begin(), study.steps.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
}

// The scene's own damping, then half decades: from the damping that balances the feed of the sweep at the shortest step up to 2 / dt,
// which is too much for that step.
void choose_dampings(MapStudy& study, const Scene& scene) {
  const double shortest = study.steps.front().second;
  study.dampings.push_back(scene.damping.mass);
  double c = std::pow(10, std::floor(std::log10(std::max(1.0, 0.5 * shortest * study.nominal.feed))));
  for (int i = 0; i < 16; ++i) {
    if (c > scene.damping.mass) study.dampings.push_back(c);
    if (c >= 2 / shortest) break;
    c *= i % 2 == 0 ? 3 : 10.0 / 3;
  }
}

// Sort key of the runs: the stiffness of the scene first, short runs first. A sequential step costs about 6 leapfrog steps (768 blocks,
// one thread).
double work(const study::MapRun& r) { return (r.factor == 1 ? 1e-6 : 1) * (r.scheme.sequential ? 6 : 1) / r.dt; }

std::string stem(const study::MapRun& r) {
  return fmt::format("{}{}_k{:g}_dt{:.4g}_c{:.4g}", r.scheme.sequential ? "sequential" : "leapfrog",
                     r.scheme.explicit_damping ? "_explicit" : "", r.factor, r.dt, r.damping);
}

std::vector<study::MapRun> plan(const MapStudy& study) {
  std::vector<study::MapRun> all;
  for (const double factor : study.factors)
    for (const study::Scheme scheme : {study::Scheme{false, false}, study::Scheme{true, false}, study::Scheme{true, true}})
      for (const auto& [step, dt] : study.steps)
        for (std::size_t i = 0; i < study.dampings.size(); i += scheme.sequential ? 1 : 2) {  // leapfrog's limit does not depend on damping
          const double c = study.dampings[i];
          study::MapRun r;
          r.scheme = scheme, r.factor = factor, r.step = step, r.dt = dt, r.damping = c;
          const auto set = [&](const std::string& text) { r.words.insert(r.words.end(), {"--set", text}); };
          set(fmt::format("dt={}", dt));
          set(fmt::format("solver={}", scheme.sequential ? "sequential" : "leapfrog"));
          set(fmt::format("duration={}", study.window));
          set("frame_dt=1e6");
          r.words.insert(r.words.end(),
                         {"--from", fmt::format("{}", study.from), "--stiffness", fmt::format("{}", factor), "--damping",
                          fmt::format("{}", c), "--damping-form", scheme.explicit_damping ? "explicit" : "centred", "--allow-unstable"});
          all.push_back(std::move(r));
        }
  return all;
}

// True if joints and contacts have lost far more energy than the structure ever had.
bool own_doing(const Json& metrics) {
  const auto joules = [&](std::initializer_list<const char*> terms) {
    double sum = 0;
    for (const char* term : terms)
      if (const Json* found = find_key(metrics, std::string("energy.") + term); found != nullptr && found->is_number())
        sum += std::fabs(found->get<double>());
    return sum;
  };
  // Mass damping does not count: it also takes the initial energy and, within theory's bounds, the energy that the sweep feeds.
  const double lost = joules({"friction_J", "fracture_J", "crushing_J", "contact_damping_J", "reset_J"});
  return lost > too_much_lost * joules({"base_work_J", "external_work_J", "tilt_work_J", "kinetic_J", "gravity_J", "elastic_J"});
}

// Reads the result of a run. The energy ledger judges it besides divergence: if the ledger does not close, the numbers are wrong, however
// small they are.
void read(study::MapRun& r, const Case& run, const std::string& quantity) {
  r.cpu += run.cpu;
  try {
    const Json metrics = read_metrics(run.directory);
    const std::string status = metrics.value("status", "");
    const auto number = [&](const std::string& key) {
      const Json* found = find_key(metrics, key);
      return found != nullptr && found->is_number() && std::isfinite(found->get<double>()) ? std::optional(found->get<double>())
                                                                                           : std::nullopt;
    };
    r.until = number("time_s").value_or(0), r.value = number("metrics." + quantity),
    r.residual = number("energy.residual_relative").value_or(0);
    r.broken = int(number("joints_broken").value_or(0));
    if (r.value) r.seen.push_back({r.until, *r.value});
    const bool by_ledger = r.scheme.sequential ? r.residual > wrong_ledger || own_doing(metrics) : run.code == exit_numbers;
    r.verdict = status == "diverged"                              ? RunVerdict::diverged
                : by_ledger                                       ? RunVerdict::ledger
                : status == "completed" || status == "inaccurate" ? RunVerdict::converged
                : status == "stopped"                             ? RunVerdict::bounded
                                                                  : RunVerdict::failed;
  } catch (const std::exception&) { r.verdict = RunVerdict::failed; }
  const bool tame = r.verdict == RunVerdict::converged || r.verdict == RunVerdict::bounded;
  r.reason = tame ? "" : last_words(run.log, run.code, run.scene);
}

Json json_of(const study::MapRun& r, const std::string& key) {
  Json seen = Json::array();
  for (const study::MapRun::Seen& one : r.seen) seen.push_back({one.until, one.value});
  return {{"key", key},
          {"seen", seen},
          {"verdict", int(r.verdict)},
          {"until", r.until},
          {"value", r.value ? Json(*r.value) : Json()},
          {"residual", r.residual},
          {"broken", r.broken},
          {"cpu_s", r.cpu},
          {"reason", r.reason}};
}

void read_note(study::MapRun& r, const std::string& path, const std::string& key) {
  try {
    if (!fs::exists(path)) return;
    const Json note = read_json(path);
    if (note.value("key", "") != key) return;
    r.verdict = RunVerdict(note.value("verdict", 0)), r.until = note.value("until", 0.0), r.residual = note.value("residual", 0.0);
    for (const Json& one : note.at("seen")) r.seen.push_back({one.at(0).get<double>(), one.at(1).get<double>()});
    if (note["value"].is_number()) r.value = note["value"].get<double>();
    r.broken = note.value("broken", 0), r.cpu = note.value("cpu_s", 0.0), r.reason = note.value("reason", "");
  } catch (const std::exception&) { r.verdict = RunVerdict::waiting; }
}

void settle_ratios(MapStudy& study) {
  const auto tame = [](const study::MapRun& r) { return r.verdict == RunVerdict::converged || r.verdict == RunVerdict::bounded; };
  for (study::MapRun& r : study.all)
    for (const study::MapRun& reference : study.all)
      if (!reference.scheme.sequential && reference.factor == r.factor && reference.dt == study.steps.front().second &&
          reference.damping == study.dampings.front() && tame(reference) && tame(r))
        r.ratio = ratio_of(r, reference);
}

void carry_out(MapStudy& study, const AccuracyCommand& command, const std::string& key) {
  BatchOptions batch = command.batch;
  batch.quiet = command.output.quiet;
  batch.threads = 1;
  const auto begin = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const double budget = command.budget > 0 ? command.budget : 3600;
  const auto folder_of = [&](const study::MapRun& r) { return study.directory + "/runs/" + stem(r); };
  for (study::MapRun& r : study.all) {
    if (batch.resume) read_note(r, folder_of(r) + ".json", key);
    if (r.verdict == RunVerdict::bounded && !fs::exists(folder_of(r) + "/checkpoint.bin")) r.verdict = RunVerdict::waiting, r.seen.clear();
  }
  for (const double share : shares) {
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < study.all.size(); ++i) {
      const study::MapRun& r = study.all[i];
      if (r.verdict == RunVerdict::waiting || (r.verdict == RunVerdict::bounded && r.until < 0.999 * share * study.window))
        which.push_back(i);
    }
    std::stable_sort(which.begin(), which.end(), [&](std::size_t a, std::size_t b) { return work(study.all[a]) < work(study.all[b]); });
    std::vector<Case> cases;
    for (const std::size_t i : which) {
      const study::MapRun& r = study.all[i];
      Case run;
      run.scene = study.scene, run.name = stem(r), run.directory = folder_of(r), run.log = run.directory + ".log", run.extra = r.words;
      run.resume = r.verdict == RunVerdict::bounded;
      run.within_budget = true;
      if (share < 1) run.extra.insert(run.extra.end(), {"--until", fmt::format("{}", share * study.window)});
      cases.push_back(std::move(run));
    }
    if (cases.empty()) continue;
    if (spent() >= budget) break;
    fmt::print(stderr, "{} runs up to {:.3g} s of the window, {} left\n", cases.size(), share * study.window,
               duration_text(budget - spent()));
    batch.budget = budget - spent();
    run_cases(cases, command.scene, batch, [&](const Case& run) {
      study::MapRun& r = study.all[which[std::size_t(&run - cases.data())]];
      read(r, run, study.quantity);
      if (run.overdue || !was_killed(run.code)) write_json(run.directory + ".json", json_of(r, key));
    });
  }
  settle_ratios(study);
}

void print_map(const MapStudy& study) {
  say("{}: {:g} s from t = {:.4g} s; 2/omega_max {:.4g} s, 2/omega_block {:.4g} s, the sweep feeds dt / 2 x {:.4g} 1/s2\n", study.name,
      study.window, study.from, study.nominal.critical, study.nominal.block, study.nominal.feed);
  int count[6] = {}, other = 0;
  for (const study::MapRun& r : study.all) {
    ++count[int(r.verdict)];
    const bool tame = r.verdict == RunVerdict::converged || r.verdict == RunVerdict::bounded;
    const bool told = r.verdict != RunVerdict::waiting && r.verdict != RunVerdict::failed;
    const bool theory = foretold(r, study.nominal);
    if (!told || tame == theory || (r.verdict == RunVerdict::bounded && !theory))
      continue;  // a run that is bounded so far may still diverge
    if (++other == 1) say("runs that contradict theory:\n");
    say("  {:<10} {:<8} stiffness x {:<4g} dt {:.4g} s ({}), c/m {:.4g} 1/s: {} at {:.4g} s\n",
        r.scheme.sequential ? "sequential" : "leapfrog", r.scheme.explicit_damping ? "explicit" : "centred", r.factor, r.dt, r.step,
        r.damping, word(r.verdict), r.until);
  }
  std::string text;
  for (int v = 0; v < 6; ++v)
    if (count[v] > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count[v], word(RunVerdict(v)));
  say("{} runs: {}; {} contradict theory\n", study.all.size(), text, other);
  if (count[0] + count[2] > 0) say("--resume --budget 60m continues the unfinished runs\n");
}

}  // namespace

int verb_map(const AccuracyCommand& command) {
  if (command.words.size() != 1) throw Error("accuracy --map takes one scene; write erbs accuracy SCENE.lua --map");
  MapStudy study;
  study.scene = command.words.front();
  if (!fs::is_regular_file(study.scene)) throw Error(fmt::format("there is no scene {}; check the path", study.scene));
  Script script(script_options(command.scene, true));
  const Scene scene = script.load(study.scene, command.scene.overrides);
  study.name = scene.name;
  study.directory = command.output.directory.empty() ? "runs/map_" + scene.name : command.output.directory;
  if (fs::exists(study.directory) && !command.output.force && !command.batch.resume)
    throw Error(fmt::format("{} exists; write --resume to keep its runs, or --force to make them again", study.directory));
  choose_quantity(study, scene, command.quantity);
  choose_window(study, scene, command.window);
  choose_steps(study, scene);
  choose_dampings(study, scene);
  study.factors = {1, 0.25, 4};
  study.all = plan(study);
  std::string key = program_version(), line = "erbs run " + study.scene;
  for (const auto& [file, hash] : scene.inputs) key += "\n" + hash;
  for (const auto& [name, value] : command.scene.overrides)
    key += "\n" + name + "=" + value, line += fmt::format(" -D '{}={}'", name, value);
  key += fmt::format("\n{} {} {}", study.from, study.window, study.quantity);
  fs::create_directories(study.directory + "/runs");
  carry_out(study, command, hash_text(fnv1a(key)));
  print_map(study);
  write_map_csv(study, line, run_file(study.directory, "map.csv"));
  draw_map(study, run_file(study.directory, "map.svg"));
  draw_map(study, run_file(study.directory, "map.png"));
  say("{0}/map.csv, map.svg, map.png\n", study.directory);
  return exit_ok;
}

}  // namespace erbs::lua
