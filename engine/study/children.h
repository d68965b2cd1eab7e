// Runs of a study as child processes of this program, in parallel, one thread each, with limits of time and memory. A run that fails is
// a row with its reason. A finished run is not repeated.
#pragma once
#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "engine/study/study.h"

namespace erbs::study {

struct Children {
  std::string scene;      // path of the script
  std::string directory;  // run folder of the scene: children write to studies/NAME/, the table is studies/NAME.csv
  std::string key;        // hash of the scene and all files it reads: a finished child with another key is repeated
  std::vector<std::pair<std::string, std::string>> overrides;  // -D of the calling run
  std::vector<std::string> words = {};                         // its other arguments: --points 4
  std::vector<std::string> permissions = {};                   // arguments that allow reading: --allow DIR
  double max_wall = 0;                                         // s, limit of each run; 0: none
  int at_once = 0;                                             // runs in parallel; 0: one per processor
  const std::atomic<bool>* interrupted = nullptr;
  struct Progress {
    std::string study;
    int done = 0, asked = 0, failed = 0;  // runs made now; a bisection asks for more as it goes on
    double wall = 0;                      // s so far
  };
  std::function<void(const Progress&)> progress = {};
};

struct Carried {
  StudyResult result;
  bool interrupted = false;
};

Carried carry_out(const Study& study, const Children& children);

}  // namespace erbs::study
