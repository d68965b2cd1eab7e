// The core that a thread runs on.
#pragma once
#include <sched.h>

namespace erbs {

int this_core();
// How many threads this process can run at once: the processors of its affinity mask, and no more than the quota of its control group
// (a container's). At least 1.
int usable_processors();
// Lets the scheduler find another core for the calling thread; where it may use no other, nothing happens.
void leave_core(int core);

// While it lives, the calling thread stays on a core of its own: thread `i` of as many as there are cores for the process. A scheduler that
// wakes one of them beside the other leaves it there. Where there are more cores, which are free is not known, and nothing happens.
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
