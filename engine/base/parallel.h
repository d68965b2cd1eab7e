// Threads: a team that stays together for a whole run, with a barrier cheap enough for two of them a step.
// std::thread and atomics rather than OpenMP: spinning then needs no environment variable set before main, and the thread
// sanitizer understands it. A waiting thread spins for some tens of microseconds, then sleeps, so that an oversubscribed core still makes
// progress.
#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace erbs {

class Barrier {
 public:
  explicit Barrier(int count, int spins = 20000) : count_(count), spins_(spins), waiting_(0), round_(0) {}
  void wait() {
    if (count_ == 1) return;
    const unsigned round = round_.load(std::memory_order_acquire);
    if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == count_) open(round);
    else wait_for(round);
  }
  // As wait(), but thread 0 runs `alone` while all others wait: one barrier where two would stand about it. Where that throws, it throws
  // on thread 0 and the others are told by a false.
  template <class F>
  bool wait(int thread, F&& alone) {
    if (thread != 0) return wait_for_first();
    for (int spins = 0; waiting_.load(std::memory_order_acquire) != count_ - 1;) {
      const int arrived = waiting_.load(std::memory_order_acquire);
      if (++spins > spins_ && arrived != count_ - 1) waiting_.wait(arrived, std::memory_order_acquire);
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
  bool wait_for_first() {
    const unsigned round = round_.load(std::memory_order_acquire);
    waiting_.fetch_add(1, std::memory_order_seq_cst);
    waiting_.notify_one();
    wait_for(round);
    return !failed_;
  }
  void wait_for(unsigned round) {
    for (int spins = 0; spins < spins_; ++spins)
      if (round_.load(std::memory_order_acquire) != round) return;
    while (round_.load(std::memory_order_acquire) == round) round_.wait(round, std::memory_order_acquire);
  }

  const int count_, spins_;
  bool failed_ = false;
  alignas(64) std::atomic<int> waiting_;
  alignas(64) std::atomic<unsigned> round_;
};

// Runs body(thread) on `threads` threads at once, the caller among them; an exception of any is rethrown after all have ended.
// A body that may throw must not leave others waiting at a barrier: throw where all threads throw, or alone (Barrier::wait).
inline void together(int threads, const std::function<void(int)>& body) {
  std::vector<std::exception_ptr> failed(std::size_t(threads), nullptr);
  const auto guarded = [&](int i) {
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
