// The shares of threads cover all items once, whatever the times, and move until the times are equal.
#include "engine/base/system/shares.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace erbs;

TEST_CASE("shares cover every item once, in whole chunks, whatever the times of the threads", "[parallel]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-7, 0);
  for (const int threads : {1, 2, 3, 8})
    for (const int n : {0, 1, 7, 120, 1001}) {
      Shares shares(threads);
      for (int round = 0; round < 100; ++round) {
        for (const int grain : {1, 2, 4, 2000}) {
          CAPTURE(threads, n, round, grain);
          int next = 0;
          for (int thread = 0; thread < threads; ++thread) {
            const Range mine = shares.slice(n, grain, thread);
            REQUIRE(mine.first == next);
            REQUIRE(mine.last >= mine.first);
            REQUIRE((mine.last % grain == 0 || mine.last == n));
            next = mine.last;
          }
          REQUIRE(next == n);
        }
        for (int thread = 0; thread < threads; ++thread) shares.note(thread, std::pow(10, exponent(random)));
        shares.balance();
      }
    }
}

TEST_CASE("threads take equal times on unlike cores and on items of unlike cost", "[parallel]") {
  constexpr int items = 1000;
  struct Case {
    std::vector<double> pace;  // s, of an item, by thread
    double steep;              // the last item costs 1 + this times the first
  };
  for (const Case& c :
       {Case{{1, 1}, 0}, Case{{1, 1.4}, 0}, Case{{3, 1}, 0}, Case{{1, 1}, 4}, Case{{1, 2, 1.5}, 1}, Case{{1, 1, 1, 4}, 2}}) {
    const int threads = int(c.pace.size());
    CAPTURE(c.pace, c.steep);
    Shares shares(threads);
    const auto time = [&](int thread) {
      const Range mine = shares.slice(items, 1, thread);
      double sum = 0;
      for (int i = mine.first; i < mine.last; ++i) sum += c.pace[std::size_t(thread)] * (1 + c.steep * i / items);
      return sum;
    };
    for (int step = 0; step < 400; ++step) {
      for (int thread = 0; thread < threads; ++thread) shares.note(thread, time(thread));
      if (step % 8 == 0) shares.balance();
    }
    double least = 1e300, most = 0;
    for (int thread = 0; thread < threads; ++thread) least = std::min(least, time(thread)), most = std::max(most, time(thread));
    CHECK(most < 1.02 * least);
  }
}

TEST_CASE("a core that was held up once keeps its share, one that has stopped gets work again", "[parallel]") {
  Shares shares(2);
  const auto steps = [&](double first, double second, int count) {
    for (int i = 0; i < count; ++i) shares.note(0, first * shares.share(0)), shares.note(1, second * shares.share(1));
    shares.balance();
  };
  steps(1, 1, 20);
  CHECK(shares.share(0) == Approx(0.5));
  steps(1, 1000, 1);  // its core was taken for a while
  CHECK(shares.share(1) > 0.47);
  for (int k = 0; k < 100; ++k) steps(1, 1e6, 10);
  CHECK(shares.share(1) > 0.04);
  for (int k = 0; k < 100; ++k) steps(1, 1, 10);
  CHECK(shares.share(1) == Approx(0.5).margin(0.01));
}
