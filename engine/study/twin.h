// Two runs of one scene that differ by a hair in their start: for how long they tell the same story.
#pragma once
#include <optional>
#include <string>

namespace erbs {

// The first time (s) at which a block stands further apart than `distance` (m) in the two runs, from their frames; between two
// frames the distance is taken to grow exponentially. None where they stay together.
std::optional<double> parting_time(const std::string& run, const std::string& twin, double distance);

}  // namespace erbs
