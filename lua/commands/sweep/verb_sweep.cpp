// erbs sweep STUDY.lua: many runs of a scene, on one machine, under mpirun or as a job array.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "engine/base/system/affinity.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "engine/study/fragility/fragility.h"
#include "engine/study/machine.h"
#include "engine/study/sweep/claims.h"
#include "engine/study/sweep/ranks.h"
#include "engine/study/sweep/study_folder.h"
#include "engine/study/sweep/sweep_figure.h"
#include "lua/commands/sweep/sweep_study.h"
#include "lua/program/child.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"
#include "lua/program/sweep_printer.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr const char* files_of_sweep[] = {identity_file, "job.sh", "job_logs"};  // besides its tables and runs

std::string in(const std::string& directory, const char* file) { return directory + "/" + file; }

bool is_sweep_folder(const std::string& directory) {
  if (study::holds_tables(directory)) return true;
  try {
    return read_json(in(directory, identity_file)).contains("key");
  } catch (const std::exception&) { return false; }  // missing, or of another program
}

bool is_figure(const fs::path& file) {
  return file.stem().string().starts_with(study::results_stem) && (file.extension() == ".svg" || file.extension() == ".png");
}

void remove_sweep(const std::string& directory) {
  study::remove_tables(directory);
  for (const char* file : files_of_sweep) fs::remove_all(in(directory, file));
  for (const char* file : study::fragility_files) fs::remove_all(in(directory, file));
  std::vector<fs::path> figures;
  for (const auto& entry : fs::directory_iterator(directory))
    if (is_figure(entry.path())) figures.push_back(entry.path());
  for (const fs::path& figure : figures) fs::remove(figure);
}

// The part of the identity in which two studies differ, in words.
std::string difference(const Json& before, const Json& now) {
  if (before.value("program", "") != now.value("program", ""))
    return fmt::format("it was begun by {}, this is {}", before.value("program", ""), now.value("program", ""));
  if (before.value("scene", "") != now.value("scene", "")) return fmt::format("its scene is {}", before.value("scene", ""));
  if (before.value("inputs", Json()) != now.value("inputs", Json())) return "the scene, or a file that it reads, has changed";
  if (before.value("given", Json()) != now.value("given", Json())) return "its params by -D are others";
  return "its values, bisect or collect are others";
}

// Makes the folder, or takes it up. Throws Error.
void prepare_folder(const SweepStudy& study, const SweepCommand& command, const study::Ranks& ranks) {
  const std::string& directory = study.sweep.directory;
  const bool there = fs::exists(directory) && !(fs::is_directory(directory) && fs::is_empty(directory));
  if (there && !is_sweep_folder(directory))
    throw Error(fmt::format("\"{}\" exists and is no folder of a sweep; choose another folder with -o DIR", directory));
  if (there && !command.output.force && !command.resume)
    throw Error(
        fmt::format("\"{}\" exists; go on with --resume, replace it with --force, or choose another folder with -o DIR", directory));
  if (there && command.output.force) {
    if (const std::string who = study::working_in(in(directory, "work")); !who.empty())
      throw Error(
          fmt::format("\"{}\" is that of a sweep under way, by {} (host, process); end it first, join it with --resume, or choose "
                      "another folder with -o DIR",
                      directory, who));
    remove_sweep(directory);
  }
  fs::create_directories(directory);
  const std::string identity = in(directory, identity_file);
  Json now = study.identity;
  now["key"] = study.sweep.key;
  now["title"] = study.sweep.plan.title;  // of its figures and its page; it changes no result, and is no part of the key
  if (fs::exists(identity)) {
    const Json before = read_json(identity);
    if (before.value("key", "") != study.sweep.key)
      throw Error(
          fmt::format("\"{}\" holds the results of another study: {}; choose another folder with -o DIR, or replace it with --force",
                      directory, difference(before, now)));
    if (ranks.launch.empty() && before.value("title", "") == now.value("title", "")) return;
  }
  now["launch"] = ranks.launch;
  write_json(identity, now);
}

// A rank other than the first waits until that one has prepared the folder.
void await_folder(const SweepStudy& study, const study::Ranks& ranks) {
  const std::string identity = in(study.sweep.directory, identity_file);
  for (int i = 0; i < 1200; ++i) {
    try {
      const Json there = fs::exists(identity) ? read_json(identity) : Json::object();
      if (there.value("key", "") == study.sweep.key && there.value("launch", "") == ranks.launch) return;
    } catch (const std::exception&) {}  // it is being written
    if (is_interrupted()) throw Interrupted("interrupted");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw Error(fmt::format("rank 0 did not prepare \"{}\" within a minute; see its message, and whether all ranks see one folder",
                          study.sweep.directory));
}

// A job array whose tasks share the study. Each takes the points that nobody has taken, whatever its number.
int write_job(const SweepStudy& study, const SweepCommand& command) {
  const study::Plan& plan = study.sweep.plan;
  const std::int64_t points = point_count(plan);
  const std::int64_t tasks = std::min<std::int64_t>(points, command.jobs > 0 ? command.jobs : 100);
  const std::string directory = fs::absolute(study.sweep.directory).lexically_normal().string();
  std::vector<std::string> words{
      own_path(), "sweep", fs::absolute(command.words.front()).lexically_normal().string(), "-o", directory, "--resume", "-j", "1"};
  for (const auto& [name, expression] : command.scene.overrides) words.insert(words.end(), {"-D", name + "=" + expression});
  for (const std::string& word : permissions(command.scene)) words.push_back(word);
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_quoted(word);
  std::string text = fmt::format(
      "#!/bin/sh\n# {} points of {} in {} tasks. Submit it by: sbatch {}\n# A task that dies is no loss: submit the script again. "
      "results.csv "
      "is complete and sorted once the last task has ended.\n",
      points, study.name, tasks, shell_word(directory + "/job.sh"));
  text += fmt::format("#SBATCH --job-name={}\n#SBATCH --array=0-{}\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n", file_stem(study.name),
                      tasks - 1);
  text += fmt::format("#SBATCH --output={}\n", shell_word(directory + "/job_logs/%a.log"));
  if (plan.memory > 0) text += fmt::format("#SBATCH --mem={:.0f}M\n", plan.memory / 1e6 + 200);
  text += "exec " + line + " --quiet\n";
  fs::create_directories(directory + "/job_logs");
  write_text_atomically(directory + "/job.sh", text);
  ::chmod((directory + "/job.sh").c_str(), 0755);
  say("{} in {}: sbatch {}\n", counted(points, "point"), counted(tasks, "task"), shell_word(directory + "/job.sh"));
  return exit_ok;
}

// A figure that cannot be drawn is no failure of the study.
void draw(const study::Sweep& sweep) {
  try {
    if (can_start("gnuplot")) draw_results(sweep);
    else tell(stderr, "warning: results.svg needs gnuplot, which is not there; install the package gnuplot-nox");
  } catch (const std::exception& error) { tell(stderr, fmt::format("warning: results.svg could not be drawn: {}", error.what())); }
}

// The fragility of a finished study: tables, figures, and a line for each fit.
void tell_fragility(const study::Sweep& sweep, bool quiet) {
  const std::vector<study::Group> groups = read_groups(sweep);
  const std::vector<study::Fragility> found = write_fragility(sweep, groups);
  for (const study::Fragility& one : found) {
    if (quiet) break;
    const study::Fit& fit = one.fit;
    const std::string name = fmt::format("fragility{} by {} ({} of {} collapse)", one.group.empty() ? "" : " of " + one.group, one.method,
                                         fit.collapsed, fit.observations);
    if (fit.end == study::FitEnd::fitted)
      say("{}: median {} = {:.4g} [{:.4g}, {:.4g}], dispersion {:.3f} [{:.3f}, {:.3f}]{}\n", name, unit_of_im(sweep), fit.theta,
          fit.theta_lo, fit.theta_hi, fit.beta, fit.beta_lo, fit.beta_hi, one.words.empty() ? "" : "; " + one.words);
    else say("{}: {}\n", name, one.words);
  }
  try {
    if (can_start("gnuplot")) draw_fragility(sweep, groups, found);
    else tell(stderr, "warning: fragility.svg needs gnuplot, which is not there; install the package gnuplot-nox");
  } catch (const std::exception& error) { tell(stderr, fmt::format("warning: fragility.svg could not be drawn: {}", error.what())); }
}

int finish(const SweepStudy& study, const study::Swept& swept, const study::Ranks& ranks, double wall, bool quiet) {
  const std::string results = in(study.sweep.directory, study::results_file);
  if (swept.interrupted) {
    tell(stderr, fmt::format("interrupted; {} of {} points are done: continue with --resume{}", swept.done, swept.points,
                             ranks.size > 1 ? " (if a rank died: under mpirun --enable-recovery the other ranks go on)" : ""));
    return exit_interrupted;
  }
  if (!swept.first_failure.empty())
    tell(stderr, fmt::format("{} of {} points failed; the first: {}", swept.failed, swept.points, swept.first_failure));
  if (swept.complete()) draw(study.sweep);
  if (swept.complete() && study.sweep.plan.fragility) tell_fragility(study.sweep, quiet);
  if (!quiet && swept.inherited > 0)
    tell(stderr, fmt::format("{} points of processes that had died were taken up and finished", swept.inherited));
  if (!quiet) {
    say("{}: {} of {} done, {} failed; {} here in {}\n{}\n", study.name, swept.done, counted(swept.points, "point"), swept.failed,
        counted(swept.runs, "run"), duration_text(wall), results);
    if (!swept.complete()) say("other processes work on the rest; --resume collects it\n");
  }
  return swept.failed > 0 ? exit_numbers : exit_ok;
}

}  // namespace

int verb_sweep(const SweepCommand& command) {
  const study::Ranks ranks = study::ranks_of_environment();
  const bool first = ranks.rank == 0;
  SweepStudy study;
  try {
    study = read_sweep_study(command.words.front(), command.scene, !first || command.output.quiet);
  } catch (const std::exception&) {
    if (first) throw;
    return exit_usage;  // rank 0 says why
  }
  study::Sweep& sweep = study.sweep;
  sweep.directory = command.output.directory.empty() ? "runs/" + study.name : command.output.directory;
  if (sweep.directory.starts_with("-")) sweep.directory = "./" + sweep.directory;
  const std::atomic<bool>& interrupted = catch_interrupts();
  if (first) prepare_folder(study, command, ranks);
  else await_folder(study, ranks);
  if (command.slurm) return first ? write_job(study, command) : exit_ok;
  sweep.at_once = command.jobs > 0 ? command.jobs : ranks.launched ? 1 : usable_processors();
  if (sweep.plan.memory <= 0) sweep.plan.memory = study::machine_memory() / (sweep.at_once * ranks.here);
  sweep.begin_at = double(ranks.rank) / ranks.size;
  sweep.wait = !ranks.array_task;
  sweep.interrupted = &interrupted;
  SweepPrinter printer(command.output.quiet || !first, sweep.plan.bisect.has_value());
  sweep.progress = [&](const study::Sweep::Progress& now) { printer.show(now); };
  const auto begin = std::chrono::steady_clock::now();
  const study::Swept swept = carry_out(sweep);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!first) return swept.interrupted ? exit_interrupted : exit_ok;
  return finish(study, swept, ranks, wall, command.output.quiet);
}

}  // namespace erbs::lua
