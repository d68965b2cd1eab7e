// Requests to end the program: Ctrl-C, kill, a closed terminal.
#pragma once
#include <atomic>
#include <stdexcept>

namespace erbs {

// From the first call on, SIGINT, SIGTERM and SIGHUP set the returned flag instead of ending the program. A second signal of the same
// kind ends it. SIGHUP stays ignored under nohup.
const std::atomic<bool>& catch_interrupts();
// Whether a signal has come. Always false without `catch_interrupts`.
bool is_interrupted();

// Thrown by work that a signal has ended. Exit code 130.
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace erbs
