// Threads: a team that stays together for a whole run, with a barrier cheap enough for two of them a step.
// std::thread and atomics rather than OpenMP: spinning then needs no environment variable set before main, and the thread
// sanitizer understands it. A waiting thread spins for some tens of microseconds, then sleeps, so that an oversubscribed core still makes
// progress. No less: to be woken takes longer than a phase of a step, the others would go to sleep meanwhile, and so on in turn. And no
// yielding: to whom a core is yielded keeps it for milliseconds. Two that find themselves on one core part, since no scheduler does it for
// them: where they take turns, the load is that of one. Where there are as many cores as threads each keeps its own.
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
  explicit Barrier(int count, int spins = 60000) : count_(count), spins_(spins), waiting_(0), round_(0), seat_(std::size_t(count)) {}
  void wait(int thread) {
    if (count_ == 1) return;
    sit_down(thread);
    const unsigned round = round_.load(std::memory_order_acquire);
    if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == count_) open(round);
    else wait_for(thread, round);
  }
  // As wait(), but thread 0 runs `alone` while all others wait: one barrier where two would stand about it. Where that throws, it throws
  // on thread 0 and the others are told by a false.
  template <class F>
  bool wait(int thread, F&& alone) {
    if (count_ > 1) sit_down(thread);
    if (thread != 0) return wait_for_first(thread);
    const auto missing = [this] { return waiting_.load(std::memory_order_acquire) != count_ - 1; };
    watch(0, missing);
    while (missing()) {
      const int arrived = waiting_.load(std::memory_order_acquire);
      if (arrived != count_ - 1) waiting_.wait(arrived, std::memory_order_acquire);
    }
    try {
      alone();
    } catch (...) {
      failed_ = true;
      open(round_.load(std::memory_order_relaxed));
      throw;
    }
    if (count_ > 1) open(round_.load(std::memory_order_relaxed));
    return true;
  }

 private:
  void open(unsigned round) {
    waiting_.store(0, std::memory_order_relaxed);
    // in one order with the count of sleepers that notify_all reads next: a weaker store may still be on its way when one goes to sleep
    round_.store(round + 1, std::memory_order_seq_cst);
    round_.notify_all();
  }
  bool wait_for_first(int thread) {
    const unsigned round = round_.load(std::memory_order_acquire);
    waiting_.fetch_add(1, std::memory_order_seq_cst);
    waiting_.notify_one();
    wait_for(thread, round);
    return !failed_;
  }
  void wait_for(int thread, unsigned round) {
    const auto closed = [this, round] { return round_.load(std::memory_order_acquire) == round; };
    watch(thread, closed);
    while (closed()) round_.wait(round, std::memory_order_acquire);
  }
  // Awake, until something is no longer so or for as long as it may soon change.
  template <class Condition>
  void watch(int thread, Condition&& holds) {
    for (int i = 0; i < spins_; ++i)
      if (!holds()) return;
    part(thread);
  }
  void sit_down(int thread) { seat_[std::size_t(thread)].core.store(this_core(), std::memory_order_relaxed); }
  // Of two on one core the later one goes; ever more seldom where it is back soon, since there are too few cores then.
  void part(int thread) {
    using namespace std::chrono_literals;
    Seat& mine = seat_[std::size_t(thread)];
    const int core = this_core();
    for (int other = 0; other < thread; ++other) {
      if (seat_[std::size_t(other)].core.load(std::memory_order_relaxed) != core) continue;
      const auto since = std::chrono::steady_clock::now() - mine.left;
      if (since < mine.pause) return;
      mine.pause = since > 16 * mine.pause ? 4ms : std::min(2 * mine.pause, Clock::duration(4s));
      mine.left += since;
      return leave_core(core);
    }
  }

  const int count_, spins_;
  bool failed_ = false;
  alignas(64) std::atomic<int> waiting_;
  alignas(64) std::atomic<unsigned> round_;
  using Clock = std::chrono::steady_clock;
  struct alignas(64) Seat {
    std::atomic<int> core{-1};
    Clock::time_point left{};
    Clock::duration pause{};
  };
  std::vector<Seat> seat_;
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
