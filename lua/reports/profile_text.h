// The table of `erbs run --profile`: time by phase, what limited the steps, evaluations by level.
#pragma once
#include <string>

#include "engine/analysis/dynamic.h"

namespace erbs::lua {

std::string profile_text(const analysis::RunOutcome& outcome);

}  // namespace erbs::lua
