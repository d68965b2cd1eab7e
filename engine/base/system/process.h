// Child processes: start them, wait for them, end them.
#pragma once
#include <string>
#include <vector>

namespace erbs {

std::string own_path();  // of this executable

struct Child {
  int pid = -1;
};
// Starts a program; with `log` its stdout and stderr go into that file. The child gets SIGTERM when the thread that started it ends.
// Throws Error if the program cannot be started.
Child start(const std::vector<std::string>& command, const std::string& log = "");
// A child that has ended: its pid and exit code (128 + signal if a signal killed it). pid = -1: a signal interrupted the wait, or there
// is no child.
struct Ended {
  int pid = -1, code = 0;
  double cpu = 0;  // s, processor time of the child and of all processes it waited for
};
// Killed by a foreign signal or for lack of memory: the result is unknown. 130 is an interrupt of the user.
constexpr bool was_killed(int code) { return code > 128 && code != 130; }
Ended wait_for_any();
Ended wait_for_any(double seconds);  // waits at most so long; pid = -1 if no child has ended by then
int wait_for(const Child& child);    // exit code; forwards a caught interrupt to the child
void interrupt(const Child& child);  // SIGINT, like Ctrl-C
void stop_hard(const Child& child);  // SIGKILL, for a child that ignores SIGINT

// Reason why a run of erbs gave no result: the signal, else the first line of its log that names `file`, else the last line.
std::string last_words(const std::string& log, int code, const std::string& file);

}  // namespace erbs
