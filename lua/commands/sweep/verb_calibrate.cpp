// erbs calibrate STUDY.lua: params of a scene fitted to known values, by runs side by side.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/base/system/affinity.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"
#include "engine/study/calibrate/calibrate.h"
#include "engine/study/sweep/claims.h"
#include "lua/commands/sweep/sweep_study.h"
#include "lua/program/progress.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr const char* work_folder = "work";  // is there while a calibration is under way

// Makes the folder, or takes it up. Throws Error.
void prepare_folder(const SweepStudy& study, const CalibrateCommand& command) {
  const std::string& directory = study.sweep.directory;
  const bool there = fs::exists(directory) && !(fs::is_directory(directory) && fs::is_empty(directory));
  const std::string identity = directory + "/" + identity_file;
  if (there && !fs::exists(directory + "/" + study::calibration_table) && !fs::exists(identity))
    throw Error(fmt::format("\"{}\" exists and is no folder of a calibration; choose another folder with -o DIR", directory));
  if (there && !command.output.force && !command.resume)
    throw Error(
        fmt::format("\"{}\" exists; go on with --resume, replace it with --force, or choose another folder with -o DIR", directory));
  if (const std::string who = study::working_in(directory + "/" + work_folder); !who.empty())
    throw Error(
        fmt::format("\"{}\" is that of a calibration under way, by {} (host, process); end it first, or choose another folder with "
                    "-o DIR",
                    directory, who));
  if (there && command.output.force) {
    for (const char* file :
         {study::calibration_table, study::calibration_file, identity_file, "calibration.svg", "calibration.png", "runs", work_folder})
      fs::remove_all(directory + "/" + file);
  }
  if (there && !command.output.force) {
    const Json before = fs::exists(identity) ? read_json(identity) : Json::object();
    if (before.value("key", "") != study.sweep.key)
      throw Error(
          fmt::format("\"{}\" holds another calibration: its scene, its file or the program differ; choose another folder with "
                      "-o DIR, or replace it with --force",
                      directory));
  }
  fs::create_directories(directory);
  Json now = study.identity;
  now["key"] = study.sweep.key;
  write_json(identity, now);
}

std::string column_of(const study::Sweep& sweep, const std::string& param) {
  const std::vector<std::string> params = varied_params(sweep.plan);
  for (std::size_t i = 0; i < params.size(); ++i)
    if (params[i] == param) return sweep.params[i];
  return param;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const study::Sweep& sweep, const study::Calibrated& result) {
  const study::Calibration& calibration = *sweep.plan.calibration;
  Json out{{"program", program_version()}, {"scene", sweep.scene}, {"runs", result.runs}};
  out["values"] = Json::object();
  for (const auto& [param, value] : result.values) out["values"][param] = value;
  out["rms"] = number(result.rms), out["rms_before"] = number(result.rms_before);
  out["stages"] = Json::array();
  for (std::size_t i = 0; i < result.stages.size(); ++i) {
    const study::FittedStage& stage = result.stages[i];
    Json one{
        {"kind", stage.raised ? "raise" : "fit"}, {"converged", stage.converged}, {"rms", number(stage.rms)}, {"params", Json::array()}};
    if (stage.raised) one["key"] = calibration.stages[i].key, one["value"] = number(stage.key_value);
    if (stage.bracket) one["bracket"] = {stage.bracket->first, stage.bracket->second};
    for (const study::FittedParam& param : stage.params)
      one["params"].push_back(
          {{"param", param.param}, {"value", param.value}, {"deviation", number(param.deviation)}, {"at_end_of_range", param.at_end}});
    out["stages"].push_back(std::move(one));
  }
  out["targets"] = Json::array();
  std::size_t k = 0;
  for (const study::CalibrationTarget& target : calibration.targets)
    for (std::size_t i = 0; i < target.keys.size(); ++i, ++k)
      out["targets"].push_back({{"key", target.keys[i]},
                                {"wanted", target.values[i]},
                                {"got", number(result.got[k])},
                                {"got_before", number(result.got_before[k])},
                                {"residual", number((result.got[k] - target.values[i]) / target.scale)}});
  return out;
}

void print_stage(const study::Sweep& sweep, std::size_t i, const study::FittedStage& stage) {
  const study::CalibrationStage& asked = sweep.plan.calibration->stages[i];
  for (const study::FittedParam& param : stage.params) {
    std::string text = fmt::format("  stage {}: {} = {:.5g}", i + 1, column_of(sweep, param.param), param.value);
    if (stage.raised)
      text += fmt::format(", where {} = {:.3g} is below {:g}{}", asked.key, stage.key_value, asked.below,
                          stage.bracket ? fmt::format("; not yet at {:.5g}", stage.bracket->first) : " from the start");
    else if (std::isnan(param.deviation)) text += "; its deviation is unknown: there are no more known values than params";
    else if (!std::isfinite(param.deviation)) text += "; it moves no target";
    else text += fmt::format(" +- {:.2g}", param.deviation);
    if (!stage.raised && param.at_end) text += "; at the end of its range: a wider one may fit better";
    say("{}\n", text);
  }
  say("           rms of all residuals {:.3g} % of their scales{}\n", 100 * stage.rms,
      stage.converged ? "" : "; steps had not ended after the last round");
}

void print_targets(const study::Sweep& sweep, const study::Calibrated& result) {
  std::size_t k = 0;
  for (const study::CalibrationTarget& target : sweep.plan.calibration->targets) {
    say("  {}\n", target.label);
    for (std::size_t i = 0; i < target.keys.size(); ++i, ++k)
      say("    {:<24} wanted {:<12.6g} got {:<12.6g} residual {:+.2f} %\n", target.keys[i], target.values[i], result.got[k],
          100 * (result.got[k] - target.values[i]) / target.scale);
  }
}

void draw(const study::Sweep& sweep, const study::Calibrated& result) {
  try {
    if (can_start("gnuplot")) draw_calibration(sweep, result);
    else tell(stderr, "warning: calibration.svg needs gnuplot, which is not there; install the package gnuplot-nox");
  } catch (const std::exception& error) { tell(stderr, fmt::format("warning: calibration.svg could not be drawn: {}", error.what())); }
}

}  // namespace

int verb_calibrate(const CalibrateCommand& command) {
  const bool quiet = command.output.quiet;
  SweepStudy study = read_sweep_study(command.words.front(), command.scene, quiet, StudyKind::calibration);
  study::Sweep& sweep = study.sweep;
  sweep.directory = command.output.directory.empty() ? "runs/" + study.name : command.output.directory;
  if (sweep.directory.starts_with("-")) sweep.directory = "./" + sweep.directory;
  prepare_folder(study, command);
  const study::Claims worker(sweep.directory + "/" + work_folder);
  const std::atomic<bool>& interrupted = catch_interrupts();
  sweep.at_once = command.jobs > 0 ? command.jobs : usable_processors();
  sweep.interrupted = &interrupted;
  const bool live = isatty(STDERR_FILENO) != 0;
  if (!quiet && live)
    sweep.progress = [](const study::Sweep::Progress& now) {
      fmt::print(stderr, "\r\033[K{}, {} failed", counted(now.runs, "run"), now.failed);
    };
  const auto begin = std::chrono::steady_clock::now();
  const study::Calibrated result = calibrate(sweep, command.resume);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!quiet && live) fmt::print(stderr, "\r\033[K");
  if (result.interrupted) {
    tell(stderr, fmt::format("interrupted after {}; continue with --resume", counted(result.runs, "run")));
    return exit_interrupted;
  }
  write_json(sweep.directory + "/" + study::calibration_file, json_of(sweep, result));
  draw(sweep, result);
  if (result.discarded > 0)
    tell(stderr, fmt::format("warning: {} of {} runs do not give all targets and are left out of the fit; the first, {}; see {}/{}",
                             result.discarded, result.runs, result.first_discarded, sweep.directory, study::calibration_table));
  if (quiet) return exit_ok;
  say("{}: {} in {}\n", study.name, counted(result.runs, "run"), duration_text(wall));
  for (std::size_t i = 0; i < result.stages.size(); ++i) print_stage(sweep, i, result.stages[i]);
  print_targets(sweep, result);
  say("{}/{}\n", sweep.directory, study::calibration_file);
  return exit_ok;
}

}  // namespace erbs::lua
