// erbs test --grid: every scene at other time steps and numbers of contact points, with noise in its initial state.
#pragma once
#include "lua/program/options.h"

namespace erbs::lua {

int run_grid(const TestCommand& command);

}  // namespace erbs::lua
