// Shares of threads in a row of work, moved until all of them take the same time.
//
// Equal shares do not take equal times. The cost of an item varies, and so does the speed of a core: on a shared host now one, now the
// other is slower by a third, for a millisecond or for minutes, and every meeting of the threads waits for the slower one. Results must not
// depend on where the cuts lie; sums go by chunks of `grain` items.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "engine/base/system/team.h"

namespace erbs {

class Shares {
 public:
  explicit Shares(int threads) : thread_(std::size_t(threads)) { set_ends(); }

  // Items [first, last) of n that belong to `thread`, in whole chunks of `grain` items.
  Range slice(int n, int grain, int thread) const {
    const int chunks = (n + grain - 1) / grain;
    const auto edge = [&](int threads) {
      return threads == 0 ? 0 : std::min(n, grain * int(double(chunks) * thread_[std::size_t(threads - 1)].end + rounding));
    };
    return {edge(thread), edge(thread + 1)};
  }

  // Notes the seconds that `thread` has taken for its share; each thread calls it for itself.
  void note(int thread, double seconds) {
    One& one = thread_[std::size_t(thread)];
    const double cost = seconds / one.share;
    one.cost = one.cost > 0 ? one.cost + newest * (std::min(cost, most * one.cost) - one.cost) : cost;
  }
  // `work()` is all that `thread` does in a step; noted if `timed`.
  template <class F>
  void run(int thread, bool timed, F&& work) {
    using Clock = std::chrono::steady_clock;
    if (!timed || thread_.size() == 1) return work();
    const Clock::time_point began = Clock::now();
    work();
    note(thread, std::chrono::duration<double>(Clock::now() - began).count());
  }

  // Moves the shares towards equal times. While no thread uses them.
  void balance() {
    double speeds = 0;
    for (const One& one : thread_) {
      if (!(one.cost > 0)) return;
      speeds += 1 / one.cost;
    }
    // a thread keeps a share in any case, for without one nobody learns that its core is fast again
    const double least = 0.1 / double(thread_.size());
    double all = 0;
    for (One& one : thread_) all += one.share = std::max(least, 1 / (one.cost * speeds));
    for (One& one : thread_) one.share /= all;
    set_ends();
  }
  double share(int thread) const { return thread_[std::size_t(thread)].share; }

 private:
  static constexpr double newest = 0.1;    // weight of the newest time in the mean
  static constexpr double most = 2;        // times the mean; a thread that has lost its core for once counts little
  static constexpr double rounding = 0.5;  // chunks

  // Written by one thread in its own cache line.
  struct alignas(64) One {
    double share = 0;  // of all items
    double end = 0;    // share of all items up to the end of this one's
    double cost = 0;   // s, time for all items at the pace of this thread, mean of the last steps; 0: not known
  };
  void set_ends() {
    double end = 0;
    for (One& one : thread_) {
      if (one.share == 0) one.share = 1 / double(thread_.size());
      one.end = end += one.share;
    }
    thread_.back().end = 1;
  }
  std::vector<One> thread_;
};

}  // namespace erbs
