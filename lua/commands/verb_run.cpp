// erbs run SCENE.lua: loads and runs the scene, evaluates its metrics, judges its expectations, prints a summary.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <atomic>
#include <thread>

#include "engine/analysis/dynamic.h"
#include "engine/analysis/quasi_static/push_run.h"
#include "engine/base/system/affinity.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/text.h"
#include "engine/record/format/json.h"
#include "engine/record/performance/performance_figure.h"
#include "engine/scene/effects.h"
#include "engine/study/twin.h"
#include "lua/program/child.h"
#include "lua/program/options.h"
#include "lua/program/overrides.h"
#include "lua/program/progress.h"
#include "lua/program/run_again.h"
#include "lua/program/say.h"
#include "lua/reports/expectations.h"
#include "lua/reports/figures.h"
#include "lua/reports/profile_text.h"
#include "lua/reports/run_summary.h"
#include "lua/reports/stored.h"
#include "lua/reports/studies.h"

namespace erbs::lua {
namespace {

// Stored pictures and values are those of the scene as it is written: a run that is changed by options is not compared with them.
std::vector<Verdict> judge_all(const Scene& scene, const std::string& path, const std::string& directory, bool as_written,
                               const Json& metrics) {
  std::vector<Expectation> expectations = scene.expectations;
  if (!as_written) std::erase_if(expectations, [](const Expectation& item) { return item.stored; });
  expectations = with_stored_values(std::move(expectations), path);
  std::vector<Verdict> verdicts = judge(expectations, metrics);
  name_stored_values(expectations, path, directory, verdicts);
  if (as_written)
    for (Verdict& verdict : judge_pictures(scene, path, directory)) verdicts.push_back(std::move(verdict));
  return verdicts;
}

// Evaluates the metrics and expectations of the scene and writes them into the run folder. Returns the messages of failed metrics.
std::vector<std::string> complete_metrics(Script& script, const std::string& path, const std::string& directory, bool whole,
                                          bool as_written, const StudiesOutcome& studies, Json& metrics, std::vector<Verdict>& verdicts) {
  std::vector<std::string> failures;
  metrics = read_metrics(directory);
  metrics["metrics"] = studies.metrics;  // first the results of the studies: metrics of the scene may use them
  Json own = Json::object();
  for (const MetricValue& metric :
       script.evaluate_metrics({metrics, read_csv(run_file(directory, "histories.csv")), read_csv(run_file(directory, "events.csv"))})) {
    own[metric.name] = metric.value ? Json(*metric.value) : Json(nullptr);
    if (!metric.warning.empty()) tell(stderr, metric.warning);
    if (!metric.error.empty()) failures.push_back(metric.error);
  }
  for (const auto& [name, value] : studies.metrics.items()) own[name] = value;
  metrics["metrics"] = own;
  if (!script.studies().empty()) metrics["study_point_updates"] = studies.updates;
  if (whole) verdicts = judge_all(script.scene(), path, directory, as_written, metrics);
  int passed = 0;
  for (const Verdict& verdict : verdicts) passed += verdict.passed;
  metrics["expectations"] = {{"passed", passed}, {"failed", static_cast<int>(verdicts.size()) - passed}};
  write_json(run_file(directory, "metrics.json"), metrics);
  if (!verdicts.empty()) write_json(run_file(directory, "expectations.json"), to_json(verdicts));
  return failures;
}

int exit_code(const Scene& scene, const RunCommand& command, const analysis::RunOutcome& outcome, const Json& metrics,
              const std::vector<Verdict>& verdicts) {
  const std::string& status = outcome.metrics.status;
  if (status == "interrupted") return exit_interrupted;
  if (status == "stopped") return exit_stopped;
  if (status != "completed" && !expects_status(scene, status)) return exit_numbers;
  for (const Verdict& verdict : verdicts)
    if (!verdict.passed) return exit_expectation;
  const Json* collapsed = find_key(metrics, "collapse.collapsed");
  if (command.fail_on_collapse && collapsed && *collapsed == true) return exit_expectation;
  return exit_ok;
}

constexpr double twin_noise = 1e-9, twin_apart = 1e-3;  // m

// The twin: the same run again with tiny noise, in a folder inside that of the run.
class Twin {
 public:
  Twin(const std::string& scene, const std::string& directory, const RunCommand& command)
      : run_(directory), twin_(run_file(directory, "twin")) {
    command_ = {own_path(),
                "run",
                scene,
                "-o",
                twin_,
                "--quiet",
                "--no-figures",
                "--study",
                "twin",
                "--twin-noise",
                fmt::format("{:g}", twin_noise)};
    for (const auto& more : {override_arguments(command), scene_arguments(command.scene)})
      command_.insert(command_.end(), more.begin(), more.end());
    if (command.until) command_.insert(command_.end(), {"--until", fmt::format("{}", *command.until)});
    if (command.max_wall) command_.insert(command_.end(), {"--max-wall", fmt::format("{}s", *command.max_wall)});
    if (command.threads > 0) command_.insert(command_.end(), {"--threads", std::to_string(command.threads)});
    command_.emplace_back(command.resume && std::filesystem::exists(run_file(twin_, "checkpoint.bin")) ? "--resume" : "--force");
  }

  // Runs the twin and notes the time at which it parts from the run. Returns "", or the reason why there is no such time.
  std::string compare(Json& metrics) const {
    const int code = wait_for(start(command_, twin_ + ".log"));
    if (code != exit_ok) return "the twin run failed: " + last_words(twin_ + ".log", code, "");
    const std::optional<double> parted = study::parting_time(run_, twin_, twin_apart);
    metrics["trust"]["twin"] = true;
    metrics["trust"]["chaos_horizon_s"] = parted ? Json(*parted) : Json();
    return "";
  }

 private:
  std::string run_, twin_;
  std::vector<std::string> command_;
};

// Default: all processors, but one thread for few blocks, since a step of 12 bricks takes 7 us, about as long as two synchronisations
// of two threads. Never more threads than processors: threads that share a processor would wait for each other in every step. The
// results of a run do not depend on the number of threads.
int threads_of(const Scene& scene, const RunCommand& command) {
  const int usable = usable_processors();
  if (command.threads <= 0) return scene.blocks.size() < 100 ? 1 : usable;
  if (command.threads > usable)
    tell(stderr, fmt::format("warning: --threads {}: this process may use {}; it runs with as many threads", command.threads,
                             counted(usable, "processor")));
  return std::min(command.threads, usable);
}

// Hands one scene to the engine, which writes one run folder.
analysis::RunOutcome run_scene(Scene scene, const std::string& script, const std::vector<std::string>& notes, const std::string& directory,
                               const RunCommand& command) {
  analysis::RunOptions run;
  run.directory = directory;
  run.scene_path = std::filesystem::absolute(scene.file).lexically_normal().string();
  run.arguments = kept_arguments(command);
  run.notes = notes;
  run.override_arguments = override_arguments(command);
  if (command.twin_noise > 0)
    run.override_arguments.insert(run.override_arguments.end(), {"--twin-noise", fmt::format("{}", command.twin_noise)});
  run.existing = command.resume ? Existing::resume : command.output.force ? Existing::force : Existing::refuse;
  run.threads = threads_of(scene, command);
  run.until = command.until;
  run.max_wall = command.max_wall.value_or(0);
  run.checkpoint_every = command.checkpoint_every.value_or(60);
  run.allow_unstable = command.scene.allow_unstable;
  run.noise = command.changes.noise;
  run.noise_seed = unsigned(command.changes.noise_seed);
  run.twin_noise = command.twin_noise;
  run.interrupted = &catch_interrupts();
  ProgressPrinter printer(command.output.quiet, command.log_json);
  run.progress = [&](const analysis::Progress& now) { printer.show(now); };
  return scene.push.quasi_static() ? analysis::run_push(std::move(scene), script, run)
                                   : analysis::run_dynamic(std::move(scene), script, run);
}

// A user should learn before a run, not after it, that its curves cannot be drawn.
void check_drawing(RunCommand& command) {
  if (!command.figures) return;
  for (const auto& [name, remedy] : {std::pair<std::string, const char*>{"gnuplot", "install the package gnuplot-nox"},
                                     {renderer_path(), "it belongs beside erbs: build or install both"}}) {
    if (can_start(name)) continue;
    tell(stderr, fmt::format("warning: curves need {}, which is not there; the run goes on without them; {}", name, remedy));
    command.figures = false;
    command.figure_scripts = true;
    return;
  }
}

// Draws histories.svg and energy.svg. A failure is only a warning.
void draw_curves(const std::string& directory) {
  try {
    if (run_renderer({directory, "--figures", "--quiet"}) == 0) return;
  } catch (const Error& error) { tell(stderr, error.what()); }
  tell(stderr, fmt::format("warning: the curves could not be drawn; erbs render {} --figures draws them", directory));
}

// Draws performance.svg of a run that has a performance point. A failure is only a warning.
void draw_performance_point(const Scene& scene, const std::string& directory, const analysis::RunOutcome& outcome) {
  const std::optional<Capacity>& capacity = outcome.metrics.capacity;
  if (!capacity || !capacity->performance) return;
  try {
    draw_performance(run_file(directory, "performance.svg"), *capacity->performance, scene.performance.spectrum, scene.name);
  } catch (const Error& error) { tell(stderr, fmt::format("warning: performance.svg could not be drawn: {}", error.what())); }
}

// Work after the run itself: studies, twin, metrics and pictures. Returns the exit code.
int complete(Script& script, const std::string& path, const std::string& directory, const analysis::RunOutcome& outcome,
             const RunCommand& command) {
  const std::atomic<bool>& interrupted = catch_interrupts();
  Json metrics;
  std::vector<Verdict> verdicts;
  const std::string& status = outcome.metrics.status;
  const bool whole = status == "completed" || status == "inaccurate" || status == "diverged";
  StudiesOutcome studies;
  if (whole && command.study.empty() && command.studies) studies = run_studies(script, path, directory, command, interrupted);
  if (studies.interrupted) {
    tell(stderr, "interrupted; finished runs of the studies are kept; go on: " + resume_line(directory));
    return exit_interrupted;
  }
  if (whole && command.twin) {
    Json now = read_metrics(directory);
    const std::string trouble = Twin(path, directory, command).compare(now);
    if (interrupted) return exit_interrupted;
    if (!trouble.empty()) tell(stderr, path + ": " + trouble);
    write_json(run_file(directory, "metrics.json"), now);
  }
  const bool as_written = command.scene.overrides.empty() && override_arguments(command).empty();
  auto failures = complete_metrics(script, path, directory, whole, as_written, studies, metrics, verdicts);
  if (whole && command.study.empty() && (command.figures || command.figure_scripts)) write_figures(script, directory, command.figures);
  for (const auto& trouble : studies.troubles) tell(stderr, trouble);
  for (const auto& message : failures) tell(stderr, message);
  if (whole && command.figures) draw_performance_point(script.scene(), directory, outcome);
  if (!command.output.quiet) print_summary(script.scene(), directory, metrics, verdicts, studies.troubles.size());
  if (!command.output.quiet && (status == "stopped" || status == "interrupted")) say("go on: {}\n", resume_line(directory));
  if (command.profile) say("{}", profile_text(outcome));
  int code = exit_code(script.scene(), command, outcome, metrics, verdicts);
  if (code == exit_ok && !(failures.empty() && studies.troubles.empty())) code = exit_usage;
  if (command.video && status != "interrupted") {
    std::vector<std::string> words{directory, "--video"};
    if (command.output.force) words.push_back("--force");
    if (command.output.quiet) words.push_back("--quiet");
    if (!command.figures) words.push_back("--no-figures");
    if (command.threads > 0) words.insert(words.end(), {"--threads", std::to_string(command.threads)});
    const int drawn = run_renderer(words);
    if (code == exit_ok) code = drawn;
  } else if (status != "interrupted" && command.figures) {
    draw_curves(directory);
  }
  return code;
}

// A full disk ends a run, and so does a folder that is taken away. With a checkpoint, the run can resume once there is room.
int no_room(const WriteError& trouble, const std::string& directory) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(run_file(directory, "manifest.json"), ignored)) {
    tell(stderr, fmt::format("{}: the folder was moved or removed during the run; if it was moved, go on from its last checkpoint with "
                             "erbs run DIR --resume, or start anew",
                             trouble.what()));
    return exit_usage;
  }
  const bool checkpoint = std::filesystem::is_regular_file(run_file(directory, "checkpoint.bin"), ignored);
  tell(stderr, fmt::format("{}; make room, or raise the limit that is reached, and {}", trouble.what(),
                           checkpoint ? "go on from the last checkpoint: " + resume_line(directory) : "start anew with --force"));
  return checkpoint ? exit_stopped : exit_usage;
}

}  // namespace

int verb_run(const RunCommand& wish) {
  if (wish.words.size() != 1) throw Error(fmt::format("run takes one scene, not {}; erbs test runs several", wish.words.size()));
  RunCommand command = with_kept_arguments(wish);
  // a path that begins with "-" would be an option to other programs
  const auto no_option = [](const std::string& name) { return name.starts_with("-") ? "./" + name : name; };
  const std::string path = no_option(command.words.front());
  if (command.video) check_programs({renderer_path(), "ffmpeg"});
  check_drawing(command);
  Script::Options how = script_options(command.scene, command.output.quiet);
  how.study = command.study;
  how.noise = command.changes.noise;
  how.quality = quality_of(command.changes);
  Script script(how);
  script.load(path, command.scene.overrides);
  Scene scene = script.take_scene();
  for (const auto& effect : command.changes.without) {
    for (const Effect& known : effects_of(scene))
      if (known.name == effect && !known.on)
        tell(stderr, fmt::format("warning: --without {}: the scene has no such effect", shown(effect)));
    switch_off(scene, effect);
  }
  std::vector<std::string> notes = script.output();
  notes.insert(notes.end(), scene.notes.begin(), scene.notes.end());
  for (const auto& note : apply_overrides(scene, command, script)) notes.push_back(note);
  if (!command.changes.settings.empty() || command.changes.push_to > 0)  // they pass the same checks as the scene
    if (const auto mistakes = check(scene); !mistakes.empty()) throw Errors(mistakes);
  for (const auto& warning : warnings(scene)) {
    tell(stderr, "warning: " + warning);
    notes.push_back("warning: " + warning);
  }
  if (scene.push.quasi_static() && command.until)
    throw Error("--until is a time, and a push has none; say analysis{ up_to = ... }, or leave it out", scene.push.place);
  if (scene.push.quasi_static() && command.twin)
    throw Error("--twin finds the time at which two runs part, and a push has none; leave it out, or take kind = \"dynamic\"",
                scene.push.place);
  const std::string directory = no_option(command.output.directory.empty() ? "runs/" + scene.name : command.output.directory);
  catch_interrupts();
  try {
    analysis::RunOutcome outcome;  // if only the studies of a finished run continue: its status alone
    if (command.resume && studies_left(script, directory)) {
      outcome.lock = std::make_shared<FolderLock>(directory);
      outcome.metrics.status = read_metrics(directory).value("status", "");
    } else {
      outcome = run_scene(std::move(scene), whole_text(path), notes, directory, command);
    }
    for (const auto& warning : outcome.warnings) tell(stderr, "warning: " + warning);
    if (!outcome.trouble.empty()) tell(stderr, path + ": " + outcome.trouble);
    return complete(script, path, directory, outcome, command);
  } catch (const WriteError& trouble) { return no_room(trouble, directory); }
}

}  // namespace erbs::lua
