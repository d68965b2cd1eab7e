// The parts of the language that are written in Lua, in the order in which they are run.
#pragma once
#include <string_view>
#include <vector>

namespace erbs::lua {

struct Embedded {
  std::string_view name, text;
};

const std::vector<Embedded>& embedded();

}  // namespace erbs::lua
