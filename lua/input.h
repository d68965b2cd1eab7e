// Files that a script names. It reads inside the folder of the scene, inside the folder `scenes` that holds it where there is one, and
// inside the folders that the command line allows (--allow DIR); no absolute path, `..` or link leads out of these.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "lua/context.h"

namespace erbs {

// The folders, each without links in its path; the scene's own is the first.
std::vector<std::filesystem::path> readable_folders(const Context& context);
bool may_read(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& path);

// The file a script means: of an absolute name that file, else it is looked for in each of the folders. Throws Error, which does not tell
// whether there is such a file elsewhere.
std::filesystem::path find_input(const Context& context, const std::string& file, const Place& place);

// Reads it and notes its hash for the manifest. Throws Error.
std::string read_input(Context& context, const std::filesystem::path& path, const Place& place);

}  // namespace erbs
