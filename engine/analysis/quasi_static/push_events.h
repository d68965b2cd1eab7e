// Rows of events.csv of a push: joints that are cracked, open or have slid in a state of equilibrium and were not in those before it.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/record/folder/run_writer.h"

namespace erbs::analysis {

// `happened`: of each joint, what has been told of it; empty at the start. t (s): of the state in the run folder.
void write_push_events(std::vector<std::uint8_t>& happened, const Model& model, const JointState& joints, const BlockPoses& pose, double t,
                       RunWriter& writer);

}  // namespace erbs::analysis
