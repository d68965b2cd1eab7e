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

// Without keys: that of the last spectrum.
int verb_capacity(const CapacityCommand& command) {
  const std::string& dir = command.words.front();
  if (!is_run_folder(dir)) throw Error(fmt::format("{} is no run folder; name the one of a pushover", shown(dir, 200)));
  if (command.words.size() == 1) {
    const std::string last = run_file(dir, "performance.json");
    if (!std::filesystem::is_regular_file(last))
      throw Error("no spectrum has been applied to this run; add one: 'kind = \"EN 1998-1 type 1\", ground = \"B\", ag = 0.2*g'", {dir});
    say("{}\n", performance_text(read_json(last)));
    return exit_ok;
  }
  Script script;
  const PerformanceDemand demand = script.load_spectrum(command.words[1], "spectrum");
  const FolderLock lock(dir);
  Performance performance;
  try {
    performance = evaluate_performance(dir, demand);
  } catch (const Error& mistake) {
    if (!mistake.place.file.empty()) throw;
    throw Error(mistake.what(), {dir});
  }
  if (!command.quiet) say("{}\n", performance_text(to_json(performance)));
  if (!command.figures) return exit_ok;
  if (can_start("gnuplot")) draw_performance(dir, performance, demand.spectrum, std::filesystem::canonical(dir).filename().string());
  else tell(stderr, "warning: performance.svg needs gnuplot, which is not there; install the package gnuplot-nox");
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
