// Progress of many runs: one line that is updated on a terminal, otherwise a new line every 10 s.
#pragma once
#include <chrono>

#include "engine/study/sweep/sweep.h"

namespace erbs::lua {

class SweepPrinter {
 public:
  SweepPrinter(bool quiet, bool bisects);
  void show(const study::Sweep::Progress& now);  // runs or points done, failed, and the time left

 private:
  bool quiet_, bisects_, live_;
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
};

}  // namespace erbs::lua
