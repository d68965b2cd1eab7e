// Where a verb writes one file.
#pragma once
#include <string>
#include <vector>

#include "lua/program/options.h"

namespace erbs::lua {

// What -o names, else `ordinary`. Error if the name has another ending than these (".svg"), if a folder has it, if the file exists without
// --force, or if the folder that -o names does not exist; `thing`: "a picture".
std::string output_path(const OutputOptions& output, const std::string& ordinary, const std::string& thing,
                        const std::vector<std::string>& endings);

}  // namespace erbs::lua
