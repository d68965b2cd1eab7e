// Checks of blocks that overlap, at rest or where the scene's initial poses put them.
#pragma once
#include <string>
#include <vector>

#include "engine/model/build/interface.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

std::vector<InterfaceBlock> interface_blocks(const Scene& scene);
// Number of overlapping pairs at which the search ends: a thousand, if overlaps are mistakes.
std::size_t most_overlaps(const Scene& scene);

// Overlaps at rest. Those of one pair of script lines share a message with a count. `cut`: the search was stopped.
void check_overlaps(const Scene& scene, const std::vector<Overlap>& overlaps, bool cut, std::vector<std::string>& errors,
                    std::vector<std::string>& warnings, std::vector<std::string>& notes);

// Overlaps at the start, of blocks with an initial position or rotation: they are thrown apart, which is seldom meant.
void warn_of_pressed_starts(const Scene& scene, const Model& m, const State& s, std::vector<std::string>& warnings);

}  // namespace erbs
