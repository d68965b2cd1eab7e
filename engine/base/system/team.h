// A team of threads that lives as long as its Solver, with a barrier cheap enough to be passed twice per step.
//
// std::thread and atomics replace OpenMP: spinning then needs no environment variable before main, and the thread sanitizer
// understands the code.
// * A waiting thread spins for some tens of microseconds, then sleeps, so that an oversubscribed core still makes progress.
// * Waking a thread takes longer than a phase of a step, on a virtual core much longer. Meanwhile the other threads would fall asleep, one
//   after the other. After a short sleep the next spin is therefore longer, up to milliseconds.
// * No thread yields its core: the process that receives the core keeps it for milliseconds.
// * Two threads on one core separate by themselves, since no scheduler separates them: alternating, they look like one thread.
// * If there are as many cores as threads, each thread is bound to its own core.
#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/system/affinity.h"

namespace erbs {

class Barrier {
 public:
  explicit Barrier(int count, int spins = 60000)
      : count_(count),
        spins_(count <= usable_processors() ? spins : 0),
        oversubscribed_(count > usable_processors()),
        slot_(std::size_t(count)) {}
  void wait(int thread) {
    if (count_ == 1) return;
    const unsigned round = arrive(thread);
    for (int other = 0; other < count_; ++other)
      if (other != thread) wait_for(thread, slot_[std::size_t(other)].arrived, round);
  }
  // Like wait(), but thread 0 runs `alone` while all others wait: one barrier instead of two. If `alone` throws, thread 0 throws and the
  // other threads get false.
  template <class F>
  bool wait(int thread, F&& alone) {
    if (thread != 0) {
      enter(thread);
      return !failed_;
    }
    close();
    try {
      alone();
    } catch (...) {
      failed_ = true;
      open();
      throw;
    }
    open();
    return true;
  }
  // The same in two halves. After `close()` all other threads wait in `enter()`, and thread 0 is alone until `open()`.
  void close() {
    if (count_ == 1) return;
    const unsigned round = arrive(0);
    for (int other = 1; other < count_; ++other) wait_for(0, slot_[std::size_t(other)].arrived, round);
  }
  void open() {
    if (count_ > 1) signal(opened_, slot_[0].arrived.load(std::memory_order_relaxed));
  }
  void enter(int thread) { wait_for(thread, opened_, arrive(thread)); }

 private:
  using Clock = std::chrono::steady_clock;
  // State of one thread. Each flag that other threads wait for has its own cache line, written by one thread only. Moving cache lines
  // between cores takes most of the time of a barrier.
  struct ThreadSlot {
    alignas(64) std::atomic<unsigned> arrived{0};  // number of barriers reached
    alignas(64) std::atomic<int> core{-1};
    Clock::time_point left{};
    Clock::duration pause{};
    int spin_level = 0;
  };

  unsigned arrive(int thread) {
    ThreadSlot& mine = slot_[std::size_t(thread)];
    if (const int core = this_core(); core != mine.core.load(std::memory_order_relaxed)) mine.core.store(core, std::memory_order_relaxed);
    const unsigned round = mine.arrived.load(std::memory_order_relaxed) + 1;
    signal(mine.arrived, round);
    return round;
  }
  static void signal(std::atomic<unsigned>& to, unsigned round) {
    // Sequentially consistent with the count of sleepers that notify_all reads next. A weaker store may still be on its way when a thread
    // goes to sleep.
    to.store(round, std::memory_order_seq_cst);
    to.notify_all();
  }
  // Waits until `what` reaches `round`: spins first, then sleeps.
  void wait_for(int thread, const std::atomic<unsigned>& what, unsigned round) {
    using namespace std::chrono_literals;
    ThreadSlot& mine = slot_[std::size_t(thread)];
    const auto behind = [round](unsigned said) { return int(said - round) < 0; };
    for (int left = spins_ << mine.spin_level; left >= 0; --left)
      if (!behind(what.load(std::memory_order_acquire))) return;
    if (!oversubscribed_) leave_shared_core(thread);
    const auto since = Clock::now();
    for (unsigned said; behind(said = what.load(std::memory_order_acquire));) what.wait(said, std::memory_order_acquire);
    const auto slept = Clock::now() - since;
    if (oversubscribed_) return;
    if (slept < 1ms) mine.spin_level = std::min(mine.spin_level + 1, max_spin_level);
    else if (slept > 8ms) mine.spin_level = std::max(mine.spin_level - 1, 0);
  }
  // Of two threads on one core the one with the higher number leaves. If it is soon back there are too few cores, and it leaves ever more
  // rarely.
  void leave_shared_core(int thread) {
    using namespace std::chrono_literals;
    ThreadSlot& mine = slot_[std::size_t(thread)];
    const int core = this_core();
    for (int other = 0; other < thread; ++other) {
      if (slot_[std::size_t(other)].core.load(std::memory_order_relaxed) != core) continue;
      const auto since = Clock::now() - mine.left;
      if (since < mine.pause) return;
      mine.pause = since > 16 * mine.pause ? 4ms : std::min(2 * mine.pause, Clock::duration(4s));
      mine.left += since;
      return leave_core(core);
    }
  }

  static constexpr int max_spin_level = 6;  // 2^6 = 64 times the spins
  const int count_, spins_;
  const bool oversubscribed_;  // more threads than processors: a waiting thread sleeps at once, to free its processor
  bool failed_ = false;
  std::vector<ThreadSlot> slot_;
  alignas(64) std::atomic<unsigned> opened_{0};
};

// Threads that work in rounds. The caller is thread 0; between two rounds it is alone, and all others wait at the barrier.
class Team {
 public:
  // `work(thread)` is one round. Within it only `alone` of `Barrier::wait(thread, alone)` may throw.
  Team(int threads, std::function<void(int thread)> work) : barrier_(threads), work_(std::move(work)) {
    for (int i = 1; i < threads; ++i) others_.emplace_back([this, i, threads] { join_rounds(i, threads); });
    core_.emplace(0, threads);  // not earlier: a new thread inherits the binding of the caller
    barrier_.close();
  }
  ~Team() {
    ended_ = true;
    if (!closed_) barrier_.close();
    barrier_.open();
    for (std::thread& other : others_) other.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  // Runs one round on all threads. Throws what `alone` has thrown; the team is of no further use then.
  void run() {
    ERBS_ASSERT(closed_);
    barrier_.open();
    closed_ = false;
    work_(0);
    barrier_.close();
    closed_ = true;
  }
  Barrier& barrier() { return barrier_; }

 private:
  void join_rounds(int thread, int threads) {
    const OwnCore core(thread, threads);
    for (barrier_.enter(thread); !ended_; barrier_.enter(thread)) work_(thread);
  }

  Barrier barrier_;
  const std::function<void(int)> work_;
  bool ended_ = false, closed_ = true;
  std::vector<std::thread> others_;
  std::optional<OwnCore> core_;
};

// Items [first, last) of a row of work.
struct Range {
  int first, last;
};

}  // namespace erbs
