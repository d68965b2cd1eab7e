#include "engine/base/system/interrupt.h"

#include <csignal>

namespace erbs {
namespace {

std::atomic<bool> interrupted = false;  // global: a signal handler can access no other state

void on_signal(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, on_signal) == SIG_IGN && signal == SIGHUP) std::signal(signal, SIG_IGN);
  return interrupted;
}

bool is_interrupted() { return interrupted; }

}  // namespace erbs
