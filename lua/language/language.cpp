#include "lua/language/language.h"

#include <algorithm>
#include <lua5.4/lua.hpp>
#include <sstream>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "lua/language/api.h"
#include "lua/masonry/embedded.h"

namespace erbs::lua {
namespace {

const char* const language_key = "erbs.language";  // in the registry: the globals of the language
const char* const view_key = "erbs.view";          // in the registry: the same, with locked libraries

// All names of the language, for suggestions.
std::vector<std::string> known_names(lua_State* lua) {
  std::vector<std::string> names;
  lua_getfield(lua, LUA_REGISTRYINDEX, language_key);
  for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1))
    if (lua_type(lua, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(lua, -2));
  lua_pop(lua, 1);
  std::sort(names.begin(), names.end());
  return names;
}

// Called when a script reads an unknown global.
int unknown_global(lua_State* lua, Context&) {
  const std::string name = lua_type(lua, 2) == LUA_TSTRING ? shown(lua_tostring(lua, 2), 60) : described(lua, 2);
  for (const Function& function : api())
    if (function.of_study && function.name == name)
      throw Error(
          fmt::format("{} belongs in a study, a file of its own for erbs sweep, and not for the other commands; see erbs help study", name),
          current_place(lua));
  const std::string near = nearest(name, known_names(lua));
  throw Error(
      fmt::format("unknown name \"{}\"{}", name,
                  near.empty() ? "; set it before, or see erbs help for the names there are" : fmt::format("; did you mean \"{}\"?", near)),
      current_place(lua));
}

// Called when a script sets a global: names of the language cannot be redefined.
int set_global(lua_State* lua, Context&) {
  lua_getfield(lua, LUA_REGISTRYINDEX, language_key);
  lua_pushvalue(lua, 2);
  if (lua_rawget(lua, -2) != LUA_TNIL)
    throw Error(fmt::format("\"{}\" is a name of the language; write local {} = ..., or take another name", lua_tostring(lua, 2),
                            lua_tostring(lua, 2)),
                current_place(lua));
  lua_settop(lua, 3);
  lua_rawset(lua, 1);
  return 0;
}

// Called when a script sets a function of a library: the language itself depends on the libraries.
int set_library(lua_State* lua, Context&) {
  throw Error("the libraries string, table, math and utf8 cannot be changed; write local my = { ... } for functions of your own",
              current_place(lua));
}

// Sets the metatable of the table at `index`: missing names are read by `read`, otherwise from the table `behind` in the registry.
void set_metatable(lua_State* lua, int index, const char* behind, Body read, Body write) {
  index = lua_absindex(lua, index);
  lua_newtable(lua);
  if (read) {
    push_guarded(lua, read);
  } else {
    lua_getfield(lua, LUA_REGISTRYINDEX, behind);
  }
  lua_setfield(lua, -2, "__index");
  if (write) {
    push_guarded(lua, write);
    lua_setfield(lua, -2, "__newindex");
  }
  lua_pushliteral(lua, "locked");
  lua_setfield(lua, -2, "__metatable");
  lua_setmetatable(lua, index);
}

// Pushes the view of a scene behind its own globals: the language, with libraries that a scene cannot change. The parts of the
// language written in Lua use the libraries themselves.
void push_view(lua_State* lua) {
  lua_newtable(lua);
  for (const char* name : {LUA_TABLIBNAME, LUA_STRLIBNAME, LUA_MATHLIBNAME, LUA_UTF8LIBNAME}) {
    lua_newtable(lua);
    lua_newtable(lua);
    lua_getfield(lua, LUA_REGISTRYINDEX, language_key);
    lua_getfield(lua, -1, name);
    lua_remove(lua, -2);
    lua_setfield(lua, -2, "__index");
    push_guarded(lua, set_library);
    lua_setfield(lua, -2, "__newindex");
    lua_pushliteral(lua, "locked");
    lua_setfield(lua, -2, "__metatable");
    lua_setmetatable(lua, -2);
    lua_setfield(lua, -2, name);
  }
  set_metatable(lua, -1, language_key, nullptr, nullptr);
  lua_pushliteral(lua, "");
  lua_getmetatable(lua, -1);  // metatable of strings: its __index would expose the library
  lua_pushliteral(lua, "locked");
  lua_setfield(lua, -2, "__metatable");
  lua_pop(lua, 2);
}

// Functions for the parts of the language that are written in Lua: did_you_mean(word, names), escaped(text), note_mistakes(lines),
// widen_joint(joint, width) and empty_group(name).
int suggest(lua_State* lua, Context&) {
  std::vector<std::string> names;
  const auto n = static_cast<lua_Integer>(lua_rawlen(lua, 2));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(lua, 2, i);
    names.emplace_back(lua_tostring(lua, -1));
    lua_pop(lua, 1);
  }
  lua_pushstring(lua, did_you_mean(lua_tostring(lua, 1), names).c_str());
  return 1;
}

// Text with its control characters escaped; plain text stays as it is.
int escaped(lua_State* lua, Context&) {
  size_t length = 0;
  const char* text = lua_tolstring(lua, 1, &length);
  const std::string plain = shown({text, length}, 1000);
  lua_pushlstring(lua, plain.data(), plain.size());
  return 1;
}

int note_mistakes(lua_State* lua, Context& context) {
  for (const auto& line : lines_of(lua_tostring(lua, 1))) context.mistake(current_place(lua), line);
  context.incomplete = true;
  return 0;
}

// widen_joint(joint, width), in m: the last block has a head joint of `width` beside it, where its masonry has joints of `joint`.
int widen_joint(lua_State* lua, Context& context) {
  Block& block = context.scene.blocks.back();
  block.joint = lua_tonumber(lua, 1);
  block.widest_joint = std::max(block.widest_joint, lua_tonumber(lua, 2));
  return 0;
}

// empty_group(name): a builder made no blocks of this group, such as lintels of a wall without openings. Joint rules may name it.
int empty_group(lua_State* lua, Context& context) {
  std::vector<std::string>& groups = context.scene.empty_groups;
  if (const std::string name = lua_tostring(lua, 1); std::find(groups.begin(), groups.end(), name) == groups.end()) groups.push_back(name);
  return 0;
}

constexpr std::pair<const char*, Body> inner_functions[] = {{"did_you_mean", suggest},
                                                            {"escaped", escaped},
                                                            {"note_mistakes", note_mistakes},
                                                            {"widen_joint", widen_joint},
                                                            {"empty_group", empty_group}};

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

void open_language(lua_State* lua, Context& context, double noise) {
  open_values(lua);
  lua_pushnumber(lua, noise);
  lua_setglobal(lua, "start_noise");
  open_api(lua);
  lua_pushglobaltable(lua);
  lua_pushvalue(lua, -1);
  lua_setfield(lua, LUA_REGISTRYINDEX, language_key);
  for (const auto& [name, body] : inner_functions) {
    push_guarded(lua, body);
    lua_setglobal(lua, name);
  }
  for (const Embedded& file : embedded()) {
    const std::string name = "=" + std::string(file.name);
    if (luaL_loadbufferx(lua, file.text.data(), file.text.size(), name.c_str(), "t") != LUA_OK)
      throw std::logic_error(fmt::format("internal error: {}", lua_tostring(lua, -1)));
    call_script(lua, context, 0, 0);
  }
  for (const auto& [name, body] : inner_functions) {
    lua_pushnil(lua);
    lua_setglobal(lua, name);
  }
  set_metatable(lua, -1, nullptr, unknown_global, nullptr);
  push_view(lua);
  lua_setfield(lua, LUA_REGISTRYINDEX, view_key);
  lua_newtable(lua);
  set_metatable(lua, -1, view_key, nullptr, set_global);
  lua_pushvalue(lua, -1);
  lua_setfield(lua, LUA_REGISTRYINDEX, scene_key);
  lua_setfield(lua, -2, "_G");
  lua_pop(lua, 1);
}

}  // namespace erbs::lua
