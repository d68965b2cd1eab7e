// A sweep: many runs of one scene, each a process, by this process and any others that share its folder. A run that fails is a row with its
// reason. A sweep that is killed continues where it stood.
#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/study/sweep/design.h"

namespace erbs::study {

// A way to run a scene that is no value of a param: other arguments of erbs run, or another scene.
struct Variant {
  std::string scene;                   // path of the script; "": that of the sweep
  std::vector<std::string> arguments;  // of erbs run
};

struct Sweep {
  Plan plan;
  std::string scene;                           // path of the script
  std::map<std::string, Variant> variants;     // by the values of the axis `variant`
  std::string directory;                       // holds results.csv, runs.csv, runs/ and, while it is under way, work/
  std::string key;                             // hash of the plan, the scene and all it reads, and the program
  std::vector<std::string> arguments;          // of every run: --allow DIR, -D name=value of params that do not vary
  std::vector<std::string> params, collected;  // column names with units: of varied params, of Plan::collect
  std::string bisected;                        // of the bisected param; "" without one
  int at_once = 0;                             // runs in parallel; 0: one per processor
  double budget = 0;                           // s, wall clock of all runs; runs that do not fit stay undone; 0: no limit
  double begin_at = 0;                         // share of the points at which this process begins, so that processes rarely meet
  bool wait = true;                            // stay until points that other processes work on are done
  const std::atomic<bool>* interrupted = nullptr;
  struct Progress {
    std::int64_t points = 0, done = 0, failed = 0;  // of the study
    std::int64_t runs = 0;                          // made by this process
    double left = -1;                               // s; below zero: unknown
    bool end = false;
  };
  std::function<void(const Progress&)> progress = {};  // called about twice a second, and at the end
};

struct Swept {
  std::int64_t points = 0, done = 0, failed = 0, runs = 0;
  std::int64_t inherited = 0;  // points of processes that died, taken up by this one
  std::string first_failure;   // "row 12: diverged: ..."
  bool interrupted = false;    // runs that did not fit into the budget are just not done
  bool complete() const { return done == points; }
};

// Names of the files in the folder of a sweep.
constexpr const char* results_file = "results.csv";
constexpr const char* runs_file = "runs.csv";

Swept carry_out(const Sweep& sweep);

}  // namespace erbs::study
