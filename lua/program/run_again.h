// A run that goes on from its folder alone: manifest.json knows the scene and the options.
#pragma once
#include <string>
#include <vector>

#include "lua/program/options.h"

namespace erbs::lua {

// Options of a run besides its overrides that its resumption needs, for manifest.json. Folders are absolute.
std::vector<std::string> kept_arguments(const RunCommand& command);

// `erbs run DIR --resume` as the command that names scene, folder and all options of the run in DIR. Throws Error, also if DIR is a run
// folder and --resume is missing. Other commands are returned as they are.
RunCommand with_kept_arguments(const RunCommand& wish);

// The line to type in a shell.
std::string resume_line(const std::string& directory);

}  // namespace erbs::lua
