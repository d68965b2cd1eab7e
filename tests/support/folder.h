// A folder for one test, removed at its end. Tests run in parallel, in many processes and from several checkouts.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace erbs::test {

struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "erbs_test_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no folder could be made in " + std::filesystem::temp_directory_path().string());
    path = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path / name).string(); }
};

}  // namespace erbs::test
