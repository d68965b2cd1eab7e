// The run folder: the output of a run, and the only input of renderer, reports and studies.
#pragma once
#include <string>

#include "engine/record/folder/manifest.h"
#include "engine/record/format/csv.h"
#include "engine/record/results/metrics.h"

namespace erbs {

enum class Existing { refuse, force, resume };  // what to do with a folder that exists

// Checks that `dir` may be written, and changes nothing. Call it before the work of a run starts. Error with remedy unless:
// refuse: nothing of that name exists;
// force: the folder is absent, empty or a run folder;
// resume: the folder is a run folder with a checkpoint.
void check_run_folder(const std::string& dir, Existing existing);

// Repeats check_run_folder, creates the folder, and writes scene.lua and manifest.json. With force, removes the files of an earlier run,
// and only those. With resume, writes only the manifest.
void create_run_folder(const std::string& dir, Existing existing, const std::string& script, const Manifest& manifest);

// True if the manifest.json there is one of erbs. A manifest that is damaged or gone counts if other files of a run are present.
bool is_run_folder(const std::string& dir);

// Reserves a folder for one run by a lock of the operating system. The lock ends with the process, however it ends.
class FolderLock {
 public:
  explicit FolderLock(const std::string& dir);  // Error if another run uses the folder
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_ = -1;
};

std::string run_file(const std::string& dir, const std::string& name);  // DIR/name

}  // namespace erbs
