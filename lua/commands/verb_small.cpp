// Short verbs: render and version. Also the parsers of durations and shares for all verbs.
#include <cmath>
#include <cstdio>

#include "engine/base/system/interrupt.h"
#include "engine/base/text.h"
#include "engine/record/folder/manifest.h"
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
