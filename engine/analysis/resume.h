// Checks that a checkpoint belongs to the run that resumes from it.
#pragma once
#include <string>
#include <vector>

#include "engine/model/state.h"

namespace erbs::analysis {

// Error if the run in the folder was started with overrides other than `override_arguments`, as far as its manifest.json says.
void check_overrides(const std::string& directory, const std::vector<std::string>& override_arguments);

// Numbers of blocks, joints and points in a state, and all other sizes that follow from the model.
std::vector<std::size_t> sizes_of(const State& state);

// Error if a state read from a checkpoint has other sizes than the state built from the scene.
void check_sizes(const std::string& directory, const std::vector<std::size_t>& built, const State& read);

}  // namespace erbs::analysis
