#include "lua/language/api.h"

#include <malloc.h>

#include <algorithm>
#include <lua5.4/lua.hpp>

#include "engine/base/text.h"

namespace erbs::lua {

const std::vector<Function>& api() {
  static const std::vector<Function> table = [] {
    std::vector<Function> all;
    for (auto& topic :
         {block_functions(), joint_functions(), wave_functions(), load_functions(), support_functions(), analysis_functions(),
          result_functions(), stored_functions(), study_functions(), sweep_functions(), calibration_functions(), companion_functions()})
      all.insert(all.end(), topic.begin(), topic.end());
    for (const auto& topic : {wave_functions(), companion_functions()})
      for (const Function& giving : topic)
        for (Function& function : all)
          if (function.name == giving.name) function.only_gives = true;
    for (Function& function : all)
      if (function.name == "include" || function.name == "masonry_stiffness") function.only_gives = true;
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
  if (std::find(mistakes.begin(), mistakes.end(), whole) != mistakes.end()) {  // the same line in a loop
    if (++repeated >= 1000) throw Error("the same mistakes occur more than 1000 times; the rest of the script was not read");
    return;
  }
  mistakes.push_back(whole);
  if (mistakes.size() >= 50) throw Error("more than 50 mistakes; the rest of the script was not read");
}

void Context::took(size_t bytes) {
  taken += bytes;
  if (++calls < 4096 && taken < (size_t{64} << 20)) return;
  calls = taken = 0;
  const auto heap = mallinfo2();
  if (heap.uordblks + heap.hblkhd > limits.all_bytes)
    throw Error(fmt::format("the scene needs more than {} MiB of memory; build less, or does a loop never end?", limits.all_bytes >> 20));
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
  size_t length = 0;
  const char* first = lua_tolstring(lua, index, &length);
  if (length > 1000) throw Error(fmt::format("{}: {} is {} characters long; at most 1000 are allowed", function.name, what, length), place);
  const std::string text(first, length);
  if (!is_plain(text)) throw Error(fmt::format("{}: {} {}", function.name, what, not_plain(text)), place);
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

// Values beyond those that a function takes: gravity(0, 0, -9.81) would be gravity(0), and no word of it.
void refuse_more(const Call& call) {
  const Function& function = call.function;
  if (function.parameters == "...") return;
  const long most = takes_table(function) ? 1 : std::ranges::count(function.parameters, ',') + 1;
  if (lua_gettop(call.lua) <= most || lua_isnil(call.lua, static_cast<int>(most) + 1)) return;
  const std::string& name = function.name;
  call.mistake(fmt::format("{} values, where it takes {}; write {}", lua_gettop(call.lua), most,
                           takes_table(function) ? name + function.parameters : fmt::format("{}({})", name, function.parameters)));
}

int call_api(lua_State* lua, Context& context) {
  const auto* function = static_cast<const Function*>(lua_touserdata(lua, lua_upvalueindex(2)));
  Call call{context, lua, *function, current_place(lua)};
  if (context.run != nullptr && !function->only_gives)
    throw Error(fmt::format("{} changes the scene, and its run is over; call it outside the function that reads the run", function->name),
                call.place);
  const Doing doing(context.limits, call.place.text() + ": " + function->name, true);
  context.took(0);
  refuse_more(call);
  return function->call(call);
}

// Gives an error message its place in the user's files.
int place_error(lua_State* lua) {
  // An error may be any value. For a table Lua would print its address, which differs from run to run.
  if (lua_type(lua, 1) != LUA_TSTRING && luaL_getmetafield(lua, 1, "__tostring") == LUA_TNIL && !lua_isnumber(lua, 1))
    lua_pushfstring(lua, "an error that is a %s, not a message", luaL_typename(lua, 1));
  else if (lua_type(lua, 1) != LUA_TSTRING) luaL_tolstring(lua, 1, nullptr);
  {
    Context& context = context_of(lua);
    const Cap uncapped(context.limits, false);
    size_t length = 0;
    const char* text = lua_tolstring(lua, -1, &length);
    const std::string message(text, length);
    bool placed = false;
    for (const auto& file : context.files) placed = placed || message.starts_with(file + ":");
    const std::string whole = current_place(lua).text() + ": " + message;
    if (!placed) lua_pushlstring(lua, whole.data(), whole.size());
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
  context.limits.refused = {context.scene.file, 0};
  {
    const Cap capped(context.limits, true);
    status = lua_pcall(lua, arguments, results, function);
  }
  const Cap uncapped(context.limits, false);
  lua_remove(lua, function);
  if (status == LUA_OK) return;
  constexpr size_t most = 20000;  // bytes of a message: the mistakes of a large building fit
  std::string message = "an error without a message";
  if (lua_type(lua, -1) == LUA_TSTRING) {
    size_t length = 0;
    const char* text = lua_tolstring(lua, -1, &length);
    message = printable({text, std::min(length, most)}) + (length > most ? "..." : "");
  }
  lua_pop(lua, 1);
  if (status == LUA_ERRMEM)
    message = fmt::format("{}: the script needs more than {} MiB of memory; is a table or a string growing without end?",
                          context.limits.refused.text(), context.limits.bytes >> 20);
  throw Error(message);
}

void open_api(lua_State* lua) {
  for (const Function& function : api()) {
    if (function.of_study && !context_of(lua).study_file) continue;
    push_guarded(lua, call_api, &function);
    lua_setglobal(lua, function.name.c_str());
  }
}

}  // namespace erbs::lua
