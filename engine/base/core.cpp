#include "engine/base/core.h"

namespace erbs {

int this_core() { return ::sched_getcpu(); }

void leave_core(int core) {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) != 0 || core < 0 || core >= CPU_SETSIZE) return;
  cpu_set_t others = allowed;
  CPU_CLR(core, &others);
  if (CPU_COUNT(&others) == 0 || ::sched_setaffinity(0, sizeof(others), &others) != 0) return;
  ::sched_setaffinity(0, sizeof(allowed), &allowed);
}

OwnCore::OwnCore(int i, int threads) {
  if (threads < 2 || ::sched_getaffinity(0, sizeof(before_), &before_) != 0 || CPU_COUNT(&before_) != threads) return;
  int core = 0;
  for (int left = i; !CPU_ISSET(core, &before_) || left-- > 0;) ++core;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  bound_ = ::sched_setaffinity(0, sizeof(one), &one) == 0;
}

OwnCore::~OwnCore() {
  if (bound_) ::sched_setaffinity(0, sizeof(before_), &before_);
}

}  // namespace erbs
