// A push of a small structure given as text, for the tests of pushes.
#pragma once
#include <atomic>
#include <filesystem>
#include <string>

#include "engine/analysis/quasi_static/push_run.h"
#include "tests/support/text_of.h"
#include "tests/unit/lua/load.h"

namespace erbs::test {

inline const std::string stone = R"(
material{ name = "stone", density = 2000, kn = 1e10, ks = 4e9 }
box{ name = "floor", size = {6, 6, .5}, at = {-3, -3, -.5}, fixed = true }
)";

struct PushOutcome {
  Metrics metrics;
  std::string curve;
  std::vector<std::string> warnings;
};

inline PushOutcome push(const std::string& text, const std::string& dir, int threads = 1, Existing existing = Existing::refuse,
                        int stop_at = -1, const std::string& copy_to = "") {
  lua::Script script(lua::quiet());
  Scene scene = script.load_text(text, "scene.lua", {});
  std::atomic<bool> interrupted{false};
  int calls = 0;
  analysis::RunOptions options;
  options.directory = dir, options.threads = threads, options.existing = existing, options.interrupted = &interrupted;
  options.progress = [&](const analysis::Progress&) {
    interrupted = ++calls == stop_at;
    if (calls == 200 && !copy_to.empty()) std::filesystem::copy(dir, copy_to, std::filesystem::copy_options::recursive);
  };
  if (!copy_to.empty()) options.checkpoint_every = 0;
  const analysis::RunOutcome outcome = analysis::run_push(std::move(scene), text, options);
  return {outcome.metrics, text_of(dir + "/curve.csv"), outcome.warnings};
}

}  // namespace erbs::test
