// The run folder: what a run leaves behind, and all that the renderer, reports and studies know of it.
#pragma once
#include <string>

#include "engine/record/csv.h"
#include "engine/record/manifest.h"
#include "engine/record/metrics.h"

namespace erbs {

enum class Existing { refuse, force, resume };  // what to do with a folder that is there

// Checks that `dir` may be written and touches nothing: refuse: nothing of that name exists; force: absent, empty or a run
// folder; resume: a run folder with a checkpoint. Error (with the remedy) otherwise. To be called before the work of a run starts.
void check_run_folder(const std::string& dir, Existing existing);

// After check_run_folder: makes the folder (force: removes what an earlier run left there, and only that), writes scene.lua and
// manifest.json. With resume only the manifest is written again.
void create_run_folder(const std::string& dir, Existing existing, const std::string& script, const Manifest& manifest);

// Whether manifest.json there is of erbs; also where it is damaged, but other files of a run lie beside it.
bool is_run_folder(const std::string& dir);

// Keeps a folder for one run as long as it lives: a lock of the system, which goes with the process however that ends.
class FolderLock {
 public:
  explicit FolderLock(const std::string& dir);  // Error where another run is at work there
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_ = -1;
};

std::string run_file(const std::string& dir, const std::string& name);  // DIR/name

}  // namespace erbs
