// The parts of the language written in Lua, in the order they are run.
#pragma once
#include <string_view>
#include <vector>

namespace erbs {

struct Embedded {
  std::string_view name, text;
};

const std::vector<Embedded>& embedded();

}  // namespace erbs
