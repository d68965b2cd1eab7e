// Errors: mistakes of the user, faults of the program, numerical trouble. The only file that includes fmt.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace erbs {

// A place in a script or an input file. line 0: no line known.
struct Place {
  std::string file;
  int line = 0;
  std::string text() const { return file.empty() ? std::string() : line > 0 ? fmt::format("{}:{}", file, line) : file; }
};

// A mistake of the user. The message names the thing, the place and the remedy. Exit code 2.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, Place where = {})
      : std::runtime_error(where.file.empty() ? message : where.text() + ": " + message), place(std::move(where)) {}
  Place place;
};

// A file that cannot be written: disk full, size limit reached, folder gone. Exit code 3 if a checkpoint allows the run to resume,
// else 2.
class WriteError : public Error {
  using Error::Error;
};

// All mistakes of a scene at once. Each message already names its place.
class Errors : public std::runtime_error {
 public:
  explicit Errors(std::vector<std::string> all) : std::runtime_error(fmt::format("{}", fmt::join(all, "\n"))), messages(std::move(all)) {}
  std::vector<std::string> messages;
};

// Numerical trouble: NaN, or an energy residual above its tolerance. Exit code 1; the output written so far stays intact.
class NumbersError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void assert_failed(const char* what, const char* file, int line) {
  throw std::logic_error(fmt::format("internal error: {} is false at {}:{}; please report it", what, file, line));
}

}  // namespace erbs

#define ERBS_ASSERT(condition)                                               \
  do {                                                                       \
    if (!(condition)) ::erbs::assert_failed(#condition, __FILE__, __LINE__); \
  } while (false)
