// Being asked to end: Ctrl-C, kill, a terminal that closes.
#pragma once
#include <atomic>
#include <stdexcept>

namespace erbs {

// From the first call on SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored) set what is returned instead of ending the program; a
// second signal of a kind ends it.
const std::atomic<bool>& catch_interrupts();
// Whether one came. False where none are caught.
bool is_interrupted();

// Work that was left because of one; ends the program with code 130.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace erbs
