// THE TABLE of all functions that a script can call, and the guard between Lua and C++.
#pragma once
#include <string>
#include <vector>

#include "lua/reading/input.h"
#include "lua/reading/read.h"

namespace erbs::lua {

struct Function;

struct Call {
  Context& context;
  lua_State* lua;
  const Function& function;
  Place place;

  Arguments arguments(int index = 1) const;  // the table argument; throws Error if the argument is no table
  void mistake(const std::string& what) const;
  std::string text(int index, const char* what) const;  // a positional string argument; throws Error if it is no string
};

struct Function {
  std::string name;
  int (*call)(Call&);       // returns the number of results it has pushed
  std::string parameters;   // as in a definition: "{ ... }" for one table with keys, otherwise "name, default, text"
  std::string returns;      // "string: the name of the block"; "" if the function returns nothing
  std::string text;         // one line
  Keys keys;                // keys of the table, or the positional parameters in their order
  bool of_study = false;    // a word of study files alone, which a scene may use for itself
  bool only_gives = false;  // a value, and leaves the scene as it is: after the run a metric may call it too
};

const std::vector<Function>& api();
const Function* find_function(const std::string& name);
bool takes_table(const Function& function);

// The functions by topic; each topic has its own file.
std::vector<Function> block_functions();
std::vector<Function> joint_functions();
std::vector<Function> wave_functions();
std::vector<Function> load_functions();
std::vector<Function> support_functions();
std::vector<Function> analysis_functions();
std::vector<Function> result_functions();
std::vector<Function> stored_functions();
std::vector<Function> study_functions();
std::vector<Function> sweep_functions();
std::vector<Function> calibration_functions();
std::vector<Function> companion_functions();

// Tells in check, log and manifest what has been done to the values of a record.
void note_record(Context& context, const Record& record, const Place& place);

const Keys& part_keys();       // of block{ parts = { ... } }
const Keys& tolerance_keys();  // of expect(key, value, { ... })
const Keys& stored_keys();     // of expect_stored(key, { ... })

// Pushes a C function that runs `body` with the memory cap lifted. It turns an Error into a Lua error only after all C++ objects
// are destroyed, because an error of Lua is a jump that runs no destructors.
using Body = int (*)(lua_State*, Context&);
void push_guarded(lua_State* lua, Body body, const void* what = nullptr);

// Of record{} and ground_records{}: peak or scale; a peak of 0 is no motion, where one left out is as recorded.
void check_scale(Arguments& arguments, Record& wave);
// Calls the function that lies below its `arguments` on the stack, under the memory cap. Throws Error with the script's message.
void call_script(lua_State* lua, Context& context, int arguments, int results);

// Compiles source text (never bytecode) into a function on the stack that sees the language and the scene's globals. Throws Error.
void load_chunk(lua_State* lua, Context& context, const std::string& text, const std::string& name);

void open_api(lua_State* lua);

}  // namespace erbs::lua
