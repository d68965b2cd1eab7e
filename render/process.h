// Another program that reads its standard input from us.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace erbs::render {

class Process {
 public:
  // Error with `remedy` where there is no such program. It is kept from our Ctrl-C, so that it can finish what it has got.
  Process(const std::vector<std::string>& command, const std::string& remedy);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  bool write(const void* bytes, std::size_t count);  // false when the program has ended
  int finish();                                      // closes its input, waits, gives its exit code

 private:
  pid_t pid_ = -1;
  int input_ = -1;
};

}  // namespace erbs::render
