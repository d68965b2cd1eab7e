#include "lua/reading/input.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/base/hash.h"
#include "engine/base/text.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20;  // the data read from it take ten times as much memory

// The path without links and dots; empty if it cannot be resolved (name too long, links in a circle).
fs::path real(const fs::path& path) {
  std::error_code failed;
  const fs::path found = fs::weakly_canonical(fs::absolute(path, failed), failed);
  return failed ? fs::path() : found;
}

bool is_inside(const fs::path& folder, const fs::path& path) {
  return !folder.empty() && std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// `/a/b/` becomes `/a/b`: with an empty last part no path would count as inside.
fs::path bare(fs::path folder) { return folder.has_filename() ? folder : folder.parent_path(); }

}  // namespace

std::vector<fs::path> readable_folders(const Context& context) {
  std::vector<fs::path> folders{bare(real(context.folder.empty() ? fs::path(".") : context.folder))};
  for (fs::path above = folders.front(); above.has_relative_path(); above = above.parent_path())
    if (above.filename() == "scenes") {
      folders.push_back(above);
      break;
    }
  for (const std::string& allowed : context.allowed) folders.push_back(bare(real(allowed)));
  return folders;
}

bool may_read(const std::vector<fs::path>& folders, const fs::path& path) {
  const fs::path found = real(path);
  return !found.empty() && std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) { return is_inside(folder, found); });
}

fs::path find_input(const Context& context, const std::string& file, const Place& place) {
  const std::vector<fs::path> folders = readable_folders(context);
  const fs::path name(file);
  std::vector<fs::path> tried;
  if (name.is_absolute()) tried = {name};
  else tried = {context.folder / name};
  if (!name.is_absolute())
    for (std::size_t i = 1; i < folders.size(); ++i) tried.push_back(folders[i] / name);
  bool outside = false;
  std::vector<std::string> list;
  for (const auto& path : tried) {
    if (!may_read(folders, path)) {
      outside = true;
      continue;
    }
    std::error_code failed;
    if (fs::is_regular_file(path, failed)) {
      if (fs::file_size(path, failed) > most_bytes)
        throw Error(fmt::format("file \"{}\" is larger than {} MiB; give a smaller one", shown(file), most_bytes >> 20), place);
      return path;
    }
    list.push_back(shown(path.string(), 400));
  }
  if (outside && list.empty())
    throw Error(
        fmt::format("file \"{}\" lies outside of the scene's folder, where a scene reads nothing; put it beside the scene, or allow "
                    "its folder with --allow DIR",
                    shown(file)),
        place);
  throw Error(fmt::format("file \"{}\" is not there; looked for {}; correct the name, or put the file beside the scene", shown(file),
                          fmt::join(list, ", ")),
              place);
}

std::string read_input(Context& context, const fs::path& path, const Place& place) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  // an empty file sets the failbit of `text`; it is no error here
  if (!stream || (stream.peek() != std::ifstream::traits_type::eof() && !(text << stream.rdbuf())))
    throw Error(fmt::format("cannot read {}: {}; check its permissions", shown(path.string(), 400), std::strerror(errno)), place);
  context.scene.inputs[path.string()] = hash_text(fnv1a(text.str()));
  return text.str();
}

}  // namespace erbs::lua
