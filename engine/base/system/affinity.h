// Processor affinity: on which core a thread runs, and how many cores the process may use.
#pragma once
#include <sched.h>

namespace erbs {

int this_core();
// Number of threads this process can run at once, at least 1. It counts the processors of the affinity mask, capped by the CPU quota of
// the control group (container).
int usable_processors();
// Moves the calling thread off `core`, if its affinity mask allows another core. The mask is the same afterwards.
void leave_core(int core);

// Binds the calling thread, number `i` of `threads`, to a core of its own while the object lives. Reason: a scheduler that wakes two
// threads on one core leaves them there. Threads are bound only if the process has exactly one core for each; with more
// cores it is unknown which are free.
class OwnCore {
 public:
  OwnCore(int i, int threads);
  ~OwnCore();
  OwnCore(const OwnCore&) = delete;
  OwnCore& operator=(const OwnCore&) = delete;

 private:
  cpu_set_t before_{};
  bool bound_ = false;
};

}  // namespace erbs
