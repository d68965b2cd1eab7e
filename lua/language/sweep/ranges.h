// Tables of a study file whose keys are names of params: { ft = { 1e5, 3e5 }, kn = { 1e9, 1e12, log = true } }.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/study/sweep/design.h"
#include "lua/language/api.h"

namespace erbs::lua {

// The string keys of the table at `index`, in alphabetical order; a key of another type is a mistake.
std::vector<std::string> names_of(Call& call, int index);
// The range of the param `name` in the table at `index`; none, and a mistake, if it is no range.
std::optional<study::Range> range_of(Call& call, int index, const std::string& name);

}  // namespace erbs::lua
