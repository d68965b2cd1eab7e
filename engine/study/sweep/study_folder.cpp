#include "engine/study/sweep/study_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "engine/study/sweep/sweep.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;

// 000012 or 000012_03, alone or with an ending; see place_of().
bool is_name_of_run(const std::string& name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits >= 6 && (digits == name.size() || name[digits] == '_' || name[digits] == '.');
}

bool is_name_of_work(const std::string& name) { return name.ends_with(".claim") || name.ends_with(".worker"); }

void remove_named(const std::string& folder, bool (*own)(const std::string& name)) {
  if (!fs::is_directory(fs::symlink_status(folder))) return;
  std::vector<fs::path> doomed;
  for (const auto& entry : fs::directory_iterator(folder))
    if (own(entry.path().filename().string())) doomed.push_back(entry.path());
  for (const fs::path& one : doomed) fs::remove_all(one);
  std::error_code in_use;
  fs::remove(folder, in_use);
}

}  // namespace

bool holds_tables(const std::string& directory) {
  return std::ranges::any_of(std::vector<std::string>{results_file, runs_file}, [&](const std::string& file) {
    std::ifstream in(directory + "/" + file);
    std::string head;
    return std::getline(in, head) && head.starts_with("index,") && head.ends_with(",study");
  });
}

void remove_tables(const std::string& directory) {
  for (const char* file : {results_file, runs_file}) fs::remove(directory + "/" + file);
  remove_named(directory + "/runs", is_name_of_run);
  remove_named(directory + "/work", is_name_of_work);
}

}  // namespace erbs::study
