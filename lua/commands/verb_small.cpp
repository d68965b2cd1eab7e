// Short verbs: render, version, and capacity, the performance point of a finished pushover. Also the parsers of durations and shares for
// all verbs.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "engine/base/system/interrupt.h"
#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/performance/performance_figure.h"
#include "engine/record/performance/performance_folder.h"
#include "lua/program/child.h"
#include "lua/program/options.h"
#include "lua/program/output_path.h"
#include "lua/program/say.h"

namespace erbs::lua {

int verb_render(const std::vector<std::string>& words) {
  if (words.empty()) throw Error("render takes a run folder; write erbs render DIR");
  catch_interrupts();  // the interrupt is passed on to erbs-render
  return run_renderer(words);
}

int verb_version() {
  say("erbs {}\n", program_version());
  return exit_ok;
}

// Without keys: that of the scene's own spectrum. Of another one in files of their own, since those of the run belong to its metrics.
int verb_capacity(const CapacityCommand& command) {
  const std::string& dir = command.words.front();
  if (!is_run_folder(dir)) throw Error(fmt::format("{} is no run folder; name the one of a pushover", shown(dir, 200)));
  if (command.words.size() == 1) {
    read_base_shear_curve(dir);  // that a run is no pushover is the first mistake to name
    if (!std::filesystem::is_regular_file(own_performance(dir)))
      throw Error(
          "this run has no performance point of its own; give a spectrum: 'kind = \"EN 1998-1 type 1\", ground = \"B\", ag = 0.2*g'",
          {dir});
    say("{}\n", performance_text(read_json(own_performance(dir))));
    return exit_ok;
  }
  Script script;
  const PerformanceDemand demand = script.load_spectrum(command.words[1], "spectrum");
  const std::string path =
      output_path(command.output, performance_of_spectrum(dir, demand.spectrum), "the file of a performance point", {".json"});
  const std::string picture = std::filesystem::path(path).replace_extension(".svg").string();
  const FolderLock lock(dir);
  Performance performance;
  try {
    performance = evaluate_performance(dir, demand, path);
  } catch (const Error& mistake) {
    if (!mistake.place.file.empty()) throw;
    throw Error(mistake.what(), {dir});
  }
  const bool drawn = command.figures && can_start("gnuplot");
  if (drawn) draw_performance(picture, performance, demand.spectrum, std::filesystem::canonical(dir).filename().string());
  else if (command.figures) tell(stderr, "warning: the picture needs gnuplot, which is not there; install the package gnuplot-nox");
  if (!command.output.quiet)
    say("{}\nresults in {}{}\n", performance_text(to_json(performance)), shown(path, 400), drawn ? " and " + shown(picture, 400) : "");
  return exit_ok;
}

double seconds_of(const std::string& text, const std::string& option) {
  size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {}
  const std::string unit = text.substr(std::min(used, text.size()));
  const double factor = unit.empty() || unit == "s" ? 1 : unit == "ms" ? 1e-3 : unit == "m" || unit == "min" ? 60 : unit == "h" ? 3600 : 0;
  if (value < 0 && used > 0)
    throw Error(fmt::format("{} {}: not a length of time, which is never negative; write 90s, 30m or 1.5h", option, shown(text)));
  if (!(value >= 0) || !std::isfinite(value) || factor == 0)
    throw Error(fmt::format("{} {}: not a length of time; write 90s, 30m or 1.5h", option, shown(text)));
  return value * factor;
}

double share_of(const std::string& text, const std::string& option) {
  size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {}
  const std::string unit = text.substr(std::min(used, text.size()));
  if (!(value > 0) || !std::isfinite(value) || (unit != "%" && !unit.empty()))
    throw Error(fmt::format("{} {}: not a share above zero; write 1% or 0.01", option, text));
  return unit == "%" ? value / 100 : value;
}

}  // namespace erbs::lua
