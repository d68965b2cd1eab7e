// Child processes: start them, exchange bytes with them, wait for them, end them.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace erbs {

std::string own_path();                   // of this executable; start() starts it even if an update has replaced its file since
std::string own_folder();                 // where this executable lay when it was started
bool can_start(const std::string& name);  // a path, or a name that PATH finds

struct Child {
  int pid = -1;
  int to = -1, from = -1;  // our ends of the pipes to its input and from its output; -1: no pipe
};

// How a program is started. Its standard streams are those of this program where nothing else is said.
struct Launch {
  std::string output = {}, errors = {};  // files for stdout and stderr
  std::string folder = {};               // its working folder
  std::string remedy = {};               // end of the message if it cannot be started
  bool fed = false;                      // its standard input is Child::to
  bool heard = false;                    // its standard output is Child::from
  bool own_group = false;                // Ctrl-C does not reach it
  bool bound_hard = false;               // it gets SIGKILL, not SIGTERM, when the thread that started it ends
  double memory = 0;                     // bytes that its data may take; 0: no limit
};
// Starts a program. It gets SIGTERM when the thread that started it ends. Throws Error if it cannot be started.
Child start(const std::vector<std::string>& command, const Launch& how);
Child start(const std::vector<std::string>& command, const std::string& log = "");  // with `log`, stdout and stderr go into that file
// A copy of this process that calls `body` with its ends of both pipes, and ends. It is killed when the thread that started it ends.
// Throws Error.
Child start_copy(const std::function<void(int from, int to)>& body);

// Send or receive all `count` bytes; false if the other end has closed the pipe.
bool send(int pipe, const void* bytes, std::size_t count);
bool receive(int pipe, void* bytes, std::size_t count);

// A child that has ended: its pid and exit code (128 + signal if a signal killed it). pid = -1: a signal interrupted the wait, or there
// is no child.
struct Ended {
  int pid = -1, code = 0;
  double cpu = 0;     // s, processor time of the child and of all processes it waited for
  double memory = 0;  // bytes, peak of the child or of one it waited for
};
// Killed by a foreign signal or for lack of memory: the result is unknown. 130 is an interrupt of the user.
constexpr bool was_killed(int code) { return code > 128 && code != 130; }
// Waits until one of these children ends, at most so long; pid = -1 if none has ended by then.
Ended wait_for_one(const std::vector<int>& pids, double seconds);
int wait_for(const Child& child);     // exit code; forwards a caught interrupt to the child
void end_input(Child& child);         // closes the pipe to its input
int finish(Child& child);             // closes the pipes and returns the exit code; leaves interrupts to the child
void interrupt(const Child& child);   // SIGINT, like Ctrl-C
void stop_hard(const Child& child);   // SIGKILL, for a child that ignores SIGINT
void stop_group(const Child& child);  // SIGKILL for a child with own_group and all processes it has started

// Reason why a run of erbs gave no result: the signal, else the first line of its log that names `file`, else the last line.
std::string last_words(const std::string& log, int code, const std::string& file);

}  // namespace erbs
