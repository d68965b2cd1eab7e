// What a scene sees: the libraries, locked; the table of the API; and the parts of the language written in Lua.
#pragma once
#include <string>
#include <vector>

#include "lua/context.h"

namespace erbs {

inline constexpr const char* scene_key = "erbs.scene";  // in the registry of Lua: the globals of the scene

// The language is the sandbox's globals, the API and the embedded files; the scene's globals lie in a table of their own over it.
void open_language(lua_State* lua, Context& context, double noise);

std::vector<std::string> lines_of(const std::string& text);  // those that are not empty

}  // namespace erbs
