// Names that a scene can use: the locked libraries, the API, and the parts of the language written in Lua.
#pragma once
#include <string>
#include <vector>

#include "lua/reading/context.h"

namespace erbs::lua {

inline constexpr const char* scene_key = "erbs.scene";  // in the registry of Lua: the globals of the scene

// Opens the language: globals of the sandbox, the API and the embedded files. The scene's globals live in a separate table above it.
void open_language(lua_State* lua, Context& context, double noise);

std::vector<std::string> lines_of(const std::string& text);  // without the empty lines

}  // namespace erbs::lua
