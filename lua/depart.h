// How the command line departs from the scene.
#pragma once
#include "engine/scene/scene.h"
#include "lua/options.h"

namespace erbs {

// Applies it; the words said, for the log.
std::vector<std::string> depart(Scene& scene, const Options& options);

}  // namespace erbs
