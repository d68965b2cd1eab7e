// A Lua state that can only compute: libraries base, table, string, math and utf8 without access to files or system, under limits of
// memory and time.
#pragma once
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "engine/base/error.h"

struct lua_State;

namespace erbs::lua {

struct Context;

struct Limits {
  double seconds = 10;  // s, processor time of one stretch of script; other programs on the machine do not count
  size_t bytes = size_t{512} << 20;
  size_t all_bytes = size_t{2} << 30;  // with the memory of the scene outside Lua: blocks, waves
  // State of the limits
  size_t used = 0;
  lua_State* lua = nullptr;
  Place refused;        // line whose last demand for memory was refused
  bool capped = true;   // off while C++ objects are alive, so that no memory error of Lua jumps over their destructors
  double deadline = 0;  // s, processor time of this process
  std::atomic<bool> expired = false;
  std::mutex mutex;      // guards `doing`
  std::string doing;     // function and line that runs where the hook cannot interrupt it
  bool working = false;  // true: the program's own work; false: code of the script
};

// Notes for the watchdog, during its lifetime, which function runs out of reach of the hook.
class Doing {
 public:
  Doing(Limits& limits, std::string what, bool working) : limits_(limits) { set(std::move(what), working, &before_, &worked_); }
  ~Doing() { set(std::move(before_), worked_, nullptr, nullptr); }
  Doing(const Doing&) = delete;
  Doing& operator=(const Doing&) = delete;

 private:
  void set(std::string what, bool working, std::string* before, bool* worked);
  Limits& limits_;
  std::string before_;
  bool worked_ = false;
};

// A stretch of script under the time limit. The count hook stops Lua code. pcall cannot swallow its error, because every further
// instruction raises it again. No hook reaches C code that never returns, such as a string pattern of exponential cost: there a
// watchdog thread ends the process with code 2 and a message.
class Stretch {
 public:
  Stretch(lua_State* lua, Context& context);
  ~Stretch();
  Stretch(const Stretch&) = delete;
  Stretch& operator=(const Stretch&) = delete;

 private:
  double grace() const;

  lua_State* lua_;
  Context& context_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::thread watchdog_;
};

// Sets or lifts the memory cap during its lifetime.
class Cap {
 public:
  Cap(Limits& limits, bool capped) : limits_(limits), before_(limits.capped) { limits_.capped = capped; }
  ~Cap() { limits_.capped = before_; }
  Cap(const Cap&) = delete;
  Cap& operator=(const Cap&) = delete;

 private:
  Limits& limits_;
  bool before_;
};

// A new state with these libraries and without their dangerous functions. Its extra space points to the context.
lua_State* open_sandbox(Context& context);

}  // namespace erbs::lua
