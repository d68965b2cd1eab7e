#include "lua/program/child.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>

#include "engine/base/error.h"

namespace erbs::lua {
namespace {

std::string remedy_of(const std::string& program) {
  return program == "ffmpeg" ? "install the package ffmpeg, or leave --video out" : "it belongs beside erbs: build or install both";
}

}  // namespace

std::string renderer_path() {
  std::error_code ignored;
  const auto beside = std::filesystem::path(own_folder()) / "erbs-render";
  return std::filesystem::exists(beside, ignored) ? beside.string() : "erbs-render";
}

int run_renderer(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{renderer_path()};
  for (const auto& word : arguments) command.push_back(word);
  Launch how;
  how.remedy = remedy_of(command.front());
  return wait_for(start(command, how));
}

void check_programs(const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (!can_start(name)) throw Error(fmt::format("the program {} is not there; {}", name, remedy_of(name)));
}

std::string shell_quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string shell_word(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+%=", c); });
  return plain ? word : shell_quoted(word);
}

}  // namespace erbs::lua
