// The walls of the house: an include goes to a lower level, inside a room to a lower sub-room, and each outside package has one door.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace {

namespace fs = std::filesystem;
using Levels = std::vector<std::vector<std::string>>;

// The rooms, lowest first. Rooms of one level do not know each other.
const Levels rooms{{"base"},
                   {"simd"},
                   {"geometry"},
                   {"laws", "loads"},
                   {"scene"},
                   {"model"},
                   {"joints", "contact"},
                   {"solve", "record"},
                   {"analysis", "study"},
                   {"lua", "render"}};

// The sub-rooms of a room, lowest first: "" is the folder of the room itself. Sub-rooms of one level do not know each other.
const std::map<std::string, Levels> sub_rooms{
    {"base", {{""}, {"system"}}},
    {"loads", {{"waves", "spectra"}, {"record"}, {""}}},
    {"model", {{""}, {"build"}}},
    {"joints", {{""}, {"intact", "cracked"}}},
    {"contact", {{"overlap"}, {"law"}, {"broad"}, {""}}},
    {"solve", {{"blocks", "linear"}, {"contacts", "sequential"}, {""}}},
    {"record", {{"format", "plot"}, {"recorders", "performance"}, {"results"}, {"folder"}, {"export"}, {"report"}}},
    {"analysis", {{"limit", "start"}, {""}, {"quasi_static"}}},
    {"study", {{""}, {"sweep"}, {"calibrate", "fragility"}}},
    {"lua", {{"reading", "masonry", "page"}, {"language"}, {"program"}, {"reports"}, {"commands"}, {""}}},
    {"render", {{"image", "run"}, {"gl"}, {"draw"}, {"movie"}, {"compare", "vector"}, {""}}},
};

// Package -> the files it may enter by. The first that fits counts.
const std::vector<std::pair<std::string, std::string>> doors{
    {"Eigen/Sparse.*|Eigen/Eigenvalues|Spectra/.*", "engine/base/sparse.*"},
    {"Eigen/.*", "engine/base/(vec\\.h|sparse.*)"},
    {"fmt/.*", "engine/base/error\\.h"},
    {"omp\\.h", "engine/base/system/team.*"},
    {"nlohmann/.*", "engine/record/format/json\\.h"},
    {"hdf5.*", "engine/record/format/h5\\.cpp"},
    {"assimp/.*", "engine/scene/mesh_file\\.cpp"},
    {"lua.*", "lua/(language|reading)/.*"},
    {"CLI/.*", "(lua|render)/main\\.cpp|lua/program/(option_kinds|command_line)\\.(h|cpp)"},
    {"GL/glcorearb\\.h", "render/gl/gl\\.h"},  // types and names only, no library
    {"GL/.*|EGL/.*", "render/gl/context_.*\\.cpp"},
    {"png\\.h", "render/image/image\\.cpp"},
    {"stb.*", "render/image/text\\.cpp"},
    {"Clp.*|Coin.*", "engine/analysis/limit/linear_program\\.cpp"},
    {"zlib\\.h", "engine/record/report/pack\\.cpp"},
    {"sys/.*|linux/.*|(unistd|math|fcntl|sched|spawn|signal|poll|dlfcn|termios|malloc|immintrin)\\.h|[a-z_0-9]+",
     ".*"},  // the system's and the language's own
};

const std::regex seen_by_render(
    "engine/(base|geometry)/.*|engine/record/(folder/(colors|identity|motion_file|motion_scene|run_folder)|format/json|plot/"
    "(figure|gnuplot|unit))\\.h|"
    "engine/scene/scene\\.h|render/.*");

// The level of `name`, -1 where none has it.
int level_of(const Levels& levels, const std::string& name) {
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (const std::string& one : levels[i])
      if (one == name) return int(i);
  return -1;
}

struct Address {
  std::string room, sub;
};
// engine/solve/contacts/sleep.h: solve, contacts
Address address(const std::string& path) {
  static const std::regex folders("(?:engine/)?([^/]+)/(?:([^/]+)/)?.*");
  std::smatch found;
  if (!std::regex_match(path, found, folders)) return {};
  return {found[1], found[2]};
}

// `from` may include what lies in `to`, both of one list of levels.
bool may_know(const Levels& levels, const std::string& from, const std::string& to) {
  return from == to || level_of(levels, from) > level_of(levels, to);
}

// What is wrong with the place of `file`; empty where nothing is.
std::string misplaced(const std::string& file) {
  const auto [room, sub] = address(file);
  if (level_of(rooms, room) < 0) return file + " lies in no room that this test knows";
  const auto inside = sub_rooms.find(room);
  const Levels levels = inside == sub_rooms.end() ? Levels{{""}} : inside->second;
  return level_of(levels, sub) < 0 ? file + " lies in no sub-room that this test knows" : "";
}

// What is wrong with `file` including `target`; empty where nothing is.
std::string trouble(const std::string& file, const std::string& target, bool outside) {
  if (outside) {
    for (const auto& [package, door] : doors)
      if (std::regex_match(target, std::regex(package)))
        return std::regex_match(file, std::regex(door)) ? "" : file + " includes " + target + ", whose door is " + door;
    return file + " includes " + target + ", which has no door";
  }
  const Address from = address(file), to = address(target);
  if (level_of(rooms, to.room) < 0) return file + " includes \"" + target + "\", which is not written from the root";
  if (!may_know(rooms, from.room, to.room)) return file + " includes " + target + ", which is not in a lower room";
  if (from.room == to.room && sub_rooms.contains(from.room) && !may_know(sub_rooms.at(from.room), from.sub, to.sub))
    return file + " includes " + target + ", which is not in a lower sub-room";
  if (from.room == "render" && !std::regex_match(target, seen_by_render))
    return file + " includes " + target + ", which the renderer may not see";
  return "";
}

// Calls visit(path from the root, path) for every file of the two programs.
template <class F>
void each_file(F&& visit) {
  for (const char* top : {"engine", "lua", "render"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(erbs::test::in_source("")) / top))
      if (entry.is_regular_file() && entry.path().string().find("/node_modules/") == std::string::npos)  // packages of the web page
        visit(fs::relative(entry.path(), erbs::test::in_source("")).generic_string(), entry.path());
}

bool is_code(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

}  // namespace

TEST_CASE("includes go down, and packages enter by their doors", "[layers]") {
  const std::regex include("\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  int files = 0;
  each_file([&](const std::string& file, const fs::path& path) {
    if (!is_code(path)) return;
    ++files;
    CHECK(misplaced(file) == "");
    std::ifstream in(path);
    std::smatch found;
    for (std::string line; std::getline(in, line);)
      if (std::regex_match(line, found, include)) CHECK(trouble(file, found[2], found[1] == "<") == "");
  });
  CHECK(files > 300);
}

TEST_CASE("no folder holds more than fifteen names", "[layers]") {
  // A .h and its .cpp are one name, and so are the files that compile one thing for several instruction sets.
  const std::regex isa("_(sse2|avx2|avx512)$");
  std::map<std::string, std::set<std::string>> names;
  each_file([&](const std::string& file, const fs::path& path) {
    names[fs::path(file).parent_path().generic_string()].insert(std::regex_replace(path.stem().string(), isa, ""));
  });
  for (const auto& [folder, held] : names) {
    INFO(folder);
    CHECK(held.size() <= 15);
  }
  CHECK(names.size() > 30);
}

TEST_CASE("no two types of one namespace have one name", "[layers]") {
  // The linker takes one of their functions for both, without a word.
  const std::regex space("namespace ([a-z:_]+) \\{.*"),
      type("(?:struct|class|enum class|enum) ([A-Z][A-Za-z]*)(?: final)?(?: :[^;]*)? \\{.*");
  std::map<std::string, std::string> files;
  each_file([&](const std::string& file, const fs::path& path) {
    if (path.extension() != ".h") return;
    std::ifstream in(path);
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
  });
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
  // inside a room
  CHECK(trouble("engine/solve/step.h", "engine/solve/contacts/sleep.h", false) == "");
  CHECK(trouble("engine/solve/contacts/sleep.h", "engine/solve/step.h", false) != "");
  CHECK(trouble("engine/solve/contacts/sleep.h", "engine/solve/sequential/sequential.h", false) != "");
  CHECK(trouble("engine/solve/step_kernels.cpp", "engine/joints/intact/intact_kernel.h", false) == "");
  CHECK(trouble("engine/joints/kernels.h", "engine/joints/intact/intact.h", false) != "");
  CHECK(misplaced("engine/solve/contacts/sleep.h") == "");
  CHECK(misplaced("engine/solve/more/sleep.h") != "");
  CHECK(misplaced("engine/more/sleep.h") != "");
  CHECK(misplaced("engine/geometry/more/clip.h") != "");
}
