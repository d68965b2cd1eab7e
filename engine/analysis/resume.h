// Checks that a checkpoint belongs to the run that resumes from it.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/model/state.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/record/folder/run_folder.h"

namespace erbs::analysis {

// Error if the run in the folder was started with overrides other than `override_arguments`, as far as its manifest.json says.
void check_overrides(const std::string& directory, const std::vector<std::string>& override_arguments);

// Takes the folder for a run, which may be a resumed one; the lock is empty where there is no folder yet. Changes nothing in it.
std::shared_ptr<const FolderLock> reserve_folder(const std::string& directory, Existing existing,
                                                 const std::vector<std::string>& override_arguments);

// What a checkpoint of this run belongs to; `dt` (s): the step at its start.
CheckpointKey checkpoint_key(const Scene& scene, const std::string& script, double dt, const std::vector<std::string>& override_arguments);

// Numbers of blocks, joints and points in a state, and all other sizes that follow from the model.
std::vector<std::size_t> sizes_of(const State& state);

// Error if a state read from a checkpoint has other sizes than the state built from the scene.
void check_sizes(const std::string& directory, const std::vector<std::size_t>& built, const State& read);

}  // namespace erbs::analysis
