// Whether a checkpoint is of the run that is to go on from it.
#pragma once
#include <string>
#include <vector>

#include "engine/model/state.h"

namespace erbs {

// Error where the run in the folder was started with other words than `departures`, as far as its manifest.json says.
void check_departures(const std::string& directory, const std::vector<std::string>& departures);

// How many blocks, joints and points a state is of, and what else follows from the model.
std::vector<std::size_t> sizes_of(const State& state);

// Error where a state that was read has other sizes than the one built from the scene.
void check_sizes(const std::string& directory, const std::vector<std::size_t>& built, const State& read);

}  // namespace erbs
