// Architecture rules: an include goes only to a strictly lower layer, and each external package enters through its own files.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> layers{{"base", 0},  {"geometry", 1}, {"laws", 1},  {"loads", 1},  {"scene", 2},
                                        {"model", 3}, {"contact", 4},  {"solve", 5}, {"record", 5}, {"analysis", 6},
                                        {"study", 6}, {"lua", 7},      {"render", 7}};

// Package -> files that may include it. The first match counts.
const std::vector<std::pair<std::string, std::string>> doors{
    {"Eigen/Sparse.*|Eigen/Eigenvalues|Spectra/.*", "engine/base/sparse.*"},
    {"Eigen/.*", "engine/base/(vec\\.h|sparse.*)"},
    {"fmt/.*", "engine/base/error\\.h"},
    {"omp\\.h", "engine/base/system/team.*"},
    {"nlohmann/.*", "engine/record/(run_folder.*|.*json.*)"},
    {"hdf5.*", "engine/record/(motion_file|h5)\\.cpp"},
    {"assimp/.*", "engine/scene/mesh_file\\.cpp"},
    {"lua.*", "lua/.*"},
    {"CLI/.*", "lua/.*|render/main\\.cpp"},
    {"GL/glcorearb\\.h", "render/gl\\.h"},  // types and names only, no library
    {"GL/.*|EGL/.*", "render/context_.*\\.cpp"},
    {"png\\.h", "render/image\\.cpp"},
    {"stb.*", "render/.*"},
    {"sys/.*|linux/.*|(unistd|fcntl|sched|spawn|signal|poll|dlfcn|termios|malloc|immintrin)\\.h|[a-z_0-9]+", ".*"},  // system and language
};

const std::regex seen_by_render(
    "engine/(base|geometry)/.*|engine/record/(motion_file|motion_scene|run_folder|json|gnuplot)\\.h|engine/scene/scene\\.h|render/.*");

std::string room(const std::string& path) {
  static const std::regex folder("(?:engine/)?([^/]+)/.*");
  std::smatch found;
  return std::regex_match(path, found, folder) ? found[1].str() : "";
}

// Mistake in an include of `target` by `file`; empty if there is none.
std::string trouble(const std::string& file, const std::string& target, bool outside) {
  if (outside) {
    for (const auto& [package, door] : doors)
      if (std::regex_match(target, std::regex(package)))
        return std::regex_match(file, std::regex(door)) ? "" : file + " includes " + target + ", whose door is " + door;
    return file + " includes " + target + ", which has no door";
  }
  const std::string from = room(file), to = room(target);
  if (!layers.contains(to)) return file + " includes \"" + target + "\", which is not written from the root";
  if (from != to && layers.at(from) <= layers.at(to)) return file + " includes " + target + ", which is not a lower layer";
  if (from == "render" && !std::regex_match(target, seen_by_render))
    return file + " includes " + target + ", which the renderer may not see";
  return "";
}

}  // namespace

TEST_CASE("includes go down, and packages enter by their doors", "[layers]") {
  const std::regex include("\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  int files = 0;
  for (const char* top : {"engine", "lua", "render"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ERBS_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      ++files;
      const std::string file = fs::relative(entry.path(), ERBS_SOURCE_DIR).generic_string();
      std::ifstream in(entry.path());
      std::smatch found;
      for (std::string line; std::getline(in, line);)
        if (std::regex_match(line, found, include)) CHECK(trouble(file, found[2], found[1] == "<") == "");
    }
  CHECK(files > 50);
}

TEST_CASE("no two types of one namespace have one name", "[layers]") {
  // Otherwise the linker silently takes one type's functions for both.
  const std::regex space("namespace ([a-z:_]+) \\{.*"), type("(?:struct|class|enum class|enum) ([A-Z][A-Za-z]*)(?: final)?(?: :[^;]*)? \\{.*");
  std::map<std::string, std::string> files;
  for (const char* top : {"engine", "lua", "render"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(ERBS_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".h") continue;
      const std::string file = fs::relative(entry.path(), ERBS_SOURCE_DIR).generic_string();
      std::ifstream in(entry.path());
      std::smatch found;
      std::string within;
      for (std::string line; std::getline(in, line);) {
        if (std::regex_match(line, found, space)) within = found[1];
        else if (std::regex_match(line, found, type)) {
          const auto [first, is_new] = files.emplace(within + "::" + found[1].str(), file);
          INFO(first->first << " of " << first->second << " and of " << file);
          CHECK(is_new);
        }
      }
    }
  CHECK(files.size() > 100);
}

TEST_CASE("the layers test sees what is wrong", "[layers]") {
  CHECK(trouble("engine/solve/step.cpp", "engine/model/state.h", false) == "");
  CHECK(trouble("engine/solve/step.cpp", "engine/solve/energy.h", false) == "");
  CHECK(trouble("engine/model/state.h", "engine/solve/step.h", false) != "");
  CHECK(trouble("engine/solve/step.cpp", "engine/record/format/csv.h", false) != "");
  CHECK(trouble("engine/solve/step.cpp", "state.h", false) != "");
  CHECK(trouble("engine/solve/step.cpp", "../model/state.h", false) != "");
  CHECK(trouble("render/draw/draw.cpp", "engine/model/state.h", false) != "");
  CHECK(trouble("render/draw/draw.cpp", "lua/language/api.h", false) != "");
  CHECK(trouble("engine/solve/step.cpp", "Eigen/Dense", true) != "");
  CHECK(trouble("engine/base/vec.h", "Eigen/Dense", true) == "");
  CHECK(trouble("engine/solve/step.cpp", "vector", true) == "");
  CHECK(trouble("engine/solve/step.cpp", "boost/any.hpp", true) != "");
}
