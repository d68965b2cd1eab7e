// Progress of a run: one line that is updated on a terminal, otherwise a new line every 10 s.
#pragma once
#include <chrono>
#include <string>

#include "engine/analysis/dynamic.h"

namespace erbs::lua {

class ProgressPrinter {
 public:
  ProgressPrinter(bool quiet, bool json);
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;
  void show(const analysis::Progress& now);  // cheap to call often: prints only when a line is due
  void end();                                // clears the line on a terminal

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, json_, terminal_, open_ = false, starting_ = false;
  Clock::time_point begin_, due_, last_;
  double first_time_ = -1, last_time_ = 0;  // s, simulated: a resumed run does not begin at zero
  double recent_ = -1;                      // simulated s per s, recent average; below zero: unknown
  long first_steps_ = 0, last_steps_ = 0;
};

std::string duration_text(double seconds);  // "3.2 s", "4 min 05 s", "2 h 10 min"
bool colors(int file);                      // the output is a terminal and NO_COLOR is not set

}  // namespace erbs::lua
