// fragility = { ... } of study{}.
#pragma once
#include "engine/study/sweep/design.h"
#include "lua/reading/read.h"

namespace erbs::lua {

const Keys& fragility_keys();
// Reads the table into plan.fragility, and the keys that it needs into plan.collect; axes and bisection of the plan are known.
void read_fragility(Arguments& table, study::Plan& plan);

}  // namespace erbs::lua
