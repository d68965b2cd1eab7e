#include "engine/record/folder/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>

#include "engine/base/text.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

// Files and folders the programs write into a run folder. --force removes these only; notes of the user survive.
constexpr std::string_view own_files[] = {
    "scene.lua",  "manifest.json", "metrics.json",     "log.txt",           "energy.csv", "histories.csv", "events.csv",  "histories.svg",
    "energy.svg", "motion.h5",     "motion.xdmf",      "checkpoint.bin",    "frames",     "report.html",   "results.csv", "accuracy.csv",
    "modes.csv",  "studies",       "figures",          "expectations.json", "plot.svg",   "plot.png",      "pictures",    "curve.csv",
    "curve.svg",  "shape.csv",     "performance.json", "performance.svg"};
constexpr std::string_view own_endings[] = {".mp4", ".tmp", ".part"};

bool is_own(const fs::path& path) {
  const std::string name = path.filename().string();
  for (const auto own : own_files)
    if (name == own) return true;
  for (const auto ending : own_endings)
    if (name.size() > ending.size() && name.ends_with(ending)) return true;
  return false;
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
  if (!fs::is_regular_file(run_file(dir, "manifest.json"), failed)) return false;
  try {
    const Json json = read_json(run_file(dir, "manifest.json"));
    if (json.is_object() && json.contains("program")) return json["program"] == "erbs";
  } catch (const std::exception&) {}  // damaged; the other files decide
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
            fmt::format("\"{}\" is no run folder (it has no manifest.json of erbs) and is left alone, --force or not; choose another "
                        "with -o DIR",
                        dir));
      return;
    case Existing::resume:
      if (!there) throw Error(fmt::format("nothing to resume: there is no folder \"{}\"; run without --resume", dir));
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
    if (existing == Existing::force && missing.empty()) {
      // The manifest is removed last: until then it identifies the run folder.
      for (const auto& entry : fs::directory_iterator(dir))
        if (is_own(entry.path()) && entry.path().filename() != "manifest.json") fs::remove_all(entry.path());
    }
    fs::path own = fs::absolute(dir).lexically_normal();
    if (!own.has_filename()) own = own.parent_path();  // for "out/"
    if (own.has_parent_path()) fs::create_directories(own.parent_path());
    made = fs::create_directory(own);
    if (!made && existing == Existing::refuse) check_run_folder(dir, existing);  // a run started at the same time has created it
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
