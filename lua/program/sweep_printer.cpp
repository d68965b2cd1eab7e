#include "lua/program/sweep_printer.h"

#include <unistd.h>

#include <cstdio>

#include "engine/base/text.h"
#include "lua/program/progress.h"

namespace erbs::lua {

SweepPrinter::SweepPrinter(bool quiet, bool bisects) : quiet_(quiet), bisects_(bisects), live_(isatty(STDERR_FILENO) != 0) {}

void SweepPrinter::show(const study::Sweep::Progress& now) {
  if (quiet_) return;
  if (live_ && now.end) fmt::print(stderr, "\r\033[K");
  const auto time = std::chrono::steady_clock::now();
  if (now.end || (!live_ && time - told_ < std::chrono::seconds(10))) return;
  told_ = time;
  const std::string made = bisects_ ? fmt::format(" ({})", counted(now.runs, "run")) : "";
  const std::string text = fmt::format("{} of {}{}, {} failed{}", now.done, counted(now.points, bisects_ ? "point" : "run"), made,
                                       now.failed, now.left >= 0 ? ", about " + duration_text(now.left) + " left" : "");
  if (live_) fmt::print(stderr, "\r\033[K{}", text);
  else fmt::print(stderr, "{}\n", text);
}

}  // namespace erbs::lua
