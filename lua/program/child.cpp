#include "lua/program/child.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "engine/base/error.h"

namespace erbs {
namespace {

bool can_start(const std::string& name) {
  if (name.find('/') != std::string::npos) return ::access(name.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

std::string renderer_path() {
  std::error_code ignored;
  const auto beside = std::filesystem::path(own_path()).parent_path() / "erbs-render";
  return std::filesystem::exists(beside, ignored) ? beside.string() : "erbs-render";
}

int run_renderer(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{renderer_path()};
  for (const auto& word : arguments) command.push_back(word);
  return wait_for(start(command));
}

void check_programs(const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (!can_start(name))
      throw Error(fmt::format(
          "the program {} is not there; {}", name,
          name == "ffmpeg" ? "install the package ffmpeg, or leave --video out" : "it belongs beside erbs: build or install both"));
}

}  // namespace erbs
