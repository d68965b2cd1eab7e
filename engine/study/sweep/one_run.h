// One run of a sweep: its command, and what it answered.
#pragma once
#include <string>
#include <vector>

#include "engine/study/pool.h"
#include "engine/study/sweep/sweep.h"

namespace erbs::study {

struct RunRow {
  double x = 0;                          // value of the bisected param
  std::vector<std::string> values;       // cells of Plan::collect: numbers, true or false, words; "nan" without a value
  std::string verdict;                   // of a bisection: 0 or 1; "nan" without an answer
  std::string status;                    // completed, inaccurate, diverged, stopped, timeout, memory, crash, error
  std::string reason;                    // why there is no result; "" otherwise
  double wall = 0, cpu = 0, memory = 0;  // s, s, bytes
  bool answered() const { return status == "completed"; }
};

// The folder of a run without DIR/runs/; `run`: its number among those that a bisection asks for at the point.
std::string place_of(const Sweep& sweep, std::int64_t point, std::size_t run);
std::string scene_of(const Sweep& sweep, const Point& point);  // path of the script that the point runs
Job job_of(const Sweep& sweep, const Point& point, double x, const std::string& place);
RunRow read_run(const Sweep& sweep, const Point& point, double x, const std::string& place, const Finished& finished);
// Removes what Plan::keep does not ask for.
void tidy(const Sweep& sweep, const RunRow& row, const std::string& place);

}  // namespace erbs::study
