// The core that a thread runs on.
#pragma once

namespace erbs {

int this_core();
// Lets the scheduler find another core for the calling thread; where it may use no other, nothing happens.
void leave_core(int core);

}  // namespace erbs
