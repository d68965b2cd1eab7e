// How the command line departs from the scene.
#pragma once
#include "engine/scene/scene.h"
#include "lua/options.h"

namespace erbs {

// Applies it; the words said, for the log.
std::vector<std::string> depart(Scene& scene, const Options& options);

// draft, standard or reference of --set quality=..., which says what the script leaves open; "" where there is none. Throws Error.
std::string quality_of(const Options& options);

}  // namespace erbs
