// Other programs: the renderer, and this one again for tests.
#pragma once
#include <string>
#include <vector>

namespace erbs {

std::string own_path();       // of the program that runs
std::string renderer_path();  // of erbs-render: beside the program, else as PATH finds it

struct Child {
  int pid = -1;
};
// Starts a program; with `log` its stdout and stderr go into that file. Throws Error where it cannot be started.
Child start(const std::vector<std::string>& command, const std::string& log = "");
// Waits for any child; gives its pid and its exit code (128 + signal where it was killed).
struct Ended {
  int pid = -1, code = 0;
};
Ended wait_for_any();
int wait_for(const Child& child);

int run_renderer(const std::vector<std::string>& arguments);

}  // namespace erbs
