// Runs of a scene, or of several, that differ by their settings, by the machinery of erbs sweep: a process each with limits of time and
// memory, rows with reasons, resume.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/study/sweep/sweep.h"

namespace erbs::lua {

struct SettingRuns {
  std::string directory;                                         // holds results.csv and runs.csv
  std::string identity;                                          // all that the runs depend on besides settings and keys
  std::vector<std::pair<std::string, study::Variant>> settings;  // by names of their own, in the order in which they begin
  std::vector<std::string> keys;                                 // wanted of metrics.json
  int jobs = 0;                                                  // runs at once; 0: one per processor
  double max_wall = 0, budget = 0;                               // s, wall clock of each run and of all; 0: no limit
  bool quiet = false;
};

struct SettingRow {
  bool done = false;                     // false: the time of all runs was over
  std::string status, reason;            // as in results.csv
  double cpu = 0, wall = 0, memory = 0;  // s of processor time, s, bytes
  std::map<std::string, double> values;  // of the keys that have a finite number
  bool answered() const { return status == "completed"; }
};

// Refuses a folder that exists without `resume` or `force`; with `force` removes the tables of its runs and `products`. Throws Error.
void prepare_settings_folder(const std::string& directory, bool resume, bool force, const std::vector<std::string>& products);

// Makes the runs that the folder does not hold yet. A row for each setting. Throws Interrupted.
std::vector<SettingRow> run_settings(const SettingRuns& runs);

}  // namespace erbs::lua
