// Runs of a study as processes of this program, side by side, one thread each; a run that is finished is not run again.
#pragma once
#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "engine/study/study.h"

namespace erbs {

struct Children {
  std::string scene;      // path of the script
  std::string directory;  // run folder of the scene: children go to studies/NAME/, the table to studies/NAME.csv
  std::string key;        // of the scene and all it reads: a finished child of another key is run again
  std::vector<std::pair<std::string, std::string>> overrides;  // -D of the run that asks
  std::vector<std::string> words = {};                         // its other words: --points 4
  std::vector<std::string> permissions = {};                   // and those that let it read: --allow DIR
  double max_wall = 0;                                         // s, of each run; 0: none
  int at_once = 0;                                             // 0: as many as the machine has processors
  const std::atomic<bool>* interrupted = nullptr;
  std::function<void(const std::string& study, int done, int asked)> progress = {};
};

struct Carried {
  StudyResult result;
  bool interrupted = false;
};

Carried carry_out(const Study& study, const Children& children);

}  // namespace erbs
