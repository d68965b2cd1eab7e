#include "lua/program/output_path.h"

#include <algorithm>
#include <filesystem>

namespace erbs::lua {

namespace fs = std::filesystem;

std::string output_path(const OutputOptions& output, const std::string& ordinary, const std::string& thing,
                        const std::vector<std::string>& endings) {
  const std::string path = output.directory.empty() ? ordinary : output.directory, ending = fs::path(path).extension().string();
  if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    throw Error(fmt::format("the name of {} ends with {}; change it", thing, fmt::join(endings, " or ")), {path, 0});
  if (fs::is_directory(path)) throw Error("it is a folder; choose another name with -o FILE", {path, 0});
  if (fs::exists(path) && !output.force) throw Error("it exists already; --force writes it anew, -o FILE another", {path, 0});
  if (!output.directory.empty() && !fs::is_directory(fs::absolute(path).parent_path()))
    throw Error("its folder does not exist; make it, or choose another name with -o FILE", {path, 0});
  return path;
}

}  // namespace erbs::lua
