#include "lua/reports/studies.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "engine/base/hash.h"
#include "engine/base/system/affinity.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/csv.h"
#include "engine/study/machine.h"
#include "engine/study/sweep/one_run.h"
#include "lua/program/progress.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;
using study::Study;

constexpr const char* question = "metrics.study";  // the answer of a run to the function of the scene
constexpr const char* updates = "point_updates";

std::string in(const study::Sweep& sweep, const char* file) { return sweep.directory + "/" + file; }

// All that the runs of a study depend on.
std::string key_of(const Study& s, const study::Sweep& sweep, const Scene& scene) {
  std::string text =
      fmt::format("{}\n{} {} {} {} {} {}\n{} {}", program_version(), s.param, s.lo, s.hi, s.rel, s.points, s.collapse, s.n, s.seed);
  text += fmt::format("\n{}\n{}", fmt::join(s.values, " "), fmt::join(sweep.arguments, "\n"));
  for (const auto& [file, hash] : scene.inputs) text += "\n" + file + " " + hash;
  return hash_text(text);
}

study::Sweep sweep_of(const Study& s, const Script& script, const std::string& path, const std::string& directory,
                      const RunCommand& command) {
  study::Sweep sweep;
  sweep.scene = path;
  sweep.directory = run_file(directory, "studies/" + s.name);
  study::Plan& plan = sweep.plan;
  plan.keep = "all";
  plan.max_wall = command.max_wall.value_or(0);
  plan.collect = {updates};
  plan.question = study::question_words(s);
  if (s.kind == Study::Kind::bisect) {
    plan.bisect = {s.param, s.lo, s.hi, s.rel, s.points, s.collapse ? "collapse.collapsed" : question, {}, !s.collapse, s.place};
    sweep.bisected = "x";
  } else {
    study::Axis axis;
    axis.params = {s.param}, sweep.params = {"x"};
    for (const double x : s.kind == Study::Kind::ensemble ? study::seeds(s.seed, s.n) : s.values) axis.rows.push_back({x});
    plan.axes = {axis};
    plan.collect.emplace_back(question);
  }
  sweep.collected = plan.collect;
  sweep.arguments = {"--study", s.name};
  for (const auto& [name, value] : command.scene.overrides)
    if (name != s.param) sweep.arguments.insert(sweep.arguments.end(), {"-D", name + "=" + value});
  for (const auto& words : {override_arguments(command), permissions(command.scene)})
    sweep.arguments.insert(sweep.arguments.end(), words.begin(), words.end());
  sweep.at_once = command.jobs > 0 ? command.jobs : command.threads > 0 ? command.threads : usable_processors();
  plan.memory = study::machine_memory() / sweep.at_once;
  sweep.key = key_of(s, sweep, script.scene());
  return sweep;
}

// Takes up the runs that were made before, but not those of another scene, nor those that a signal ended: they are made anew.
void take_up(const study::Sweep& sweep) {
  const std::string identity = in(sweep, "study.json"), runs = in(sweep, study::runs_file);
  if (!fs::exists(identity) || read_json(identity).value("key", "") != sweep.key) fs::remove_all(sweep.directory);
  fs::create_directories(sweep.directory);
  write_json(identity, {{"key", sweep.key}});
  std::string kept;
  bool killed = false;
  std::ifstream stream(runs);
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> cells = csv_cells(line);
    if (std::find(cells.begin(), cells.end(), "crash") == cells.end()) kept += line + "\n";
    else killed = true;
  }
  if (!killed) return;
  write_text_atomically(runs, kept);
  fs::remove(in(sweep, study::results_file));  // it follows from the runs
}

struct Run {
  study::Answer answer;
  double wall = 0, updates = 0;  // s; contact points evaluated
};

// The runs of a finished study by the value of its param.
std::map<double, Run> runs_of(const study::Sweep& sweep) {
  const CsvTable table = read_csv(in(sweep, study::runs_file));
  const auto word = [&](const char* column, std::size_t i) {
    const auto& cells = table.text[std::size_t(table.find(column))];
    return cells.empty() ? std::string() : cells[i];  // a column of empty cells has no text
  };
  const std::vector<double>& answers = table.column(sweep.plan.bisect ? "verdict" : question);
  std::map<double, Run> runs;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double x = table.columns[1][i], answer = answers[i];
    Run& run = runs[x];
    run.answer.x = x, run.answer.value.reset(), run.answer.reason.clear();
    run.wall = table.column("wall_s")[i], run.updates = table.column(updates)[i];
    const std::string status = word("status", i), reason = word("reason", i);
    if (std::isfinite(answer)) run.answer.value = answer;
    else run.answer.reason = status == "diverged" || status == "inaccurate" || status == "stopped" ? status + "; " + reason : reason;
  }
  return runs;
}

// The answers in the order in which the study asks, with a row for each in studies/NAME.csv.
study::StudyResult result_of(const Study& s, const study::Sweep& sweep, double& sum) {
  const std::map<double, Run> runs = runs_of(sweep);
  CsvWriter table(sweep.directory + ".csv", {s.param, "answer", "reason", "wall_s", "run"});
  std::size_t asked = 0;
  return carry_out(s, [&](const std::vector<double>& xs) {
    std::vector<study::Answer> answers;
    for (const double x : xs) {
      const Run& run = runs.at(x);
      const std::string place = sweep.plan.bisect ? place_of(sweep, 0, asked) : place_of(sweep, std::int64_t(asked), 0);
      table.text_row({fmt::format("{}", x), run.answer.value ? fmt::format("{}", *run.answer.value) : "nan", run.answer.reason,
                      fmt::format("{:.3f}", run.wall), "runs/" + place});
      if (std::isfinite(run.updates)) sum += run.updates;
      answers.push_back(run.answer);
      ++asked;
    }
    return answers;
  });
}

}  // namespace

StudiesOutcome run_studies(const Script& script, const std::string& path, const std::string& directory, const RunCommand& command,
                           const std::atomic<bool>& interrupted) {
  StudiesOutcome out;
  const bool live = isatty(STDERR_FILENO) != 0 && !command.output.quiet;
  for (const Study& s : script.studies()) {
    study::Sweep sweep = sweep_of(s, script, path, directory, command);
    sweep.interrupted = &interrupted;
    if (live)
      sweep.progress = [&](const study::Sweep::Progress& now) {
        if (now.end) fmt::print(stderr, "\r\033[K");
        else if (sweep.plan.bisect) fmt::print(stderr, "\r\033[K{}: {} runs", s.name, now.runs);
        else
          fmt::print(stderr, "\r\033[K{}: {} of {} runs, {} failed{}", s.name, now.done, now.points, now.failed,
                     now.left >= 0 ? ", about " + duration_text(now.left) + " left" : "");
      };
    take_up(sweep);
    if (carry_out(sweep).interrupted) {
      out.interrupted = true;
      return out;
    }
    const study::StudyResult result = result_of(s, sweep, out.updates);
    for (const auto& [name, value] : result.metrics) out.metrics[name] = value ? Json(*value) : Json(nullptr);
    if (!result.trouble.empty()) out.troubles.push_back(result.trouble);
  }
  return out;
}

bool studies_left(const Script& script, const std::string& directory) {
  const std::string metrics = run_file(directory, "metrics.json");
  if (script.studies().empty() || !is_run_folder(directory) || !fs::exists(metrics)) return false;
  const std::string status = read_json(metrics).value("status", "");
  return status == "completed" || status == "inaccurate";
}

}  // namespace erbs::lua
