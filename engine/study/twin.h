// Twin runs: two runs of one scene with a tiny difference at the start. Measures how long they agree.
#pragma once
#include <optional>
#include <string>

namespace erbs::study {

// First time (s) at which the positions of a block in the two runs differ by more than `distance` (m), from their frames. Between two
// frames the difference is assumed to grow exponentially. None if the runs stay together.
std::optional<double> parting_time(const std::string& run, const std::string& twin, double distance);

}  // namespace erbs::study
