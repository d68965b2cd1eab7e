// Calls the program as a user would, in a folder of its own.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lua/program/child.h"
#include "tests/support/folder.h"
#include "tests/support/places.h"
#include "tests/support/text_of.h"
#include "tests/unit/lua/load.h"

namespace erbs::lua {

using test::text_of;

// Three lines of a scene with four bricks; the joint law follows.
inline std::string four_bricks() {
  return R"(material{ name = "brick", density = 1800 }
ground{ size = 4 }
for i = 0, 3 do box{ name = "b" .. i, group = "pier", size = { .3, .125, .1 }, at = { 0, 0, i * .1 } } end
)";
}

struct Bench {
  test::Folder own;
  std::filesystem::path folder = own.path;
  std::string said;  // stdout and stderr of the last call

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  std::string scene(const std::string& text) const {
    write("scene.lua", text);
    return (folder / "scene.lua").string();
  }
  std::vector<std::string> command(std::vector<std::string> words) const {
    words.insert(words.begin(), test::in_build("/erbs"));
    return words;
  }
  int erbs(const std::vector<std::string>& words) {
    const int code = wait_for(start(command(words), (folder / "log").string()));
    said = text_of(folder / "log");
    return code;
  }
  int run(const std::string& text, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"run", scene(text), "-o", out()};
    words.insert(words.end(), more.begin(), more.end());
    return erbs(words);
  }
  std::string out() const { return (folder / "out").string(); }
};

}  // namespace erbs::lua
