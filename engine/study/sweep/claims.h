// Which process works on which point of a study. Processes on one machine or on several share the points through a folder, without any
// other way to talk. The points of a process that died become free again.
#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace erbs::study {

// A process has one file in the folder, which names its machine. It holds the lock of the file as long as it lives, and touches the file
// every few seconds. A claim is a hard link to that file under the number of the point: link() is atomic, over NFS too. On the machine of
// its owner a claim is void once the lock is free, elsewhere once the file has not been touched for three minutes. If two processes ever
// run one point, both write the same row.
class Claims {
 public:
  explicit Claims(const std::string& folder);
  ~Claims();  // gives up all claims; the last process removes the folder
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  enum class Taken { no, yes, from_the_dead };
  Taken take(std::int64_t point);
  void release(std::int64_t point);
  void beat();         // sign of life; may be called often
  void remove_void();  // the files of processes that died

 private:
  using Clock = std::chrono::steady_clock;
  struct Seen {
    std::int64_t touched = 0;  // ns
    Clock::time_point since;
  };
  std::string claim_of(std::int64_t point) const;
  bool is_void(const std::string& claim, std::uint64_t& inode);
  std::string folder_, host_, name_, file_;
  int lock_ = -1;
  Clock::time_point beaten_;
  std::map<std::uint64_t, Seen> seen_;  // by inode, of processes on other machines
  std::map<std::int64_t, bool> mine_;
};

std::string machine();  // its name in the network

// Who works in such a folder now: a process by its name, "host-process-number"; "" if nobody does.
std::string working_in(const std::string& folder);

}  // namespace erbs::study
