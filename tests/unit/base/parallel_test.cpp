// The barrier of a team, with waits that sleep at once or after a while: the last thread to arrive wakes all others.
#include "engine/base/system/team.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>

using namespace erbs;

TEST_CASE("nobody sleeps on at a barrier that has opened, however waits and arrivals meet", "[parallel]") {
  // As many as fit into some seconds: on a busy machine a sleeper is woken late.
  constexpr long most_rounds = 100000, least_rounds = 2000;
  constexpr std::chrono::seconds span{4};
  for (const int threads : {2, 3})
    for (const int spins : {0, 100}) {
      std::vector<long> done(std::size_t(threads), 0);
      std::atomic<long> behind = 0;
      std::atomic<bool> enough = false;
      const auto end = std::chrono::steady_clock::now() + span;
      Barrier barrier(threads, spins);
      const auto work = [&](int thread) {
        unsigned x = unsigned(thread) + 1;
        for (long i = 0; !enough; ++i) {
          x = x * 1664525u + 1013904223u;
          for (unsigned k = x >> 24; k > 0; --k) std::atomic_signal_fence(std::memory_order_seq_cst);
          barrier.wait(thread);
          done[std::size_t(thread)] = i + 1;
          barrier.wait(thread);
          barrier.wait(thread, [&] {
            for (const long other : done) behind += other != i + 1;
            enough = i + 1 >= most_rounds || (i + 1 >= least_rounds && std::chrono::steady_clock::now() > end);
          });
        }
      };
      Team(threads, work).run();
      CHECK(behind == 0);
      for (const long n : done) CHECK((n == done.front() && n >= least_rounds));
    }
}

TEST_CASE("as many threads as there are cores have one each, and give it back", "[parallel]") {
  const auto cores_of_this_thread = [] {
    cpu_set_t allowed;
    REQUIRE(::sched_getaffinity(0, sizeof(allowed), &allowed) == 0);
    return CPU_COUNT(&allowed);
  };
  const int cores = cores_of_this_thread();
  std::vector<int> core(std::size_t(cores), -1);
  Team(cores, [&](int thread) { core[std::size_t(thread)] = this_core(); }).run();
  std::sort(core.begin(), core.end());
  if (cores > 1) CHECK(std::adjacent_find(core.begin(), core.end()) == core.end());
  CHECK(cores_of_this_thread() == cores);
  Team(cores + 1, [](int) {}).run();
  CHECK(cores_of_this_thread() == cores);
}

TEST_CASE("between two rounds the caller is alone, also after a round that has thrown", "[parallel]") {
  for (const int threads : {1, 2, 3}) {
    std::vector<int> rounds(std::size_t(threads), 0);
    Team* all = nullptr;
    Team team(threads, [&](int thread) {
      ++rounds[std::size_t(thread)];
      if (!all->barrier().wait(thread, [&] {
            if (rounds.front() == 4) throw Error("no space left");
          }))
        return;
      ++rounds[std::size_t(thread)];
    });
    all = &team;
    for (int round = 1; round <= 2; ++round) {
      team.run();
      for (const int n : rounds) CHECK(n == 2 * round);
      if (round == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the others fall asleep
    }
    rounds.assign(rounds.size(), 3);
    CHECK_THROWS_AS(team.run(), Error);
  }
}
