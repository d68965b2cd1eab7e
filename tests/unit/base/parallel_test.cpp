// The barrier of a team, with waits that fall asleep at once or after a while: whoever comes last wakes all others.
#include "engine/base/parallel.h"

#include <catch2/catch.hpp>

using namespace erbs;

TEST_CASE("nobody sleeps on at a barrier that has opened, however waits and arrivals meet", "[parallel]") {
  constexpr long rounds = 100000;
  for (const int threads : {2, 3})
    for (const int spins : {0, 100}) {
      Barrier barrier(threads, spins);
      std::vector<long> done(std::size_t(threads), 0);
      std::atomic<long> behind = 0;
      together(threads, [&](int thread) {
        unsigned x = unsigned(thread) + 1;
        for (long i = 0; i < rounds; ++i) {
          x = x * 1664525u + 1013904223u;
          for (unsigned k = x >> 24; k > 0; --k) std::atomic_signal_fence(std::memory_order_seq_cst);
          barrier.wait(thread);
          done[std::size_t(thread)] = i + 1;
          barrier.wait(thread);
          barrier.wait(thread, [&] {
            for (const long other : done) behind += other != i + 1;
          });
        }
      });
      CHECK(behind == 0);
      for (const long n : done) CHECK(n == rounds);
    }
}
