// The tree is formatted as .clang-format says.
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace {

namespace fs = std::filesystem;

struct Answer {
  int code = -1;
  std::string text;  // of stdout and stderr
};
Answer ask(const std::string& command) {
  Answer answer;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> piece;
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), pipe)) answer.text.append(piece.data(), got);
  answer.code = ::pclose(pipe);
  return answer;
}

// Version 14, which the tree is formatted with: others break some lines elsewhere. Empty where it is not installed.
std::string formatter() {
  for (const char* name : {"clang-format-14", "clang-format"}) {
    const Answer answer = ask(std::string(name) + " --version");
    if (answer.code == 0 && answer.text.find("version 14.") != std::string::npos) return name;
  }
  return "";
}

// Every C++ file, from the root.
std::string cpp_files() {
  std::string files;
  for (const char* top : {"engine", "lua", "render", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(erbs::test::in_source("")) / top))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        files += " " + fs::relative(entry.path(), erbs::test::in_source("")).string();
  return files;
}

}  // namespace

TEST_CASE("the tree is formatted", "[layers][format]") {
  const std::string program = formatter();
  if (program.empty()) {
    WARN("skipped: clang-format 14 is not installed");
    return;
  }
  const Answer answer =
      ask("cd '" + erbs::test::in_source("' && ") + program + " --style=file --dry-run -Werror --ferror-limit=1" + cpp_files());
  INFO("To mend: " << program << " -i FILES\n" << answer.text);
  CHECK(answer.code == 0);
}
