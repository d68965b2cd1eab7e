// Overrides: options of the command line that replace values of the scene.
#pragma once
#include "engine/scene/scene.h"
#include "lua/program/options.h"

namespace erbs::lua {

// Applies the overrides to the scene of a script. Returns their text, for the log.
std::vector<std::string> apply_overrides(Scene& scene, const RunCommand& command, Script& script);

// Reads -D name=value. Throws Error.
void read_defines(const std::vector<std::string>& defines, Overrides& overrides);

// The quality of --set quality=...: draft, standard or reference; "" without one. It holds for values the script leaves open.
// Throws Error.
std::string quality_of(const SceneChanges& changes);

}  // namespace erbs::lua
