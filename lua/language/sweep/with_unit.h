// A number in SI, or text with a unit.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "lua/language/api.h"

namespace erbs::lua {

// The value of a key of the call's table, as a number or as text such as "5m". `factors`: the units. 0 and a mistake for anything else.
double quantity(Arguments& arguments, Call& call, const char* key, const std::vector<std::pair<std::string, double>>& factors);

}  // namespace erbs::lua
