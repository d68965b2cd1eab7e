// A child process that reads its standard input from this program.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace erbs::render {

class Process {
 public:
  // Error with `remedy` if the program does not exist. The child is shielded from Ctrl-C, so that it can finish its input.
  Process(const std::vector<std::string>& command, const std::string& remedy);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  bool write(const void* bytes, std::size_t count);  // false if the program has ended
  int finish();                                      // closes its input, waits, returns its exit code

 private:
  pid_t pid_ = -1;
  int input_ = -1;
};

}  // namespace erbs::render
