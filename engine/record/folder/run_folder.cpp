#include "engine/record/folder/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string_view>

#include "engine/base/text.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

// Files and folders the programs write into a run folder. --force removes these only; notes and films of the user survive.
constexpr std::string_view own_files[] = {"scene.lua",     "manifest.json",  "metrics.json",      "log.txt",         "energy.csv",
                                          "histories.csv", "events.csv",     "histories.svg",     "energy.svg",      "motion.h5",
                                          "motion.xdmf",   "frames",         "report.html",       "results.csv",     "accuracy.csv",
                                          "modes.csv",     "studies",        "figures",           "plot.svg",        "plot.png",
                                          "pictures",      "curve.csv",      "curve.svg",         "shape.csv",       "twin",
                                          "twin.log",      "checkpoint.bin", "expectations.json", "performance.svg", "performance.json"};
constexpr std::string_view performances = "performance_";  // performance_tbsc_2018.json and .svg, of erbs capacity
constexpr std::string_view own_endings[] = {".tmp", ".part"};
constexpr std::string_view films[] = {".mp4", ".webp"};                          // SCENE_camera.mp4
constexpr std::string_view comparisons[] = {"compare.", "compare_", "frames."};  // beginnings of the names in compare/

bool ends_in(const std::string& name, std::string_view ending) { return name.size() > ending.size() && name.ends_with(ending); }

bool is_own(const std::string& name, const std::string& scene) {
  return std::ranges::count(own_files, name) > 0 || std::ranges::any_of(own_endings, [&](auto e) { return ends_in(name, e); }) ||
         (name.starts_with(performances) && (name.ends_with(".json") || name.ends_with(".svg"))) ||
         (name.starts_with(scene + "_") && std::ranges::any_of(films, [&](auto e) { return ends_in(name, e); }));
}

// Removes what `own` names in a folder, and then a folder that is left empty.
template <class Own>
void remove_from(const fs::path& folder, const Own& own) {
  if (!fs::is_directory(fs::symlink_status(folder))) return;
  for (const auto& entry : fs::directory_iterator(folder))
    if (own(entry.path().filename().string())) fs::remove_all(entry.path());
  std::error_code in_use;
  fs::remove(folder, in_use);
}

// A run that was killed while it wrote a file has left part of it beside the whole one.
void remove_unfinished(const std::string& dir, const std::string& scene) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(dir)) {
    const std::string name = entry.path().filename().string();
    for (const std::string_view ending : own_endings)
      if (ends_in(name, ending) && is_own(name.substr(0, name.size() - ending.size()), scene)) fs::remove(entry.path(), ignored);
  }
}

// The manifest stays: it identifies the run folder until a new one is written.
void remove_former_run(const std::string& dir, const std::string& scene) {
  for (const auto& entry : fs::directory_iterator(dir))
    if (const std::string name = entry.path().filename().string(); is_own(name, scene) && name != "manifest.json")
      fs::remove_all(entry.path());
  remove_from(fs::path(dir) / "compare", [](const std::string& name) {
    return std::ranges::any_of(comparisons, [&](auto beginning) { return name.starts_with(beginning); });
  });
  remove_from(fs::path(dir) / "export",
              [&](const std::string& name) { return name.starts_with(scene + ".") || name.starts_with(scene + "_"); });
}

// Under which name films and exports of the former run were written; that of the new run if its manifest cannot be read.
std::string scene_of_films(const std::string& dir, const Manifest& manifest) {
  try {
    return file_stem(read_manifest(dir).scene_name);
  } catch (const std::exception&) { return file_stem(manifest.scene_name); }
}

// The topmost folder of `path` that does not exist yet; empty if all exist. Removing it undoes the creation of all.
fs::path first_missing(const fs::path& path) {
  fs::path missing;
  for (fs::path at = fs::absolute(path).lexically_normal(); !at.empty() && !fs::exists(at); at = at.parent_path()) missing = at;
  return missing;
}

}  // namespace

std::string run_file(const std::string& dir, const std::string& name) { return (fs::path(dir) / name).string(); }

bool is_run_folder(const std::string& dir) {
  std::error_code failed;
  try {
    const Json json = read_json(run_file(dir, "manifest.json"));
    if (json.is_object() && json.contains("program")) return json["program"] == "erbs";
  } catch (const std::exception&) {}  // damaged or gone; the other files decide
  const auto there = [&](const char* name) { return fs::is_regular_file(run_file(dir, name), failed); };
  return there("scene.lua") && (there("checkpoint.bin") || there("energy.csv") || there("motion.h5"));
}

FolderLock::FolderLock(const std::string& dir) : fd_(::open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  // Some file systems have no folder locks; a run there goes unlocked.
  if (fd_ < 0 || ::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(fd_);
  throw Error(fmt::format("another run is at work in \"{}\"; wait for its end, or choose another folder with -o DIR", dir));
}

FolderLock::~FolderLock() {
  if (fd_ >= 0) ::close(fd_);
}

void check_run_folder(const std::string& dir, Existing existing) {
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(dir, failed);
  if (failed && status.type() != fs::file_type::not_found)
    throw Error(fmt::format("output folder \"{}\" cannot be made: {}; choose another with -o DIR", shown(dir, 80), failed.message()));
  const bool there = fs::exists(status);
  const bool checkpoint = there && fs::is_regular_file(run_file(dir, "checkpoint.bin"), failed);
  switch (existing) {
    case Existing::refuse:
      if (there)
        throw Error(fmt::format("output folder \"{}\" exists; choose another with -o DIR, or overwrite it with --force{}", dir,
                                checkpoint ? ", or go on with --resume" : ""));
      return;
    case Existing::force:
      if (there && !fs::is_directory(dir)) throw Error(fmt::format("\"{}\" is no folder; choose another with -o DIR", dir));
      if (there && !fs::is_empty(dir) && !is_run_folder(dir))
        throw Error(
            fmt::format("\"{}\" is no run folder (it has neither a manifest.json of erbs nor scene.lua beside results) and is left alone, "
                        "--force or not; choose another "
                        "with -o DIR",
                        dir));
      return;
    case Existing::resume:
      if (!there) throw Error(fmt::format("nothing to resume: there is no folder \"{}\"; run without --resume", dir));
      if (is_run_folder(dir) && !checkpoint && fs::is_regular_file(run_file(dir, "metrics.json"), failed))
        throw Error(
            fmt::format("nothing to resume: the run in \"{}\" has come to its end; render or plot it, or start it anew with --force", dir));
      if (!is_run_folder(dir) || !checkpoint)
        throw Error(fmt::format("nothing to resume: \"{}\" holds no checkpoint.bin; start anew with --force", dir));
      return;
  }
}

void create_run_folder(const std::string& dir, Existing existing, const std::string& script, const Manifest& manifest) {
  check_run_folder(dir, existing);
  const fs::path missing = first_missing(dir);
  bool made = false;  // created by this call, so removed again if the rest fails
  try {
    if (existing == Existing::force && missing.empty()) remove_former_run(dir, scene_of_films(dir, manifest));
    fs::path own = fs::absolute(dir).lexically_normal();
    if (!own.has_filename()) own = own.parent_path();  // for "out/"
    if (own.has_parent_path()) fs::create_directories(own.parent_path());
    made = fs::create_directory(own);
    if (!made && existing == Existing::refuse) check_run_folder(dir, existing);  // a run started at the same time has created it
    if (existing == Existing::resume) remove_unfinished(dir, scene_of_films(dir, manifest));
    write_manifest(dir, manifest);
    if (existing != Existing::resume) write_text_atomically(run_file(dir, "scene.lua"), script);
  } catch (const std::exception& trouble) {
    std::error_code ignored;
    if (made) fs::remove_all(missing, ignored);
    const auto* failed = dynamic_cast<const fs::filesystem_error*>(&trouble);
    if (!failed) throw;
    throw Error(
        fmt::format("output folder \"{}\" cannot be made: {}; choose another with -o DIR", shown(dir, 80), failed->code().message()));
  }
}

}  // namespace erbs
