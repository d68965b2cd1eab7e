// What this machine can do at most, measured in the run that is compared with it.
#pragma once
#include <cstddef>

namespace erbs {

double processor_seconds();  // s, user time of this process so far, all threads
double wall_seconds();

double triad(std::size_t bytes);  // bytes/s of a = b + s c over three arrays of `bytes` together, one thread; median of several
double flop_peak();               // flop/s of one core: independent multiplications and additions in registers of the widest kind in use

}  // namespace erbs
