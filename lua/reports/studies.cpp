#include "lua/reports/studies.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "engine/base/hash.h"
#include "engine/record/folder/run_folder.h"
#include "engine/study/children.h"
#include "lua/program/progress.h"

namespace erbs::lua {
namespace {

std::string key_of(const Scene& scene) {
  std::string text;
  for (const auto& [file, hash] : scene.inputs) text += file + " " + hash + "\n";
  return hash_text(text);
}

}  // namespace

StudiesOutcome run_studies(const Script& script, const std::string& path, const std::string& directory, const RunCommand& command,
                           const std::atomic<bool>& interrupted) {
  StudiesOutcome out;
  study::Children children{path,
                           directory,
                           key_of(script.scene()),
                           command.scene.overrides,
                           override_arguments(command),
                           permissions(command.scene),
                           command.max_wall.value_or(0),
                           command.threads,
                           &interrupted};
  if (isatty(STDERR_FILENO) != 0 && !command.output.quiet)
    children.progress = [](const study::Children::Progress& now) {
      fmt::print(stderr, "\r\033[K{}: {} of {} runs, {} failed, about {} left", now.study, now.done, now.asked, now.failed,
                 duration_text(now.wall / std::max(1, now.done) * (now.asked - now.done)));
    };
  for (const study::Study& study : script.studies()) {
    const study::Carried carried = carry_out(study, children);
    if (children.progress) fmt::print(stderr, "\r\033[K");
    if (carried.interrupted) {
      out.interrupted = true;
      return out;
    }
    for (const auto& [name, value] : carried.result.metrics) out.metrics[name] = value ? Json(*value) : Json(nullptr);
    out.updates += carried.result.updates;
    if (!carried.result.trouble.empty()) out.troubles.push_back(carried.result.trouble);
  }
  return out;
}

bool studies_left(const Script& script, const std::string& directory) {
  const std::string metrics = run_file(directory, "metrics.json");
  if (script.studies().empty() || !is_run_folder(directory) || !std::filesystem::exists(metrics)) return false;
  const std::string status = read_json(metrics).value("status", "");
  return status == "completed" || status == "inaccurate";
}

}  // namespace erbs::lua
