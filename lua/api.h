// THE TABLE of everything a script can call, and the guard between Lua and C++.
#pragma once
#include <string>
#include <vector>

#include "lua/input.h"
#include "lua/read.h"

namespace erbs {

struct Function;

struct Call {
  Context& context;
  lua_State* lua;
  const Function& function;
  Place place;

  Arguments arguments(int index = 1) const;  // the table handed over; throws Error where it is none
  void mistake(const std::string& what) const;
  std::string text(int index, const char* what) const;  // a positional string; throws Error where it is none
};

struct Function {
  std::string name;
  int (*call)(Call&);      // returns the number of results it pushed
  std::string parameters;  // as in a definition: "{ ... }" for one table with keys, else "name, default, text"
  std::string returns;     // "string: the name of the block"; "" for nothing
  std::string text;        // one line
  Keys keys;               // of the table, or of the positional parameters in their order
};

const std::vector<Function>& api();
const Function* find_function(const std::string& name);
bool takes_table(const Function& function);

// The topics, each a file.
std::vector<Function> block_functions();
std::vector<Function> joint_functions();
std::vector<Function> wave_functions();
std::vector<Function> load_functions();
std::vector<Function> analysis_functions();
std::vector<Function> result_functions();
std::vector<Function> study_functions();
std::vector<Function> companion_functions();

const Keys& part_keys();       // of block{ parts = { ... } }
const Keys& tolerance_keys();  // of expect(key, value, { ... })

// Pushes a C function that runs `body` with the memory cap lifted and turns an Error into a Lua error when every C++ object is
// gone: Lua's errors are jumps that run no destructors.
using Body = int (*)(lua_State*, Context&);
void push_guarded(lua_State* lua, Body body, const void* what = nullptr);

// Calls the function below `arguments` values on the stack under the memory cap; throws Error with the script's message.
void call_script(lua_State* lua, Context& context, int arguments, int results);

// Compiles text (never bytecode) into a function on the stack that sees the language and the scene's globals; throws Error.
void load_chunk(lua_State* lua, Context& context, const std::string& text, const std::string& name);

void open_api(lua_State* lua);

}  // namespace erbs
