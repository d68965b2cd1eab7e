#include "lua/reports/grid.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "engine/base/hash.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "engine/record/folder/manifest.h"
#include "engine/scene/effects.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"
#include "lua/reading/family.h"
#include "lua/reading/read.h"
#include "lua/reports/book.h"
#include "lua/reports/cases.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr double dt_fractions[] = {0.2, 0.5, 0.9};  // of dt_critical
constexpr int point_numbers[] = {4, 9, 25};         // per joint
constexpr double noise = 1e-8;                      // m and rad
constexpr double family_fractions[] = {0.25, 0.5, 0.9};
constexpr int level_numbers[] = {1, 2};  // of contacts, each at the step and the points of the scene
constexpr int draws = 100;               // draws of one combination until the scene accepts one

struct Variant {
  Case run;
  std::string scene_name, words;  // "dt 0.2, 9 points"
  std::string note, key;
  std::string refused;  // reason why the scene itself refuses the combination; "" if it does not
  bool done = false;
  CaseResult result;
};

Variant variant_of(const Case& scene, const std::string& key, const std::string& stem, const std::string& words,
                   std::vector<std::string> extra) {
  Variant v;
  v.scene_name = scene.name;
  v.words = words.empty() ? "as it is" : words;
  v.run = scene;
  v.run.extra = std::move(extra);
  v.run.name = scene.name + stem;
  v.run.directory = scene.directory + "/run" + stem;
  v.run.log = v.run.directory + ".log";
  v.note = v.run.directory + ".json";
  v.key = hash_text(fnv1a(key + stem));
  return v;
}

Variant variant_of(const Case& scene, const std::string& key, const Choice& choice) {
  std::string stem, words;
  std::vector<std::string> extra;
  for (const auto& [name, value] : choice) {
    stem += fmt::format("_{}{}", name, written(value));
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name, written(value));
    extra.insert(extra.end(), {"-D", fmt::format("{}={:.17g}", name, value)});
  }
  return variant_of(scene, key, stem, words, std::move(extra));
}

// The reason why the scene cannot be built with this choice; "" if it can.
std::string refusal(const Case& scene, const SceneOptions& options, const Choice& choice) {
  Overrides overrides = options.overrides;
  for (const auto& [name, value] : choice) overrides.emplace_back(name, fmt::format("{:.17g}", value));
  try {
    Script(script_options(options, true)).load(scene.scene, overrides);
    return "";
  } catch (const std::exception& error) { return error.what(); }
}

// Variants of a scene with a family: other time steps, every value alone, and random combinations. Params given by -D stay fixed.
std::vector<Variant> family_of(const Case& scene, const SceneOptions& options, ParamFamily family, const std::string& key, bool fixed_dt) {
  const Overrides& overrides = options.overrides;
  std::erase_if(family.values, [&](const auto& list) {
    return std::any_of(overrides.begin(), overrides.end(), [&](const auto& given) { return given.first == list.first; });
  });
  std::vector<Variant> all;
  for (const double share : family_fractions)
    if (!fixed_dt)
      all.push_back(
          variant_of(scene, key, fmt::format("_dt{}", share), fmt::format("dt {}", share), {"--dt-fraction", fmt::format("{}", share)}));
  for (const Choice& choice : one_at_a_time(family)) {
    all.push_back(variant_of(scene, key, choice));
    if (const std::string why = refusal(scene, options, choice); !why.empty()) all.back().refused = why;
  }
  std::set<Choice> drawn;
  const int n = family.values.size() > 1 ? family.combinations : 0;
  for (int i = 0; static_cast<int>(drawn.size()) < n && i < draws * n; ++i) {
    const Choice choice = combination(family, i);
    if (drawn.contains(choice) || !refusal(scene, options, choice).empty()) continue;
    drawn.insert(choice);
    all.push_back(variant_of(scene, key, choice));
  }
  return all;
}

// Other numbers of levels, where the scene may have any. One that names them keeps its own.
void add_levels(std::vector<Variant>& all, const Case& scene, const Scene& s, const ParamFamily& family, const std::string& key) {
  const bool may =
      s.analysis.debris && std::ranges::any_of(effects_of(s), [](const Effect& e) { return e.on && e.name == "levels of contacts"; });
  const bool own = s.analysis.levels > 0 || std::ranges::any_of(family.values, [](const auto& list) { return list.first == "levels"; });
  if (!may || own || s.push.quasi_static()) return;
  for (const int levels : level_numbers)
    all.push_back(variant_of(scene, key, fmt::format("_levels{}", levels), fmt::format("{} levels", levels),
                             {"--noise", fmt::format("{:g}", noise), "--set", fmt::format("levels={}", levels)}));
}

std::string key_of(const Script& script, const Overrides& overrides) {
  std::string key = program_version();
  for (const auto& [name, value] : overrides) key += "\n" + name + "=" + value;
  for (const auto& [file, hash] : script.scene().inputs) key += "\n" + hash;
  return key;
}

std::vector<Variant> seeds_of(const Case& scene, const TestCommand& command) {
  const Overrides& overrides = command.scene.overrides;
  Script script(script_options(command.scene, true));
  const auto& params = script.load(scene.scene, overrides).params;
  if (std::none_of(params.begin(), params.end(), [](const Param& param) { return param.name == "seed"; }))
    throw Error(fmt::format("{} has no param \"seed\"; write param(\"seed\", 1, \"\") in it, or leave --seeds out", scene.scene));
  std::vector<Variant> all;
  for (int i = 1; i <= command.seeds; ++i) all.push_back(variant_of(scene, key_of(script, overrides), {{"seed", i}}));
  return all;
}

// Variants of a scene. A scene with a family is run over it. A scene with a fixed step keeps it; one without joints keeps its points.
std::vector<Variant> variants_of(const Case& scene, const SceneOptions& options) {
  const Overrides& overrides = options.overrides;
  bool fixed_dt = false, joints = true;
  std::string key = program_version();
  std::vector<Variant> levels;
  try {
    Script script(script_options(options, true));
    const Scene& s = script.load(scene.scene, overrides);
    key = key_of(script, overrides);
    fixed_dt = std::find(s.labels.begin(), s.labels.end(), "fixed_dt") != s.labels.end();
    joints = std::any_of(s.joint_rules.begin(), s.joint_rules.end(), [](const JointRule& rule) { return !rule.none; });
    add_levels(levels, scene, s, script.family(), key);
    if (!script.family().values.empty()) {
      std::vector<Variant> all = family_of(scene, options, script.family(), key, fixed_dt);
      all.insert(all.end(), levels.begin(), levels.end());
      return all;
    }
  } catch (const std::exception&) {}  // its run reports the mistake
  std::vector<Variant> all;
  for (size_t i = 0; i < (fixed_dt ? 1 : std::size(dt_fractions)); ++i)
    for (size_t k = 0; k < (joints ? std::size(point_numbers) : 1); ++k) {
      std::string stem, words;
      std::vector<std::string> extra = {"--noise", fmt::format("{:g}", noise)};
      if (!fixed_dt) {
        extra.insert(extra.end(), {"--dt-fraction", fmt::format("{}", dt_fractions[i])});
        stem += fmt::format("_dt{}", dt_fractions[i]), words = fmt::format("dt {}", dt_fractions[i]);
      }
      if (joints) {
        extra.insert(extra.end(), {"--points", std::to_string(point_numbers[k])});
        stem += fmt::format("_p{}", point_numbers[k]), words += fmt::format("{}{} points", words.empty() ? "" : ", ", point_numbers[k]);
      }
      all.push_back(variant_of(scene, key, stem, words, std::move(extra)));
    }
  all.insert(all.end(), levels.begin(), levels.end());
  return all;
}

Json json_of(const Variant& v) {
  return {{"key", v.key},
          {"verdicts", to_json(v.result.verdicts)},
          {"trouble", v.result.trouble},
          {"cpu_s", v.result.cpu},
          {"updates", v.result.updates},
          {"dt_share", v.result.dt_share}};
}

bool read_note(Variant& v) {
  try {
    if (!fs::exists(v.note)) return false;
    const Json note = read_json(v.note);
    if (note.value("key", "") != v.key) return false;
    v.result.name = v.run.name;
    v.result.scene = v.run.scene;
    v.result.verdicts = verdicts_of(note.at("verdicts"));
    v.result.trouble = note.value("trouble", "");
    v.result.cpu = note.value("cpu_s", 0.0), v.result.updates = note.value("updates", 0.0), v.result.dt_share = note.value("dt_share", 0.0);
    return v.done = true;
  } catch (const std::exception&) { return false; }
}

// The worst value of one invariant over all variants of a scene.
struct Worst {
  std::string scene, key, expected, got, tolerance, at;
  double used = 0;
  int runs = 0;
  std::vector<std::string> failed;  // settings at which it fails
};

struct Grid {
  std::vector<Worst> rows;
  std::vector<std::string> refused;  // by a limit of use that the scene states, or by the scene itself
  int runs = 0, missing = 0;
  double cpu = 0;
};

void add(Worst& row, const Variant& v, const Verdict& verdict) {
  const double used = verdict.passed ? verdict.used : std::max(verdict.used, 1.0);
  if (row.runs++ == 0 || used > row.used)
    row.used = used, row.expected = verdict.expected, row.got = verdict.got, row.tolerance = verdict.tolerance, row.at = v.words;
  if (!verdict.passed) row.failed.push_back(v.words);
}

Grid worst_of(const std::vector<Variant>& variants) {
  Grid grid;
  std::map<std::pair<std::string, std::string>, size_t> index;
  const auto row_of = [&](const std::string& scene, const std::string& key) -> Worst& {
    const auto [at, fresh] = index.emplace(std::pair{scene, key}, grid.rows.size());
    if (fresh) grid.rows.push_back({scene, key, "", "", "", "", 0, 0, {}});
    return grid.rows[at->second];
  };
  for (const Variant& v : variants) {
    if (!v.refused.empty()) {
      grid.refused.push_back(fmt::format("{} at {}: {}", v.scene_name, v.words, v.refused));
      continue;
    }
    if (!v.done) {
      ++grid.missing;
      continue;
    }
    ++grid.runs;
    grid.cpu += v.result.cpu;
    if (v.result.trouble.find("use_limit:") != std::string::npos) {
      grid.refused.push_back(fmt::format("{} at {}: {}", v.scene_name, v.words, v.result.trouble));
      continue;
    }
    for (const Verdict& verdict : v.result.verdicts) add(row_of(v.scene_name, verdict.key), v, verdict);
    Verdict run;
    run.expected = "completes";
    run.passed = v.result.trouble.empty();
    run.got = run.passed ? "completed" : v.result.trouble;
    run.used = run.passed ? 0 : 1e300;
    add(row_of(v.scene_name, "(run)"), v, run);
  }
  return grid;
}

std::string summary_of(const Grid& grid) {
  const auto failed = std::count_if(grid.rows.begin(), grid.rows.end(), [](const Worst& w) { return !w.failed.empty(); });
  std::string text = fmt::format("{}, {}: {} hold on the whole grid, {} do not", counted(grid.runs, "run"),
                                 counted(grid.rows.size(), "invariant"), grid.rows.size() - static_cast<size_t>(failed), failed);
  if (!grid.refused.empty()) text += fmt::format("; {} refused by a limit of the scene", counted(grid.refused.size(), "run"));
  if (grid.missing > 0) text += fmt::format("; {} runs are still missing", grid.missing);
  return text;
}

std::string share_text(const Worst& w) { return std::isfinite(w.used) && w.used < 1e100 ? fmt::format("{:.2g}", w.used) : "-"; }

void print(const Grid& grid) {
  size_t a = 4, b = 9, c = 5, d = 5, e = 2;
  for (const Worst& w : grid.rows)
    a = std::max(a, w.scene.size()), b = std::max(b, w.key.size()), c = std::max(c, w.expected.size() + w.tolerance.size() + 1),
    d = std::max(d, std::min<size_t>(w.got.size(), 40)), e = std::max(e, w.at.size());
  say("{:<{}}  {:<{}}  {:<{}}  {:<{}}  {:<6}  {:<{}}  {:<9}  runs\n", "case", a, "invariant", b, "bound", c, "worst", d, "share", "at", e,
      "verdict");
  for (const Worst& w : grid.rows)
    say("{:<{}}  {:<{}}  {:<{}}  {:<{}}  {:<6}  {:<{}}  {:<9}  {}\n", w.scene, a, w.key, b, w.expected + " " + w.tolerance, c, w.got, d,
        share_text(w), w.at, e, !w.failed.empty() ? fmt::format("FAILED {}", w.failed.size()) : "ok", w.runs);
  for (const Worst& w : grid.rows)
    if (!w.failed.empty()) say("{} {} fails at {}\n", w.scene, w.key, fmt::join(w.failed, "; "));
  for (const auto& text : grid.refused) say("refused: {}\n", text);
  say("{} ({} of processor time)\n", summary_of(grid), duration_text(grid.cpu));
  std::fflush(stdout);
}

void write_page(const Grid& grid, const TestCommand& command, double wall) {
  std::string text = "# The hard cases over a grid of settings\n\n";
  text += fmt::format(
      "Written by `erbs test {} --grid --book {}`, never edited by hand: {} of processor time{}, erbs {}. Every scene runs at "
      "0.2, 0.5 and 0.9 of the limit of the time step, with 4, 9 and 25 contact points per joint. Noise of {:g} (m, rad) in the initial "
      "state of every free block reveals instabilities that exact symmetry would hide. A scene with a fixed step keeps it; a scene without "
      "joints has no points to vary. A scene with a family runs at 0.25, 0.5 and 0.9 of the limit, and at its default step with each value "
      "of the family and some combinations. Scenes with joints and contacts run with 1 and 2 time levels too, unless they cannot have any. "
      "Each row is the worst value of one invariant over these runs.\n\n**{}**\n\n",
      fmt::join(command.words, " "), fs::proximate(command.book).generic_string(), duration_text(grid.cpu),
      wall > 0 ? fmt::format(", {} of wall-clock time", duration_text(wall)) : "", program_version(), noise, summary_of(grid));
  text += "| case | invariant | bound | worst | share of the bound | at | runs | verdict |\n|---|---|---|---|---|---|---|---|\n";
  std::string last;
  for (const Worst& w : grid.rows) {
    text += fmt::format("| {} | {} | {} {} | {} | {} | {} | {} | {} |\n", w.scene == last ? "" : code_cell(w.scene), code_cell(w.key),
                        cell(w.expected), cell(w.tolerance), cell(w.got), share_text(w), w.at, w.runs,
                        !w.failed.empty() ? fmt::format("**failed in {}**", w.failed.size()) : "ok");
    last = w.scene;
  }
  if (!grid.refused.empty()) text += "\nRefused by a limit of the scene:\n\n";
  for (const auto& refused : grid.refused) text += "- " + refused + "\n";
  write_text_atomically(command.book, text);
  const std::string readme = (fs::absolute(command.book).parent_path().parent_path() / "README.md").string();
  if (fs::exists(readme))
    replace_marked(readme, "grid",
                   fmt::format("[The hard cases over a grid of settings]({}): {}.", relative_link(readme, command.book), summary_of(grid)));
}

}  // namespace

int run_grid(const TestCommand& command) {
  BatchOptions batch = command.batch;
  if (!batch.max_wall) batch.max_wall = 900;  // three poured piles at 0.2 of the limit, on busy processors
  if (batch.budget <= 0) batch.budget = 3600;
  const std::string out = command.directory.empty() ? (command.seeds > 0 ? "runs/seeds" : "runs/grid") : command.directory;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Variant> variants;
  for (const Case& scene : find_cases(command.words, command.scene, out, ""))
    for (Variant& v : command.seeds > 0 ? seeds_of(scene, command) : variants_of(scene, command.scene)) variants.push_back(std::move(v));
  std::vector<Case> runs;
  std::map<std::string, Variant*> of_name;
  for (Variant& v : variants) {
    if (!v.refused.empty() || (batch.resume && read_note(v))) continue;
    runs.push_back(v.run);
    of_name[v.run.name] = &v;
  }
  run_cases(runs, command.scene, batch, [&](const Case& run) {
    Variant& v = *of_name.at(run.name);
    v.result = result_of(run);
    v.done = true;
    if (run.overdue || !was_killed(run.code)) write_json(v.note, json_of(v));
  });
  const Grid grid = worst_of(variants);
  print(grid);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!command.book.empty()) write_page(grid, command, batch.resume ? 0 : wall);  // of a resumed grid the total time is unknown
  if (grid.missing > 0) {
    say("out of time; the same command with --resume makes the remaining runs\n");
    return exit_stopped;
  }
  return std::any_of(grid.rows.begin(), grid.rows.end(), [](const Worst& w) { return !w.failed.empty(); }) ? exit_expectation : exit_ok;
}

}  // namespace erbs::lua
