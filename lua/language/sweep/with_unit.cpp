#include "lua/language/sweep/with_unit.h"

#include <algorithm>
#include <cstdlib>
#include <lua5.4/lua.hpp>

namespace erbs::lua {

double quantity(Arguments& arguments, Call& call, const char* key, const std::vector<std::pair<std::string, double>>& factors) {
  lua_getfield(call.lua, 1, key);
  double value = lua_type(call.lua, -1) == LUA_TNUMBER ? lua_tonumber(call.lua, -1) : 0;
  if (lua_type(call.lua, -1) == LUA_TSTRING) {
    const std::string text = lua_tostring(call.lua, -1);
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    const std::string unit = end;
    const auto found = std::find_if(factors.begin(), factors.end(), [&](const auto& factor) { return factor.first == unit; });
    value = found == factors.end() ? 0 : value * found->second;
  }
  const bool given = !lua_isnil(call.lua, -1);
  lua_pop(call.lua, 1);
  if (given && !(value > 0 && value < 1e18)) {
    std::string units;
    for (const auto& [name, factor] : factors) units += (units.empty() ? "" : ", ") + name;
    arguments.mistake(
        fmt::format("{} must be a number above 0, or text with one of the units {}, such as \"5{}\"", key, units, factors.back().first));
    return 0;
  }
  return value;
}

}  // namespace erbs::lua
