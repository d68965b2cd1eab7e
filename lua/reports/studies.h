// Studies of a scene; they run after the scene's own run.
#pragma once
#include <atomic>
#include <string>

#include "engine/record/format/json.h"
#include "lua/program/options.h"

namespace erbs::lua {

struct StudiesOutcome {
  Json metrics = Json::object();      // by name, to be merged with the metrics of the scene
  std::vector<std::string> troubles;  // reasons why studies have no value
  double updates = 0;                 // contact points that their runs evaluated
  bool interrupted = false;
};

StudiesOutcome run_studies(const Script& script, const std::string& path, const std::string& directory, const RunCommand& command,
                           const std::atomic<bool>& interrupted);

// True if the own run in this folder is finished but its studies are not: --resume then continues with the studies.
bool studies_left(const Script& script, const std::string& directory);

}  // namespace erbs::lua
