#include "lua/child.h"

#include <filesystem>

namespace erbs {

std::string renderer_path() {
  const auto beside = std::filesystem::path(own_path()).parent_path() / "erbs-render";
  return std::filesystem::exists(beside) ? beside.string() : "erbs-render";
}

int run_renderer(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{renderer_path()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return wait_for(start(command));
}

}  // namespace erbs
