// The documents name files that exist, link to places that exist, and stay as short as they promise.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace {

namespace fs = std::filesystem;

const fs::path root = erbs::test::in_source("");

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> found{root / "README.md"};
  for (const char* top : {"engine", "lua", "render", "scenes", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top))
      if (entry.path().extension() == ".md" && entry.path().string().find("/node_modules/") == std::string::npos)
        found.push_back(entry.path());
  return found;
}

// The name under which GitHub links to a heading.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    if (c == ' ' || c == '-') anchor += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& document) {
  static const std::regex name("<a name=\"([^\"]+)\">.*");
  std::set<std::string> anchors;
  std::smatch found;
  for (const std::string& line : lines_of(document)) {
    if (line.starts_with("#")) anchors.insert(anchor_of(line));
    else if (std::regex_match(line, found, name)) anchors.insert(found[1]);
  }
  return anchors;
}

// All first groups of `what` in the document.
std::vector<std::string> all_of(const fs::path& document, const std::regex& what) {
  std::vector<std::string> all;
  for (const std::string& line : lines_of(document))
    for (std::sregex_iterator i(line.begin(), line.end(), what), end; i != end; ++i) all.push_back((*i)[1]);
  return all;
}

}  // namespace

TEST_CASE("links of the documents lead somewhere", "[documents]") {
  const std::regex link("\\]\\(([^)]+)\\)");
  for (const fs::path& document : documents())
    for (const std::string& to : all_of(document, link)) {
      if (to.starts_with("http")) continue;
      const std::string path = to.substr(0, to.find('#'));
      const fs::path target = path.empty() ? document : document.parent_path() / path;
      INFO(document << " links to " << to);
      CHECK(fs::exists(target));
      if (to.find('#') != std::string::npos) CHECK(anchors_of(target).contains(to.substr(to.find('#') + 1)));
    }
}

TEST_CASE("files that the documents name exist", "[documents]") {
  const std::regex file("`((?:engine|lua|render|scenes|tests|media)/[A-Za-z0-9_/.-]+)`");
  int files = 0;
  for (const fs::path& document : documents())
    for (const std::string& name : all_of(document, file)) {
      INFO(document << " names " << name);
      CHECK(fs::exists(root / name));
      ++files;
    }
  CHECK(files > 50);
}

TEST_CASE("the documents cite nothing outside the tree", "[documents]") {
  for (const fs::path& document : documents()) CHECK(all_of(document, std::regex("(\\.\\./shared)")).empty());
}

TEST_CASE("README is read in one sitting", "[documents]") { CHECK(lines_of(root / "README.md").size() <= 120); }
