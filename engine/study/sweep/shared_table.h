// A table that several processes append to at once, on one machine or over a shared folder. A killed process leaves it whole.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace erbs::study {

using Cells = std::vector<std::string>;

// Lines of cells: the first is a running index, the last the key of the study. Each line is appended by one write(2) under a lock; a last
// line without its end is of a writer that died, and the next writer cuts it off. Lines reach the disk (fdatasync) within a second of
// their writing or with the next one after it, so that a killed process loses none and a machine that fails the last second.
class SharedTable {
 public:
  // Creates the file with its line of column names, or continues it. Throws Error if the file belongs to another study.
  SharedTable(std::string path, const Cells& names, std::string key);
  void append(const Cells& cells);  // without the key
  // Visits the whole lines that this or another process has added since the last call. Throws Error if one has another key.
  void read_new(const std::function<void(const Cells&)>& visit);
  void rewind();  // read_new() begins anew
  // Rewrites it in the order of the indices, each once: the file of a finished study does not depend on who ran what. Gives their number.
  std::int64_t sort();
  void sync();

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  std::string path_, head_, key_;
  std::size_t columns_ = 0;
  std::uint64_t inode_ = 0;  // of the file read so far
  std::int64_t offset_ = 0;  // bytes of it that have been read
  bool unsynced_ = false;
  std::chrono::steady_clock::time_point synced_;
};

}  // namespace erbs::study
