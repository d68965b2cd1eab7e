// The seam between the program and the engine: one scene, one run folder.
#pragma once
#include <atomic>
#include <functional>
#include <string>

#include "engine/record/json.h"
#include "engine/scene/scene.h"
#include "lua/options.h"
#include "lua/progress.h"

namespace erbs {

struct RunEnd {
  std::string status;          // completed | diverged | stopped | interrupted
  bool numbers_wrong = false;  // NaN, or energy past its gate
  std::string reason;          // why it ended early, in words; "" where it did not
};

// Runs the scene into `directory`. Nothing of it exists before the model is built and checked; throws Error or Errors until then.
RunEnd run_scene(const Scene& scene, const std::string& script, const std::string& directory, const Options& options,
                 std::atomic<bool>& interrupted, const std::function<void(const Progress&)>& progress);

}  // namespace erbs
