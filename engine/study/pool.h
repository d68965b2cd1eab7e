// Child processes side by side: each with its limits of time and memory. Every study starts its runs here.
#pragma once
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/system/process.h"

namespace erbs::study {

struct Job {
  std::vector<std::string> command;
  Launch how = {};
  double ask_after = 0;   // s; a run that takes longer is asked to stop, as by Ctrl-C; 0: never
  double kill_after = 0;  // s; it is killed, with all processes it has started if how.own_group; 0: never
};

struct Finished {
  std::size_t id = 0;
  int code = 0;
  double wall = 0, cpu = 0, memory = 0;  // s, s, bytes
  bool overdue = false;                  // it exceeded a limit of time
};

class Pool {
 public:
  explicit Pool(int at_once);  // runs at once; 0: one per processor
  ~Pool();                     // kills the runs that are left
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  std::size_t size() const { return at_once_; }
  bool full() const { return running_.size() >= at_once_; }
  bool empty() const { return running_.empty(); }
  void add(std::size_t id, const Job& job);
  std::optional<Finished> wait(double seconds);                                             // for the next run that ends, at most so long
  void interrupt_all();                                                                     // SIGINT to each run, once
  std::size_t first() const { return running_.empty() ? 0 : running_.begin()->second.id; }  // a run that is under way

 private:
  using Clock = std::chrono::steady_clock;
  struct Running {
    std::size_t id = 0;
    Clock::time_point begin;
    double ask_after = 0, kill_after = 0;
    bool own_group = false, asked = false, killed = false;
  };
  void hurry();
  std::size_t at_once_;
  std::map<int, Running> running_;  // by pid
  bool interrupted_ = false;
};

}  // namespace erbs::study
