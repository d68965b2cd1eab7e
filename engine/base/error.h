// The user's mistakes and ours. The one door to fmt.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace erbs {

// Where in a script (or an input file) a thing was said. line 0: no line known.
struct Place {
  std::string file;
  int line = 0;
  std::string text() const { return file.empty() ? std::string() : line > 0 ? fmt::format("{}:{}", file, line) : file; }
};

// A mistake of the user's: names the thing, the place and the remedy. Ends the program with code 2.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string message, Place where = {})
      : std::runtime_error(where.file.empty() ? message : where.text() + ": " + message), place(std::move(where)) {}
  Place place;
};

// A file that cannot be written: the disk is full, a limit is reached, the folder is gone. Ends a run with code 3 where a checkpoint is
// there to go on from, else with code 2.
class WriteError : public Error {
  using Error::Error;
};

// Every mistake of a scene at once; each entry is one message that already names its place.
class Errors : public std::runtime_error {
 public:
  explicit Errors(std::vector<std::string> all) : std::runtime_error(fmt::format("{}", fmt::join(all, "\n"))), messages(std::move(all)) {}
  std::vector<std::string> messages;
};

// Trouble in the numbers (NaN, energy past its gate). Ends the program with code 1; what was written stays intact.
class NumbersError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void assert_failed(const char* what, const char* file, int line) {
  throw std::logic_error(fmt::format("internal error: {} is false at {}:{}; please report it", what, file, line));
}

}  // namespace erbs

#define ERBS_ASSERT(condition) \
  do { \
    if (!(condition)) ::erbs::assert_failed(#condition, __FILE__, __LINE__); \
  } while (false)
