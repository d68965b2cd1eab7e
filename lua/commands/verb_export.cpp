// erbs export DIR: a run as files of other programs, in DIR/export.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/text.h"
#include "engine/record/export/export.h"
#include "engine/record/results/curves.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

// The frame nearest to --at; the last one without it.
int frame_at(const ExportedRun& run, double at) {
  if (std::isnan(at)) return static_cast<int>(run.frames.size()) - 1;
  const double first = run.frames.front().t, last = run.frames.back().t;
  if (at < first - 1e-3 || at > last + 1e-3)
    throw Error(fmt::format("--at {} is not within the frames exported, from {:.6g} s to {:.6g} s", at, first, last));
  int nearest = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    if (std::fabs(run.frames[i].t - at) < std::fabs(run.frames[static_cast<std::size_t>(nearest)].t - at)) nearest = static_cast<int>(i);
  return nearest;
}

// Each once, in the order of the command line.
std::vector<std::string> formats_of(const ExportCommand& command) {
  std::vector<std::string> formats;
  for (const std::vector<std::string>* some : {&command.formats, &command.short_forms})
    for (const std::string& format : *some)
      if (std::ranges::find(formats, format) == formats.end()) formats.push_back(format);
  return formats.empty() ? std::vector<std::string>{"gltf"} : formats;
}

// Formats that hold joints say nothing of forces that the run has not kept.
void tell_missing_tractions(const ExportCommand& command, const std::vector<std::string>& formats, const ExportedRun& run) {
  const auto holds_joints = [](const std::string& format) { return format == "vtu" || format == "xdmf" || format == "hdf5"; };
  if (command.output.quiet || run.scene.joints.empty() || !run.frames.front().normal_stress.empty()) return;
  if (std::ranges::any_of(formats, holds_joints))
    say("joints have damage and opening, no tractions: the run kept none; analysis{{ frame_stress = true }} keeps them\n");
}

void tell_missing_times(const TimeSpan& span, const ExportedRun& run) {
  const double slack = 1e-6 + run.manifest.frame_dt;  // the last frame may fall short of the duration by one
  const bool before = std::isfinite(span.from) && span.from < run.first - slack,
             after = std::isfinite(span.to) && span.to > run.last + slack;
  if (before || after)
    tell(stderr, fmt::format("warning: --time {:g}:{:g} reaches beyond the run, which has frames from {:.6g} s to {:.6g} s; only these are "
                             "written",
                             span.from, span.to, run.first, run.last));
}

// What one format writes first; the others of its files lie beside it.
std::string target(const fs::path& folder, const std::string& stem, const std::string& format) {
  const std::string ending = format == "gltf" ? ".glb" : format == "vtu" ? ".pvd" : format == "hdf5" ? ".h5" : "." + format;
  return (folder / (stem + ending)).string();
}

}  // namespace

int verb_export(const ExportCommand& command) {
  if (command.words.size() != 1)
    throw Error(fmt::format("export takes one run folder, not {}; e.g. erbs export runs/first", command.words.size()));
  const std::string& dir = command.words.front();
  const std::vector<std::string> formats = formats_of(command);
  if (!std::isnan(command.at) && std::ranges::find(formats, "obj") == formats.end())
    throw Error(
        fmt::format("--at {} chooses the instant of an OBJ file, and none is asked for; add --format obj, or cut a span of time with "
                    "--time",
                    command.at));
  const TimeSpan span = command.time.empty() ? TimeSpan{} : time_span_of(command.time);
  const ExportedRun run = read_exported_run(dir, span.from, span.to, command.every);
  tell_missing_times(span, run);
  const fs::path folder = command.output.directory.empty() ? fs::path(dir) / "export" : fs::path(command.output.directory);
  const std::string stem = file_stem(run.manifest.scene_name);
  const int instant = frame_at(run, command.at);
  for (const std::string& format : formats)
    if (const std::string path = target(folder, stem, format); !command.output.force && fs::exists(path))
      throw Error("it exists already; --force writes it anew", {path, 0});
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error("the folder cannot be made; may you write there? choose another with -o DIR", {folder.string(), 0});
  for (const std::string& format : formats) {
    const std::string path = target(folder, stem, format);
    const std::vector<std::string> paths = format == "gltf"   ? write_gltf(run, path)
                                           : format == "vtu"  ? write_vtu(run, (folder / stem).string())
                                           : format == "hdf5" ? write_hdf5(run, path)
                                           : format == "xdmf" ? write_xdmf(run, path)
                                           : format == "obj"  ? write_obj(run, instant, path)
                                                              : write_pose_table(run, path);
    std::uintmax_t bytes = 0;
    for (const std::string& one : paths) bytes += fs::file_size(one);
    if (!command.output.quiet)
      say("{:<5} {} ({}, {}, {:.3g} MB)\n", format, shown(path, 400), counted(run.scene.blocks.size(), "block"),
          format == "obj" ? fmt::format("at {:.4g} s", run.frames[static_cast<std::size_t>(instant)].t)
                          : counted(run.frames.size(), "frame"),
          1e-6 * static_cast<double>(bytes));
  }
  tell_missing_tractions(command, formats, run);
  return exit_ok;
}

}  // namespace erbs::lua
