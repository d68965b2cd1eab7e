// Threads: a team that stays together for a whole run, with a barrier cheap enough for two of them a step.
// std::thread and atomics rather than OpenMP: spinning then needs no environment variable set before main, and the thread
// sanitizer understands it. A waiting thread spins for some tens of microseconds, then sleeps, so that an oversubscribed core still makes
// progress. To be woken takes longer than a phase of a step, on a virtual core much longer; meanwhile the others would go to sleep, and so
// on in turn. So after a sleep that was short the next wait is longer, up to milliseconds. And no yielding: to whom a core is yielded keeps
// it for milliseconds. Two that find themselves on one core part, since no scheduler does it for them: where they take turns, the load is
// that of one. Where there are as many cores as threads each keeps its own.
#pragma once
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

#include "engine/base/core.h"

namespace erbs {

class Barrier {
 public:
  explicit Barrier(int count, int spins = 60000)
      : count_(count), spins_(count <= usable_processors() ? spins : 0), crowded_(count > usable_processors()), seat_(std::size_t(count)) {}
  void wait(int thread) {
    if (count_ == 1) return;
    const unsigned round = arrive(thread);
    for (int other = 0; other < count_; ++other)
      if (other != thread) wait_for(thread, seat_[std::size_t(other)].arrived, round);
  }
  // As wait(), but thread 0 runs `alone` while all others wait: one barrier where two would stand about it. Where that throws, it throws
  // on thread 0 and the others are told by a false.
  template <class F>
  bool wait(int thread, F&& alone) {
    const unsigned round = arrive(thread);
    if (thread != 0) {
      wait_for(thread, opened_, round);
      return !failed_;
    }
    for (int other = 1; other < count_; ++other) wait_for(0, seat_[std::size_t(other)].arrived, round);
    try {
      alone();
    } catch (...) {
      failed_ = true;
      say(opened_, round);
      throw;
    }
    say(opened_, round);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  // A thread's own. What others wait for has a cache line to itself: between caches lines are what takes time, so each is written by one
  // thread, and by one only.
  struct Seat {
    alignas(64) std::atomic<unsigned> arrived{0};  // at how many barriers
    alignas(64) std::atomic<int> core{-1};
    Clock::time_point left{};
    Clock::duration pause{};
    int patience = 0;
  };

  unsigned arrive(int thread) {
    Seat& mine = seat_[std::size_t(thread)];
    if (const int core = this_core(); core != mine.core.load(std::memory_order_relaxed)) mine.core.store(core, std::memory_order_relaxed);
    const unsigned round = mine.arrived.load(std::memory_order_relaxed) + 1;
    say(mine.arrived, round);
    return round;
  }
  static void say(std::atomic<unsigned>& to, unsigned round) {
    // in one order with the count of sleepers that notify_all reads next: a weaker store may still be on its way when one goes to sleep
    to.store(round, std::memory_order_seq_cst);
    to.notify_all();
  }
  // Until `what` says so: awake for as long as it may soon, then asleep.
  void wait_for(int thread, const std::atomic<unsigned>& what, unsigned round) {
    using namespace std::chrono_literals;
    Seat& mine = seat_[std::size_t(thread)];
    const auto behind = [round](unsigned said) { return int(said - round) < 0; };
    for (int left = spins_ << mine.patience; left >= 0; --left)
      if (!behind(what.load(std::memory_order_acquire))) return;
    if (!crowded_) part(thread);
    const auto since = Clock::now();
    for (unsigned said; behind(said = what.load(std::memory_order_acquire));) what.wait(said, std::memory_order_acquire);
    const auto slept = Clock::now() - since;
    if (crowded_) return;
    if (slept < 1ms) mine.patience = std::min(mine.patience + 1, most_patience);
    else if (slept > 8ms) mine.patience = std::max(mine.patience - 1, 0);
  }
  // Of two on one core the later one goes; ever more seldom where it is back soon, since there are too few cores then.
  void part(int thread) {
    using namespace std::chrono_literals;
    Seat& mine = seat_[std::size_t(thread)];
    const int core = this_core();
    for (int other = 0; other < thread; ++other) {
      if (seat_[std::size_t(other)].core.load(std::memory_order_relaxed) != core) continue;
      const auto since = Clock::now() - mine.left;
      if (since < mine.pause) return;
      mine.pause = since > 16 * mine.pause ? 4ms : std::min(2 * mine.pause, Clock::duration(4s));
      mine.left += since;
      return leave_core(core);
    }
  }

  static constexpr int most_patience = 6;  // 64 times as long
  const int count_, spins_;
  const bool crowded_;  // more threads than processors: who waits sleeps at once, since the one it waits for may want its processor
  bool failed_ = false;
  std::vector<Seat> seat_;
  alignas(64) std::atomic<unsigned> opened_{0};
};

// Runs body(thread) on `threads` threads at once, the caller among them; an exception of any is rethrown after all have ended.
// A body that may throw must not leave others waiting at a barrier: throw where all threads throw, or alone (Barrier::wait).
inline void together(int threads, const std::function<void(int)>& body) {
  std::vector<std::exception_ptr> failed(std::size_t(threads), nullptr);
  const auto guarded = [&](int i) {
    const OwnCore core(i, threads);
    try {
      body(i);
    } catch (...) { failed[std::size_t(i)] = std::current_exception(); }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(guarded, i);
  guarded(0);
  for (auto& t : others) t.join();
  for (const auto& f : failed)
    if (f) std::rethrow_exception(f);
}

// Items [first, last) of n that thread `i` of `threads` owns, in whole chunks of `grain`.
struct Range {
  int first, last;
};
inline Range share_of(int n, int grain, int i, int threads) {
  const int chunks = (n + grain - 1) / grain;
  const auto edge = [&](int k) { return std::min(n, (chunks * k / threads) * grain); };
  return {edge(i), edge(i + 1)};
}

}  // namespace erbs
