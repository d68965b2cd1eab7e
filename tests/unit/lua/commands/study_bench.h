// A study of the small scene tiny.lua, swept by the program.
#pragma once
#include <string>
#include <vector>

#include "tests/unit/lua/bench.h"

namespace erbs::test {

struct StudyBench : lua::Bench {
  explicit StudyBench(const std::string& tiny) { write("tiny.lua", tiny); }
  int sweep(const std::string& study, const std::vector<std::string>& more = {}, const std::string& directory = "") {
    write("study.lua", study);
    std::vector<std::string> words{"sweep", (folder / "study.lua").string(), "-o", directory.empty() ? out() : directory};
    words.insert(words.end(), more.begin(), more.end());
    return erbs(words);
  }
};

}  // namespace erbs::test
