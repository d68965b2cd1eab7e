// Dynamic runs of scenes given as text, and the blocks of a model by name.
#pragma once
#include <algorithm>
#include <optional>
#include <string>

#include "engine/analysis/dynamic.h"
#include "lua/language/script.h"

namespace erbs::test {

inline Metrics dynamic_run(const std::string& text, const std::string& directory, Existing existing, std::optional<double> until = {},
                           int threads = 1) {
  lua::Script script(lua::Script::Options{.quiet = true});
  analysis::RunOptions options;
  options.directory = directory;
  options.existing = existing;
  options.until = until;
  options.threads = threads;
  return analysis::run_dynamic(script.load_text(text, "scene.lua"), text, options).metrics;
}

inline int block_index(const Model& m, const std::string& name) {
  return int(std::ranges::find(m.block_name, name) - m.block_name.begin());
}

}  // namespace erbs::test
