#include "lua/reading/family.h"

#include <cmath>

#include "engine/base/random.h"

namespace erbs::lua {

std::vector<Choice> one_at_a_time(const ParamFamily& family) {
  std::vector<Choice> all;
  for (const auto& [name, values] : family.values)
    for (const double value : values) all.push_back({{name, value}});
  return all;
}

Choice combination(const ParamFamily& family, int i) {
  Random random{static_cast<std::uint64_t>(std::llround(family.seed)) * 0x632be59bd9b4e019u + static_cast<std::uint64_t>(i)};
  Choice choice;
  for (const auto& [name, values] : family.values)
    choice.emplace_back(name, values[static_cast<size_t>(random.uniform() * static_cast<double>(values.size()))]);
  return choice;
}

}  // namespace erbs::lua
