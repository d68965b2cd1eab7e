// Child processes: what they are given, what they answer, how they end.
#include "engine/base/system/process.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <thread>

#include "engine/base/error.h"
#include "tests/support/folder.h"
#include "tests/support/text_of.h"

using namespace erbs;

TEST_CASE("a program reads what it is fed and writes into the files it is given", "[process]") {
  const test::Folder own;
  const std::string out = (own.path / "out").string(), errors = (own.path / "errors").string();
  Child child = start({"sh", "-c", "cat; pwd; echo trouble >&2; exit 3"},
                      {.output = out, .errors = errors, .folder = "/", .fed = true, .own_group = true});
  CHECK(send(child.to, "abc\n", 4));
  CHECK(finish(child) == 3);
  CHECK(test::text_of(out) == "abc\n/\n");
  CHECK(test::text_of(errors) == "trouble\n");
  CHECK(wait_for(start({"sh", "-c", "echo one; echo two >&2"}, out)) == 0);
  CHECK(test::text_of(out) == "one\ntwo\n");
}

TEST_CASE("a program that dies or is absent says so", "[process]") {
  Child child = start({"sleep", "100"}, {.fed = true});
  stop_hard(child);
  const int code = finish(child);
  CHECK(code == 128 + 9);
  CHECK(was_killed(code));
  CHECK(last_words("", code, "") == "ended by signal 9");
  Child deaf = start({"true"}, {.fed = true});
  for (int i = 0; i < 1000 && send(deaf.to, "a", 1); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK_FALSE(send(deaf.to, "a", 1));
  CHECK(finish(deaf) == 0);
  CHECK(can_start("sh"));
  CHECK_FALSE(can_start("no_such_program"));
  CHECK_THROWS_WITH(start({"no_such_program"}, Launch{.remedy = "build it"}),
                    Catch::Contains("no_such_program") && Catch::EndsWith("; build it"));
}

TEST_CASE("a copy of this process answers until its input ends", "[process]") {
  const int known = 5;
  Child copy = start_copy([&](int from, int to) {
    for (int x = 0; receive(from, &x, sizeof x);) send(to, &(x += known), sizeof x);
  });
  for (int x : {1, 2}) {
    CHECK(send(copy.to, &x, sizeof x));
    int y = 0;
    CHECK(receive(copy.from, &y, sizeof y));
    CHECK(y == x + known);
  }
  CHECK(finish(copy) == 0);
}
