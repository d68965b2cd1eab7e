#include "lua/language/sweep/ranges.h"

#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>

#include "engine/base/text.h"

namespace erbs::lua {

std::vector<std::string> names_of(Call& call, int index) {
  std::vector<std::string> names;
  index = lua_absindex(call.lua, index);
  for (lua_pushnil(call.lua); lua_next(call.lua, index) != 0; lua_pop(call.lua, 1)) {
    if (lua_type(call.lua, -2) == LUA_TSTRING) names.push_back(shown(lua_tostring(call.lua, -2), 60));
    else call.mistake("its keys must be names of params, such as { amplitude = { 1, 2, 3 } }");
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<study::Range> range_of(Call& call, int index, const std::string& name) {
  study::Range range{name, 0, 1, false};
  lua_getfield(call.lua, index, name.c_str());
  bool valid = lua_istable(call.lua, -1) && lua_rawlen(call.lua, -1) == 2;
  for (int i = 1; valid && i <= 2; ++i) {
    valid = lua_rawgeti(call.lua, -1, i) == LUA_TNUMBER && std::isfinite(lua_tonumber(call.lua, -1));
    (i == 1 ? range.lo : range.hi) = lua_tonumber(call.lua, -1);
    lua_pop(call.lua, 1);
  }
  if (valid) {
    lua_getfield(call.lua, -1, "log");
    range.log = lua_toboolean(call.lua, -1) != 0;
    lua_pop(call.lua, 1);
  }
  lua_pop(call.lua, 1);
  if (!valid || range.lo >= range.hi) call.mistake(fmt::format("{} must be a range {{ lowest, highest }}, such as {{ 1e5, 3e5 }}", name));
  else if (range.log && range.lo <= 0) call.mistake(fmt::format("{}: a range with log = true lies above zero", name));
  else return range;
  return std::nullopt;
}

}  // namespace erbs::lua
