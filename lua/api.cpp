#include "lua/api.h"

#include <algorithm>
#include <fstream>
#include <lua5.4/lua.hpp>
#include <sstream>

#include "engine/base/hash.h"

namespace erbs {

const std::vector<Function>& api() {
  static const std::vector<Function> table = [] {
    std::vector<Function> all;
    for (auto& topic : {block_functions(), joint_functions(), wave_functions(), load_functions(), analysis_functions(), result_functions(),
                        study_functions(), companion_functions()})
      all.insert(all.end(), topic.begin(), topic.end());
    return all;
  }();
  return table;
}

const Function* find_function(const std::string& name) {
  for (const Function& function : api())
    if (function.name == name) return &function;
  return nullptr;
}

bool takes_table(const Function& function) { return function.parameters.starts_with("{"); }

void Context::mistake(const Place& place, const std::string& message) {
  const std::string whole = place.file.empty() ? message : place.text() + ": " + message;
  if (std::find(mistakes.begin(), mistakes.end(), whole) != mistakes.end()) return;  // the same line in a loop
  mistakes.push_back(whole);
  if (mistakes.size() >= 50) throw Error("more than 50 mistakes; the rest of the script was not read");
}

Place current_place(lua_State* lua) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(lua, level, &frame) != 0; ++level) {
    lua_getinfo(lua, "Sl", &frame);
    if (frame.source[0] == '@' && frame.currentline > 0) return {frame.source + 1, frame.currentline};
  }
  return {context_of(lua).scene.file, 0};
}

Arguments Call::arguments(int index) const {
  if (!lua_istable(lua, index))
    throw Error(fmt::format("{} takes a table of keys, not {}; write {}{{ ... }}", function.name, described(lua, index), function.name),
                place);
  return Arguments(context, lua, index, function.name, place, function.keys);
}

void Call::mistake(const std::string& what) const { context.mistake(place, function.name + ": " + what); }

std::string Call::text(int index, const char* what) const {
  if (lua_type(lua, index) != LUA_TSTRING)
    throw Error(fmt::format("{}: {} must be a string, not {}; write {}({})", function.name, what, described(lua, index), function.name,
                            function.parameters),
                place);
  const std::string text = lua_tostring(lua, index);
  if (text.size() > 1000)
    throw Error(fmt::format("{}: {} is {} characters long; at most 1000 are allowed", function.name, what, text.size()), place);
  return text;
}

namespace {

int guarded(lua_State* lua) {
  int results = -1;
  {
    Context& context = context_of(lua);
    const Cap uncapped(context.limits, false);
    const auto body = *static_cast<Body*>(lua_touserdata(lua, lua_upvalueindex(1)));
    try {
      if (!lua_checkstack(lua, 50)) throw Error("calls are nested too deeply", current_place(lua));
      results = body(lua, context);
    } catch (const std::exception& error) {
      lua_settop(lua, 0);
      lua_pushstring(lua, error.what());
    }
  }
  return results >= 0 ? results : lua_error(lua);
}

int call_api(lua_State* lua, Context& context) {
  const auto* function = static_cast<const Function*>(lua_touserdata(lua, lua_upvalueindex(2)));
  Call call{context, lua, *function, current_place(lua)};
  return function->call(call);
}

// Gives an error message its place in the user's files.
int place_error(lua_State* lua) {
  if (lua_type(lua, 1) != LUA_TSTRING) luaL_tolstring(lua, 1, nullptr);
  {
    Context& context = context_of(lua);
    const Cap uncapped(context.limits, false);
    const std::string message = lua_tostring(lua, -1);
    bool placed = false;
    for (const auto& file : context.files) placed = placed || message.starts_with(file + ":");
    if (!placed) lua_pushstring(lua, (current_place(lua).text() + ": " + message).c_str());
  }
  return 1;
}

}  // namespace

void push_guarded(lua_State* lua, Body body, const void* what) {
  *static_cast<Body*>(lua_newuserdatauv(lua, sizeof(Body), 0)) = body;
  lua_pushlightuserdata(lua, const_cast<void*>(what));
  lua_pushcclosure(lua, guarded, 2);
}

void call_script(lua_State* lua, Context& context, int arguments, int results) {
  const int function = lua_gettop(lua) - arguments;
  lua_pushcfunction(lua, place_error);
  lua_insert(lua, function);
  int status = LUA_OK;
  {
    const Cap capped(context.limits, true);
    status = lua_pcall(lua, arguments, results, function);
  }
  const Cap uncapped(context.limits, false);
  lua_remove(lua, function);
  if (status == LUA_OK) return;
  std::string message = lua_type(lua, -1) == LUA_TSTRING ? lua_tostring(lua, -1) : "an error without a message";
  lua_pop(lua, 1);
  if (status == LUA_ERRMEM)
    message = fmt::format("{}: the script needs more than {} MiB of memory; is a table or a string growing without end?",
                          context.scene.file, context.limits.bytes >> 20);
  throw Error(message);
}

void open_api(lua_State* lua) {
  for (const Function& function : api()) {
    push_guarded(lua, call_api, &function);
    lua_setglobal(lua, function.name.c_str());
  }
}

std::filesystem::path find_input(const Context& context, const std::string& file, const Place& place) {
  namespace fs = std::filesystem;
  const fs::path name(file);
  std::vector<fs::path> tried;
  if (name.is_absolute()) {
    tried = {name};
  } else {
    tried = {context.folder / name};
    std::error_code ignored;
    for (fs::path above = fs::weakly_canonical(context.folder.empty() ? fs::path(".") : context.folder, ignored);
         above != above.root_path(); above = above.parent_path())
      if (above.filename() == "scenes") tried.push_back(above / name);
    tried.push_back(fs::path("scenes") / name);
  }
  for (const auto& path : tried)
    if (fs::is_regular_file(path)) return path;
  std::vector<std::string> list;
  for (const auto& path : tried) list.push_back(path.string());
  throw Error(fmt::format("file \"{}\" is not there; looked for {}; correct the name, or put the file beside the scene", file,
                          fmt::join(list, ", ")),
              place);
}

std::string read_input(Context& context, const std::filesystem::path& path, const Place& place) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  // an empty file sets the failbit of text, and is none of our business here
  if (!stream || (stream.peek() != std::ifstream::traits_type::eof() && !(text << stream.rdbuf())))
    throw Error(fmt::format("cannot read {}", path.string()), place);
  context.scene.inputs[path.string()] = hash_text(fnv1a(text.str()));
  return text.str();
}

}  // namespace erbs
