// Time history of a scene: READ THIS FIRST. prepare -> start at rest -> step until the end -> metrics.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/record/metrics.h"
#include "engine/record/run_folder.h"
#include "engine/scene/scene.h"

namespace erbs {

struct Progress {
  double t = 0, duration = 0;  // s, simulated
  double wall = 0;             // s, of stepping so far
  long steps = 0;              // of this call
  int joints_broken = 0;
  double residual = 0;         // relative, of the energy ledger
};

struct RunOptions {
  std::string directory;
  std::vector<std::string> departures;  // words of the command line: a checkpoint goes on with the same ones only
  std::vector<std::string> notes;  // for the head of log.txt: what the script printed, the warnings of its check
  Existing existing = Existing::refuse;
  int threads = 1;
  std::optional<double> until;        // s, simulated: stop there with a checkpoint
  double max_wall = 0;                // s; 0: no limit
  double checkpoint_every = 60;       // s of wall time
  bool allow_unstable = false;
  double noise = 0, twin_noise = 0;   // m and rad, in the start of every block that may move; from one seed each
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(const Progress&)> progress;  // about ten times a second
};

struct RunOutcome {
  Metrics metrics;
  std::string trouble;       // what went wrong with the numbers, where, and which knob cures it
  std::vector<std::string> warnings;
  std::shared_ptr<const FolderLock> lock;  // no other run writes there while this is kept
};

// Throws Error or Errors before anything is written; afterwards always leaves a whole run folder.
// The scene's blocks are let go once the model is made of them.
RunOutcome run_dynamic(Scene scene, const std::string& script, const RunOptions& options);

}  // namespace erbs
