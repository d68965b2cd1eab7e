// Other programs, started and waited for.
#pragma once
#include <string>
#include <vector>

namespace erbs {

std::string own_path();  // of the program that runs

struct Child {
  int pid = -1;
};
// Starts a program; with `log` its stdout and stderr go into that file. It is asked to end when the thread that started it has ended.
// Throws Error where it cannot be started.
Child start(const std::vector<std::string>& command, const std::string& log = "");
// Waits for any child; gives its pid and its exit code (128 + signal where it was killed). pid = -1: a signal came first, or there is
// no child.
struct Ended {
  int pid = -1, code = 0;
  double cpu = 0;  // s of processor, of the child and of all it waited for
};
// By another's signal or for want of memory: what it might have answered is open.
constexpr bool was_killed(int code) { return code > 128 && code != 130; }
Ended wait_for_any();
Ended wait_for_any(double seconds);  // at most this long: pid = -1 where none has ended by then
int wait_for(const Child& child);  // an interrupt that is caught meanwhile is handed on to it
void interrupt(const Child& child);  // as Ctrl-C does
void stop_hard(const Child& child);  // where it does not heed that

// Why a run of erbs gave nothing: the first line of its log that names `file`, else its last words.
std::string last_words(const std::string& log, int code, const std::string& file);

}  // namespace erbs
