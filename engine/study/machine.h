// What this machine can do at most, measured in the run that is compared with it.
#pragma once
#include <cstddef>

namespace erbs {

double processor_seconds();  // s, user time of this process so far, all threads
double wall_seconds();

double triad(std::size_t bytes);  // bytes/s of a = b + s c over three arrays of `bytes` together, one thread; median of several
double flop_peak();               // flop/s of one core: independent multiplications and additions in registers of the widest kind in use

// Instructions of this thread in user mode, where the machine lets a program count them.
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  bool works() const { return file_ >= 0; }
  double read() const;

 private:
  int file_ = -1;
};

}  // namespace erbs
