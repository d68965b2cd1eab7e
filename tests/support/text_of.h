// The content of a file, for tests that compare what was written; empty where there is none.
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace erbs::test {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace erbs::test
