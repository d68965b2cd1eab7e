#include "lua/reading/sandbox.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <lua5.4/lua.hpp>

#include "engine/base/text.h"
#include "lua/reading/context.h"

namespace erbs::lua {

Context& context_of(lua_State* lua) { return **static_cast<Context**>(lua_getextraspace(lua)); }

namespace {

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

void* allocate(void* limits_, void* block, size_t old_size, size_t new_size) {
  Limits& limits = *static_cast<Limits*>(limits_);
  const size_t had = block ? old_size : 0;
  if (new_size == 0) {
    std::free(block);
    limits.used -= had;
    return nullptr;
  }
  if (limits.capped && new_size > had && limits.used + (new_size - had) > limits.bytes) {
    if (limits.lua) limits.refused = current_place(limits.lua);
    return nullptr;
  }
  void* moved = std::realloc(block, new_size);
  if (moved) limits.used += new_size - had;
  return moved;
}

constexpr size_t most_printed = size_t{1} << 20;  // bytes a script may print

// Runs every thousand instructions, and at every instruction once the time is over.
void count_hook(lua_State* lua, lua_Debug*) {
  Limits& limits = context_of(lua).limits;
  if (!limits.expired && processor_seconds() < limits.deadline) return;
  limits.expired = true;
  lua_sethook(lua, count_hook, LUA_MASKCOUNT, 1);
  luaL_where(lua, 0);
  lua_pushfstring(lua, "the script ran longer than %d s; a loop may never end: look at its condition", static_cast<int>(limits.seconds));
  lua_concat(lua, 2);
  lua_error(lua);
}

// The pattern functions of `string` run in C, where no hook interrupts them. Notes their line first, for the watchdog's message.
int noted(lua_State* lua) {
  {
    Limits& limits = context_of(lua).limits;
    const Cap uncapped(limits, false);
    const Place place = current_place(lua);
    const std::lock_guard lock(limits.mutex);
    limits.doing = place.text() + ": " + lua_tostring(lua, lua_upvalueindex(2));
    limits.working = false;
  }
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_insert(lua, 1);
  lua_call(lua, lua_gettop(lua) - 1, LUA_MULTRET);
  {
    Limits& limits = context_of(lua).limits;
    const std::lock_guard lock(limits.mutex);
    limits.doing.clear();
  }
  return lua_gettop(lua);
}

// Refuses finalizers, because no hook could interrupt them.
int safe_setmetatable(lua_State* lua) {
  if (lua_istable(lua, 2)) {
    lua_pushliteral(lua, "__gc");
    if (lua_rawget(lua, 2) != LUA_TNIL) return luaL_error(lua, "a metatable with __gc is not available in scenes");
    lua_pop(lua, 1);
  }
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_insert(lua, 1);
  lua_call(lua, lua_gettop(lua) - 1, LUA_MULTRET);
  return lua_gettop(lua);
}

// Requires a seed. Without one Lua would use the clock, but the same scene must give the same run.
int safe_randomseed(lua_State* lua) {
  luaL_checknumber(lua, 1);
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_insert(lua, 1);
  lua_call(lua, lua_gettop(lua) - 1, 0);
  return 0;
}

// Pushes a value as text. Of a table or a function that is its type alone: addresses differ from run to run, but the same scene must
// give the same run.
void push_text(lua_State* lua, int index) {
  const int type = lua_type(lua, index);
  if (type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING) {
    luaL_tolstring(lua, index, nullptr);
  } else if (luaL_getmetafield(lua, index, "__tostring") != LUA_TNIL) {
    lua_pop(lua, 1);
    luaL_tolstring(lua, index, nullptr);
  } else lua_pushstring(lua, lua_typename(lua, type));
}

int safe_tostring(lua_State* lua) {
  luaL_checkany(lua, 1);
  push_text(lua, 1);
  return 1;
}

// string.format whose %s gives no address either. %p would give nothing else.
int safe_format(lua_State* lua) {
  size_t length = 0;
  const char* at = luaL_checklstring(lua, 1, &length);
  const char* const end = at + length;
  for (int argument = 1; at < end; ++at) {
    if (*at != '%') continue;
    do ++at;
    while (at < end && *at != '\0' && std::strchr("-+ #0123456789.", *at) != nullptr);
    if (at == end || *at == '%') continue;
    ++argument;
    if (*at == 'p') return luaL_error(lua, "%%p is not available in scenes, since addresses differ from run to run");
    if (*at == 's' && argument <= lua_gettop(lua)) {
      push_text(lua, argument);
      lua_replace(lua, argument);
    }
  }
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_insert(lua, 1);
  lua_call(lua, lua_gettop(lua) - 1, 1);
  return 1;
}

int print(lua_State* lua) {
  const int n = lua_gettop(lua);
  luaL_Buffer line;
  luaL_buffinit(lua, &line);
  for (int i = 1; i <= n; ++i) {
    if (i > 1) luaL_addchar(&line, '\t');
    push_text(lua, i);
    luaL_addvalue(&line);
  }
  luaL_pushresult(&line);
  Context& context = context_of(lua);
  size_t length = 0;
  const char* text = lua_tolstring(lua, -1, &length);
  context.printed += length + 1;
  if (context.printed > most_printed) return luaL_error(lua, "the script printed more than 1 MiB; print less");
  const Cap uncapped(context.limits, false);
  context.output.push_back(printable({text, length}));
  if (!context.quiet) tell(stderr, context.output.back());
  return 0;
}

void wrap(lua_State* lua, const char* library, const char* name, lua_CFunction wrapper) {
  lua_getglobal(lua, library);
  lua_getfield(lua, -1, name);
  lua_pushfstring(lua, "%s.%s", library, name);
  lua_pushcclosure(lua, wrapper, 2);
  lua_setfield(lua, -2, name);
  lua_pop(lua, 1);
}

void open_libraries(lua_State* lua) {
  const luaL_Reg libraries[] = {{LUA_GNAME, luaopen_base},
                                {LUA_TABLIBNAME, luaopen_table},
                                {LUA_STRLIBNAME, luaopen_string},
                                {LUA_MATHLIBNAME, luaopen_math},
                                {LUA_UTF8LIBNAME, luaopen_utf8}};
  for (const auto& library : libraries) {
    luaL_requiref(lua, library.name, library.func, 1);
    lua_pop(lua, 1);
  }
  for (const char* name : {"load", "loadfile", "loadstring", "dofile", "require", "collectgarbage", "warn"}) {
    lua_pushnil(lua);
    lua_setglobal(lua, name);
  }
  lua_getglobal(lua, LUA_STRLIBNAME);
  lua_pushnil(lua);
  lua_setfield(lua, -2, "dump");
  lua_pop(lua, 1);
  for (const char* name : {"find", "match", "gmatch", "gsub"}) wrap(lua, LUA_STRLIBNAME, name, noted);
  for (const char* name : {"concat", "move", "sort", "unpack"}) wrap(lua, LUA_TABLIBNAME, name, noted);
  wrap(lua, LUA_GNAME, "setmetatable", safe_setmetatable);
  wrap(lua, LUA_MATHLIBNAME, "randomseed", safe_randomseed);
  wrap(lua, LUA_STRLIBNAME, "format", safe_format);
  lua_pushcfunction(lua, safe_tostring);
  lua_setglobal(lua, "tostring");
  lua_pushcfunction(lua, print);
  lua_setglobal(lua, "print");
  lua_getglobal(lua, LUA_MATHLIBNAME);
  lua_getfield(lua, -1, "randomseed");
  lua_pushinteger(lua, 1);
  lua_call(lua, 1, 0);
  lua_pop(lua, 1);
}

}  // namespace

void Doing::set(std::string what, bool working, std::string* before, bool* worked) {
  const std::lock_guard lock(limits_.mutex);
  if (before) *before = std::move(limits_.doing), *worked = limits_.working;
  limits_.doing = std::move(what);
  limits_.working = working;
}

lua_State* open_sandbox(Context& context) {
  lua_State* lua = lua_newstate(allocate, &context.limits);
  if (!lua) throw Error("no memory for a Lua state");
  *static_cast<Context**>(lua_getextraspace(lua)) = &context;
  lua_atpanic(lua, [](lua_State* state) -> int {
    std::fprintf(stderr, "internal error: Lua outside a protected call: %s; please report it\n", lua_tostring(state, -1));
    return 0;
  });
  open_libraries(lua);
  context.limits.lua = lua;
  return lua;
}

Stretch::Stretch(lua_State* lua, Context& context) : lua_(lua), context_(context) {
  Limits& limits = context.limits;
  limits.expired = false;
  limits.deadline = processor_seconds() + limits.seconds;
  lua_sethook(lua, count_hook, LUA_MASKCOUNT, 1000);
  watchdog_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    while (processor_seconds() < context_.limits.deadline + grace())
      if (ended_.wait_for(lock, std::chrono::milliseconds(100), [this] { return done_; })) return;
    std::string doing;
    bool working = false;
    {
      const std::lock_guard noted_lock(context_.limits.mutex);
      doing = context_.limits.doing;
      working = context_.limits.working;
    }
    tell(stderr,
         fmt::format("{}: the script ran longer than {:g} s; {}", doing.empty() ? context_.scene.file : doing, context_.limits.seconds,
                     working ? "that is more work than a scene may ask for: give it less" : "a pattern or a loop there may never end"));
    std::fflush(stderr);
    _exit(2);
  });
}

// s after the deadline. A script's hook should act first, because it gives a better message; our own work has no hook.
double Stretch::grace() const {
  const std::lock_guard lock(context_.limits.mutex);
  return context_.limits.working ? 0.2 : 1;
}

Stretch::~Stretch() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  watchdog_.join();
  lua_sethook(lua_, nullptr, 0, 0);
}

}  // namespace erbs::lua
