// A Lua state that can only compute: base, table, string, math and utf8 without what reaches outside, memory and time capped.
#pragma once
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

struct lua_State;

namespace erbs {

struct Context;

struct Limits {
  double seconds = 10;  // processor time of one stretch of script: a busy machine takes nothing from it
  size_t bytes = size_t{512} << 20;
  size_t all_bytes = size_t{2} << 30;  // with what the program keeps for the scene: blocks, waves
  // State of the limits
  size_t used = 0;
  bool capped = true;  // lifted while C++ objects are alive, so that no memory error of Lua jumps over them
  double deadline = 0;  // s, processor time of this process
  std::atomic<bool> expired = false;
  std::mutex mutex;   // guards `doing`
  std::string doing;  // the function (and its line) that runs outside the reach of the hook
  bool working = false;  // it is work of ours, no loop of the script's
};

// Notes for the watchdog what runs out of the hook's reach, for as long as it lives.
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

// A stretch of script under the time limit. The count hook stops Lua code (pcall cannot swallow it: once the time is over every
// further instruction raises the error again). Code in C that never returns, such as a string pattern of exponential cost, is
// beyond any hook: a watchdog thread then ends the process with code 2 and a message.
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

// Lifts or sets the memory cap for the life of the object.
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

// A new state with the libraries above opened and what is dangerous removed. Its extra space points to the context.
lua_State* open_sandbox(Context& context);

}  // namespace erbs
