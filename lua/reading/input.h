// Files that a script names. A scene may read in its own folder and in the folder `scenes` around it, if there is one. The command line may
// allow further folders (--allow DIR). No absolute path, `..` or link leads out of them.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "lua/reading/context.h"

namespace erbs::lua {

// These folders with all links resolved; the scene's own folder is the first.
std::vector<std::filesystem::path> readable_folders(const Context& context);
bool may_read(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& path);

// The file that a script names. A relative name is searched in each of the folders. Throws Error, whose text does not reveal
// whether the file exists outside the folders.
std::filesystem::path find_input(const Context& context, const std::string& file, const Place& place);

// Returns the content of the file and keeps its hash for the manifest. Throws Error.
std::string read_input(Context& context, const std::filesystem::path& path, const Place& place);

}  // namespace erbs::lua
