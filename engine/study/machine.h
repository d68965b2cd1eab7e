// Peak performance of this machine, measured in the same run as the figures compared with it.
#pragma once
#include <cstddef>

namespace erbs::study {

double processor_seconds();  // s, user time of this process so far, all threads
double wall_seconds();
double machine_memory();  // bytes of main memory

double triad(std::size_t bytes);  // bytes/s of a = b + s c over three arrays of `bytes` in total, one thread; median of several
double flop_peak();               // flop/s of one core: independent multiplications and additions in registers, widest set in use

// Counts instructions of this thread in user mode, if the machine allows it.
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

}  // namespace erbs::study
