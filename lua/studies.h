// The studies of a scene, carried out after its own run.
#pragma once
#include <atomic>
#include <string>

#include "engine/record/json.h"
#include "lua/options.h"

namespace erbs {

struct StudiesOutcome {
  Json metrics = Json::object();      // to stand beside the scene's own
  std::vector<std::string> troubles;  // why one has no value
  double updates = 0;                 // contact points their runs evaluated
  bool interrupted = false;
};

StudiesOutcome run_studies(const Script& script, const std::string& path, const std::string& directory, const Options& options,
                           const std::atomic<bool>& interrupted);

// A run folder whose own run is finished, with studies that are not: --resume goes on with these.
bool studies_left(const Script& script, const std::string& directory);

}  // namespace erbs
