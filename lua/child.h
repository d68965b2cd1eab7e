// The renderer, started by the simulator.
#pragma once
#include "engine/base/process.h"

namespace erbs {

std::string renderer_path();  // of erbs-render: beside the program, else as PATH finds it
int run_renderer(const std::vector<std::string>& arguments);

}  // namespace erbs
