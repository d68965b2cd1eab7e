// Time history of a scene: READ THIS FIRST. The phases: prepare -> start at rest -> step until the end -> metrics.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/analysis/start/ramp.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/results/metrics.h"
#include "engine/scene/scene.h"
#include "engine/solve/profile.h"

namespace erbs::analysis {

struct Progress {
  double t = 0, duration = 0;  // s, simulated
  double wall = 0;             // s, of stepping until now
  long steps = 0;              // steps of this call
  int joints_broken = 0;
  double residual = 0;          // relative, of the energy ledger
  double dt = 0;                // s, of the present step
  std::string limited_by = {};  // what keeps it from being longer
  std::string line = {};        // what to show instead of time, of which the start and a push have none
  bool starting = false;        // before the first step
};

struct RunOptions {
  std::string directory;
  std::vector<std::string> override_arguments;  // command-line overrides; a checkpoint accepts only the same ones
  std::string scene_path;                       // absolute, for manifest.json, by which a run is resumed; "" for a scene without a file
  std::vector<std::string> arguments;           // other options of the command line that a resumption needs
  std::vector<std::string> notes;               // for the head of log.txt: output of the script, warnings of its check
  Existing existing = Existing::refuse;
  int threads = 1;
  std::optional<double> until;   // s, simulated: stop there and write a checkpoint
  double max_wall = 0;           // s; 0: no limit
  double checkpoint_every = 60;  // s of wall time
  bool allow_unstable = false;
  double noise = 0, twin_noise = 0;  // m and rad, perturbation of every movable block at the start; each from its seed
  unsigned noise_seed = 1;           // of `noise`
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(const Progress&)> progress;  // about ten calls per second
};

struct RunOutcome {
  Metrics metrics;
  Profile profile;
  std::vector<std::string> limits;  // what limited the step, most frequent first: "87 % contacts of south.c03.b04"
  std::string trouble;              // error in the numbers: its place and the setting that cures it
  std::vector<std::string> warnings;
  std::shared_ptr<const FolderLock> lock;  // while it is held, no other run writes to the folder
};

// What is told while a structure comes to rest before the first step. Throws Error once the run has lasted longer than it may: nothing is
// written yet. `born`: when it began, by seconds().
StartTold told_at_start(const RunOptions& options, double born);

// Divides `solve`, less `search`, among its phases.
void divide_solving(Metrics::Wall& wall, const Profile& profile);

struct Prepared;
// manifest.json of a run that is ready to start.
Manifest manifest_of_run(const Scene& scene, const std::string& script, const Prepared& run, const RunOptions& options);

// Throws Error or Errors before anything is written. Afterwards it always leaves a complete run folder. The scene's blocks are freed once
// the model exists.
RunOutcome run_dynamic(Scene scene, const std::string& script, const RunOptions& options);

}  // namespace erbs::analysis
