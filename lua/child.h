// Other programs, started by the simulator.
#pragma once
#include "engine/base/process.h"

namespace erbs {

std::string renderer_path();  // of erbs-render: beside the program, else as PATH finds it
int run_renderer(const std::vector<std::string>& arguments);

// Error where one of these is not there to be started: better before a long run than after it.
void check_programs(const std::vector<std::string>& names);

}  // namespace erbs
