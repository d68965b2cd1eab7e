#include "lua/reports/cases.h"

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/base/system/affinity.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/json.h"
#include "engine/study/pool.h"
#include "lua/program/child.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Whether the text calls expect(), expect_image() or expect_stored(), or asks converge{} for a slope.
bool carries_expectations(const fs::path& path) {
  std::istringstream lines(whole_text(path));
  bool converges = false;
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.size(), line.find("--")));
    const auto follows = [&](size_t word_end, const char* one_of) {
      const size_t next = line.find_first_not_of(" \t", word_end);
      return next != std::string::npos && std::string_view(one_of).find(line[next]) != std::string_view::npos;
    };
    for (size_t at = line.find("expect"); at != std::string::npos; at = line.find("expect", at + 1))
      if (follows(line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 6), "(=")) return true;
    converges = converges || line.find("converge") != std::string::npos;
    if (const size_t at = line.find("slope"); converges && at != std::string::npos && follows(at + 5, "=")) return true;
  }
  return false;
}

std::vector<std::string> scenes_of(const std::string& word) {
  std::vector<std::string> found;
  if (fs::is_regular_file(word)) return {word};
  if (!fs::is_directory(word)) throw Error(fmt::format("there is no scene and no folder {}; check the path", word));
  for (fs::recursive_directory_iterator at(word); at != fs::recursive_directory_iterator(); ++at) {
    const fs::path& path = at->path();
    if (at->is_directory() && is_run_folder(path.string())) at.disable_recursion_pending();  // its scene.lua is a copy
    else if (at->is_regular_file() && path.extension() == ".lua" && carries_expectations(path)) found.push_back(path.string());
  }
  std::sort(found.begin(), found.end());
  if (found.empty()) throw Error(fmt::format("{} holds no scene with expectations; add expect(...) to one", word));
  return found;
}

// A scene that cannot be read stays in the list: the run of its case then reports the mistake.
bool carries(const std::string& scene, const std::string& label, const SceneOptions& options) {
  try {
    Script script(script_options(options, true));
    const auto& labels = script.load(scene, options.overrides).labels;
    return std::find(labels.begin(), labels.end(), label) != labels.end();
  } catch (const std::exception&) { return true; }
}

study::Job job_of(const Case& item, const SceneOptions& options, int threads, std::optional<double> max_wall) {
  std::vector<std::string> command{
      own_path(), "run", item.scene, "-o", item.directory, item.resume ? "--resume" : "--force", "--no-figures", "--figure-scripts"};
  if (threads > 0) command.insert(command.end(), {"--threads", std::to_string(threads)});
  if (options.allow_unstable) command.emplace_back("--allow-unstable");
  if (max_wall) command.insert(command.end(), {"--max-wall", fmt::format("{}s", *max_wall)});
  for (const auto& more : {item.extra, scene_arguments(options)}) command.insert(command.end(), more.begin(), more.end());
  for (const char* old : {"expectations.json", "metrics.json"}) fs::remove(run_file(item.directory, old));
  // A run stops at its limit by itself and keeps its results; its studies may not.
  const double most = max_wall.value_or(0);
  return {command, {.output = item.log, .errors = item.log}, most > 0 ? most + 2 : 0, most > 0 ? most + 12 : 0};
}

}  // namespace

bool CaseResult::passed() const {
  return trouble.empty() && std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.passed; });
}

std::vector<Case> find_cases(const std::vector<std::string>& words, const SceneOptions& options, const std::string& out,
                             const std::string& label) {
  std::vector<Case> cases;
  std::set<std::string> names, files;
  for (const auto& word : words)
    for (const auto& scene : scenes_of(word)) {
      if (!files.insert(fs::weakly_canonical(scene).string()).second) continue;
      if (!label.empty() && !carries(scene, label, options)) continue;
      const std::string stem = fs::path(scene).stem().string();
      std::string name = stem;
      for (int i = 2; !names.insert(name).second; ++i) name = fmt::format("{}_{}", stem, i);
      cases.push_back({scene, name, out + "/" + name, out + "/" + name + ".log", {}});
    }
  if (cases.empty()) throw Error(fmt::format("no scene carries the label \"{}\"; write label(\"{}\") in one", label, label));
  return cases;
}

void run_cases(std::vector<Case>& cases, const SceneOptions& options, const BatchOptions& batch,
               const std::function<void(const Case&)>& ended) {
  const int machine = usable_processors();
  study::Pool pool(batch.jobs);
  // with as many runs at once as processors, each run gets one thread; with fewer runs, each chooses by itself (0)
  const int threads = batch.threads > 0 ? batch.threads : static_cast<int>(std::min(pool.size(), cases.size())) >= machine ? 1 : 0;
  size_t next = 0, done = 0;
  const bool live = isatty(STDERR_FILENO) != 0 && !batch.quiet;
  const auto begin = Clock::now();
  auto told = begin;
  const auto left_of_budget = [&] { return batch.budget - std::chrono::duration<double>(Clock::now() - begin).count(); };
  const auto in_time = [&] { return batch.budget <= 0 || left_of_budget() > 0; };
  const std::atomic<bool>& interrupted = catch_interrupts();
  while (!pool.empty() || (next < cases.size() && in_time() && !interrupted)) {
    if (interrupted) pool.interrupt_all();
    for (; next < cases.size() && !pool.full() && in_time() && !interrupted; ++next) {
      Case& item = cases[next];
      item.started = true;
      fs::create_directories(fs::path(item.directory).parent_path());
      std::optional<double> max_wall = batch.max_wall;
      if (item.within_budget && batch.budget > 0) max_wall = std::min(max_wall.value_or(1e9), std::max(1.0, left_of_budget()));
      pool.add(next, job_of(item, options, threads, max_wall));
    }
    if (live) {
      const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
      const double left = done > 0 ? spent / static_cast<double>(done) * static_cast<double>(cases.size() - done) : 0;
      fmt::print(stderr, "\r\033[K{} of {} cases, about {:.0f} s left, running {}", done, cases.size(), left,
                 shown(cases[pool.first()].name, 60));
    }
    if (!live && !batch.quiet && done > 0 && Clock::now() - told > std::chrono::seconds(10)) {
      told = Clock::now();
      const double spent = std::chrono::duration<double>(told - begin).count();
      fmt::print(stderr, "{} of {} cases, about {:.0f} s left\n", done, cases.size(),
                 spent / static_cast<double>(done) * static_cast<double>(cases.size() - done));
    }
    const auto child = pool.wait(1.0);
    if (!child) continue;
    Case& item = cases[child->id];
    item.code = child->code, item.cpu = child->cpu, item.overdue = child->overdue;
    if (ended) ended(item);
    ++done;
  }
  if (live) fmt::print(stderr, "\r\033[K");
  if (interrupted) throw Interrupted(fmt::format("interrupted; {} of {} runs are done", done, cases.size()));
}

CaseResult result_of(const Case& item) {
  CaseResult result;
  result.scene = item.scene;
  result.name = item.name;
  result.cpu = item.cpu;
  result.title = title_of(whole_text(item.scene));
  try {
    if (fs::exists(run_file(item.directory, "metrics.json"))) {
      const Json metrics = read_metrics(item.directory);
      result.updates = number_at(metrics, "point_updates") + number_at(metrics, "study_point_updates");
      const double limit = number_at(metrics, "dt_critical_s");
      if (limit > 0) result.dt_share = number_at(metrics, "dt_s") / limit;
    }
    if (fs::exists(run_file(item.directory, "expectations.json")))
      result.verdicts = verdicts_of(read_json(run_file(item.directory, "expectations.json")));
    result.figures = figures_of(item.directory);
  } catch (const std::exception& error) { result.trouble = error.what(); }
  const bool wrong_code = item.code != exit_ok && item.code != exit_expectation;
  result.started = item.started;
  if (!item.started) result.trouble = "not started: the time of --budget was over";
  else if (item.overdue) result.trouble = "stopped: it took longer than --max-wall allows";
  else if (wrong_code) result.trouble = last_words(item.log, item.code, item.scene);
  else if (result.verdicts.empty() && result.trouble.empty()) result.trouble = "the scene carries no expectation; add expect(...)";
  return result;
}

std::string cost_text(const CaseResult& result) { return fmt::format("{:.2f} s, {:.2g} pt", result.cpu, result.updates); }

}  // namespace erbs::lua
