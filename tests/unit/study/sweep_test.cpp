// The parts of a sweep: its points, the table that many processes write, the claims on points.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "engine/study/pool.h"
#include "engine/study/sweep/claims.h"
#include "engine/study/sweep/design.h"
#include "engine/study/sweep/one_run.h"
#include "engine/study/sweep/ranks.h"
#include "engine/study/sweep/shared_table.h"
#include "tests/support/folder.h"
#include "tests/support/text_of.h"

using namespace erbs;
using namespace erbs::study;

namespace {

Axis axis(const std::string& param, const std::vector<double>& values, int group = 0) {
  Axis out;
  out.params = {param};
  for (const double value : values) out.rows.push_back({value});
  out.group = group;
  return out;
}

double number(const Value& value) { return std::get<double>(value); }

std::vector<std::string> indices(SharedTable& table) {
  std::vector<std::string> out;
  table.read_new([&](const Cells& cells) { out.push_back(cells.front()); });
  return out;
}

}  // namespace

TEST_CASE("the points of a study are every combination, the last axis fastest", "[sweep]") {
  Plan plan;
  plan.axes = {axis("a", {1, 2}), axis("b", {10, 20, 30})};
  REQUIRE(point_count(plan) == 6);
  std::set<std::pair<double, double>> all;
  for (std::int64_t i = 0; i < 6; ++i) {
    const study::Point point = point_at(plan, i);
    CHECK(point[0].first == "a");
    CHECK(number(point[0].second) == double(1 + i / 3));
    CHECK(number(point[1].second) == double(10 * (1 + i % 3)));
    all.emplace(number(point[0].second), number(point[1].second));
  }
  CHECK(all.size() == 6);
  CHECK(point_count(Plan{}) == 1);  // a bisection alone
  plan.axes.assign(8, axis("c", std::vector<double>(10, 1)));
  CHECK_THROWS_WITH(point_count(plan), Catch::Contains("points"));
}

TEST_CASE("the params of a grid follow the scene, other axes keep their place", "[sweep]") {
  Plan plan;
  plan.axes = {axis("a", {1}, 1), axis("b", {1}, 1), axis("z", {1}, 2), axis("c", {1}, 3), axis("d", {1}, 3)};
  plan.axes[0].by_scene = plan.axes[1].by_scene = true;
  order_grids(plan, {"d", "c", "b", "a", "z"});
  CHECK(varied_params(plan) == std::vector<std::string>{"b", "a", "z", "c", "d"});
}

TEST_CASE("each stratum of a Latin hypercube holds one point, whatever its size, seed and scale", "[sweep]") {
  for (const int n : {1, 2, 7, 100, 1000})
    for (const double seed : {1.0, 2.5}) {
      const std::vector<Range> ranges{{"a", -1, 3, false}, {"b", 1e-3, 1e3, true}};
      const Axis points = latin_hypercube(ranges, n, seed);
      REQUIRE(points.rows.size() == std::size_t(n));
      std::set<int> a, b;
      for (const auto& row : points.rows) {
        a.insert(int(std::floor((number(row[0]) + 1) / 4 * n)));
        b.insert(int(std::floor((std::log10(number(row[1])) + 3) / 6 * n + 1e-9)));
      }
      CHECK(a.size() == std::size_t(n));
      CHECK(b.size() == std::size_t(n));
      CHECK(*a.begin() == 0);
      CHECK(*b.rbegin() == n - 1);
      CHECK(latin_hypercube(ranges, n, seed).rows == points.rows);
      CHECK(latin_hypercube(ranges, n, seed + 1).rows != points.rows);
    }
}

TEST_CASE("a Latin hypercube does not couple its params", "[sweep]") {
  const int n = 2000;
  const Axis points = latin_hypercube({{"a", 0, 1, false}, {"b", 0, 1, false}}, n, 3);
  double sum = 0;
  for (const auto& row : points.rows) sum += (number(row[0]) - .5) * (number(row[1]) - .5);
  CHECK(std::fabs(12 * sum / n) < 3 / std::sqrt(double(n)));  // three standard deviations of the correlation of independent draws
}

TEST_CASE("random points lie in their ranges with the mean of a uniform law", "[sweep]") {
  const int n = 4000;
  const Axis points = random_points({{"a", 2, 4, false}}, n, 1);
  double sum = 0;
  for (const auto& row : points.rows) {
    CHECK((number(row[0]) >= 2 && number(row[0]) < 4));
    sum += number(row[0]);
  }
  CHECK(std::fabs(sum / n - 3) < 3 * 2 / std::sqrt(12.0 * n));  // three standard deviations of the mean
}

TEST_CASE("values of -D survive as they are", "[sweep]") {
  CHECK(expression_of(Value(0.1)) == "0.1");
  CHECK(expression_of(Value(std::string("a\"b\\c.AT2"))) == "\"a\\\"b\\\\c.AT2\"");
}

TEST_CASE("a table drops a torn last line, whoever opens or appends next", "[sweep]") {
  const test::Folder own;
  const std::string path = own.file("t.csv");
  SharedTable table(path, {"index", "value"}, "key");
  table.append({"1", "a"});
  std::ofstream(path, std::ios::app) << "2,tor";
  CHECK(indices(table) == std::vector<std::string>{"1"});
  table.append({"3", "c"});  // another process was killed while it wrote
  CHECK(test::text_of(path) == "index,value,study\n1,a,key\n3,c,key\n");
  std::ofstream(path, std::ios::app) << std::string(10000, 'x');
  SharedTable again(path, {"index", "value"}, "key");
  CHECK(indices(again) == std::vector<std::string>{"1", "3"});
  CHECK(indices(table) == std::vector<std::string>{"3"});
}

TEST_CASE("a table of another study is refused", "[sweep]") {
  const test::Folder own;
  const std::string path = own.file("t.csv");
  SharedTable(path, {"index", "value"}, "key").append({"1", "a"});
  CHECK_THROWS_WITH(SharedTable(path, {"index", "other"}, "key"), Catch::Contains("another study") && Catch::Contains("--force"));
  SharedTable foreign(path, {"index", "value"}, "other");
  CHECK_THROWS_WITH(foreign.read_new([](const Cells&) {}), Catch::Contains("another study"));
}

TEST_CASE("a sorted table has each index once, and takes further lines", "[sweep]") {
  const test::Folder own;
  SharedTable table(own.file("t.csv"), {"index", "value"}, "key"), other(own.file("t.csv"), {"index", "value"}, "key");
  for (const char* index : {"10", "2", "1", "2"}) table.append({index, "v, w"});
  CHECK(indices(other).size() == 4);
  CHECK(table.sort() == 3);
  CHECK(test::text_of(own.file("t.csv")) == "index,value,study\n1,\"v, w\",key\n2,\"v, w\",key\n10,\"v, w\",key\n");
  other.append({"11", "x"});
  CHECK(indices(other) == std::vector<std::string>{"1", "2", "10", "11"});  // a new file: read from its beginning
}

TEST_CASE("a table that finds no room says so", "[sweep]") {
  const test::Folder own;
  int said[2];
  REQUIRE(pipe(said) == 0);
  const pid_t child = fork();
  if (child == 0) {
    SharedTable table(own.file("t.csv"), {"index", "value"}, "key");
    const rlimit room{100, 100};  // as of a full disk: part of the line goes in
    setrlimit(RLIMIT_FSIZE, &room);
    std::signal(SIGXFSZ, SIG_IGN);
    errno = ENOENT;  // of something before
    std::string what = "no trouble";
    try {
      table.append({"1", std::string(200, 'a')});
    } catch (const std::exception& error) { what = error.what(); }
    _exit(write(said[1], what.data(), what.size()) == ssize_t(what.size()) ? 0 : 1);
  }
  waitpid(child, nullptr, 0);
  std::string what(4096, ' ');
  what.resize(std::size_t(std::max(ssize_t(0), read(said[0], what.data(), what.size()))));
  CHECK_THAT(what, Catch::Contains("No space left on device") && Catch::Contains("t.csv") && Catch::Contains("--resume"));
  SharedTable after(own.file("t.csv"), {"index", "value"}, "key");
  CHECK(indices(after).empty());  // the torn line is gone
}

TEST_CASE("lines of several processes never mix", "[sweep]") {
  const test::Folder own;
  const std::string path = own.file("t.csv");
  std::vector<pid_t> children;
  for (int c = 0; c < 4; ++c) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    SharedTable table(path, {"index", "value"}, "key");
    for (int i = 0; i < 100; ++i) table.append({std::to_string(100 * c + i), std::string(std::size_t(1 + 37 * i % 500), char('a' + c))});
    _exit(0);
  }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  SharedTable table(path, {"index", "value"}, "key");
  std::set<std::string> seen;
  table.read_new([&](const Cells& cells) {
    seen.insert(cells[0]);
    CHECK(cells[1].find_first_not_of(cells[1][0]) == std::string::npos);
  });
  CHECK(seen.size() == 400);
}

TEST_CASE("a point belongs to one process, until that one dies", "[sweep]") {
  const test::Folder own;
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    Claims theirs(own.file("work"));
    const char ok = theirs.take(5) == Claims::Taken::yes ? 'y' : 'n';
    if (write(ready[1], &ok, 1) != 1) _exit(1);
    for (;;) pause();
  }
  char ok = 0;
  REQUIRE(read(ready[0], &ok, 1) == 1);
  CHECK(ok == 'y');
  {
    Claims mine(own.file("work"));
    CHECK(working_in(own.file("work")) != "");
    CHECK(mine.take(5) == Claims::Taken::no);
    CHECK(mine.take(6) == Claims::Taken::yes);
    CHECK(mine.take(6) == Claims::Taken::no);
    mine.release(6);
    CHECK(mine.take(6) == Claims::Taken::yes);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    CHECK(mine.take(5) == Claims::Taken::from_the_dead);
    CHECK(mine.take(5) == Claims::Taken::no);
    mine.remove_void();
  }
  CHECK_FALSE(std::filesystem::exists(own.file("work")));
}

TEST_CASE("a folder tells whether a process that lives works in it", "[sweep]") {
  const test::Folder own;
  CHECK(working_in(own.file("work")) == "");
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const Claims theirs(own.file("work"));
    if (write(ready[1], "y", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char ok = 0;
  REQUIRE(read(ready[0], &ok, 1) == 1);
  CHECK_THAT(working_in(own.file("work")), Catch::Contains(std::to_string(child)));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  CHECK(working_in(own.file("work")) == "");  // its file is still there
  // A process of another machine lives while it touches its file.
  std::ofstream(own.file("work/elsewhere-12-0.worker")) << "elsewhere";
  CHECK(working_in(own.file("work")) == "elsewhere-12-0");
  std::filesystem::last_write_time(own.file("work/elsewhere-12-0.worker"),
                                   std::filesystem::file_time_type::clock::now() - std::chrono::minutes(10));
  CHECK(working_in(own.file("work")) == "");
}

TEST_CASE("a run that takes too long is ended with all that it has started", "[sweep]") {
  const test::Folder own;
  Pool pool(2);
  pool.add(7, {{"sh", "-c", "sleep 1000 & echo $! > " + own.file("pid") + "; wait"}, {.own_group = true}, 0, 0.3});
  pool.add(8, {{"sh", "-c", "exit 3"}, {}});
  CHECK(pool.full());
  std::map<std::size_t, Finished> ended;
  while (!pool.empty())
    if (const auto one = pool.wait(1)) ended[one->id] = *one;
  CHECK(ended.at(8).code == 3);
  CHECK_FALSE(ended.at(8).overdue);
  CHECK(ended.at(7).overdue);
  CHECK(ended.at(7).code == 128 + SIGKILL);
  CHECK(ended.at(7).wall < 5);
  const int grandchild = std::stoi(test::text_of(own.file("pid")));
  for (int i = 0;
       i < 200 && kill(grandchild, 0) == 0 && test::text_of(fmt::format("/proc/{}/stat", grandchild)).find(") Z") == std::string::npos; ++i)
    usleep(10000);
  CHECK((kill(grandchild, 0) != 0 || test::text_of(fmt::format("/proc/{}/stat", grandchild)).find(") Z") != std::string::npos));
}

TEST_CASE("a run beyond its memory gets no more, and its peak is known", "[sweep]") {
  Pool pool(1);
  const std::vector<std::string> hog{"sh", "-c", "x=$(head -c 100000000 /dev/zero | tr '\\0' a); echo ${#x} > /dev/null"};
  const auto run = [&](double memory) {
    pool.add(0, {hog, {.output = "/dev/null", .errors = "/dev/null", .memory = memory}});
    std::optional<Finished> ended;
    while (!(ended = pool.wait(1))) {}
    return *ended;
  };
  const Finished free = run(0), capped = run(50e6);
  CHECK(free.code == 0);
  CHECK(free.memory > 100e6);
  CHECK(capped.code != 0);
  CHECK(capped.memory < 100e6);
}

TEST_CASE("a run that finds no room under its limit has the status memory", "[sweep]") {
  const test::Folder own;
  std::filesystem::create_directories(own.file("runs"));
  Sweep sweep;
  sweep.directory = own.path.string();
  const auto status = [&](const std::string& said, double memory) {
    std::ofstream(own.file("runs/000000.log")) << said << "\n";
    sweep.plan.memory = memory;
    return read_run(sweep, {}, 0, "000000", {.id = 0, .code = 1}).status;
  };
  for (const char* said : {"erbs: Resource temporarily unavailable", "a: Cannot allocate memory", "error: not enough memory"}) {
    CHECK(status(said, 50e6) == "memory");
    CHECK(status(said, 0) != "memory");
  }
  CHECK(status("a mistake", 50e6) != "memory");
}

TEST_CASE("ranks are those of the launcher's environment", "[sweep]") {
  const std::vector<std::string> names{"OMPI_COMM_WORLD_RANK",
                                       "OMPI_COMM_WORLD_SIZE",
                                       "PMIX_NAMESPACE",
                                       "PMI_RANK",
                                       "PMI_SIZE",
                                       "SLURM_PROCID",
                                       "SLURM_STEP_ID",
                                       "SLURM_STEP_NUM_TASKS",
                                       "SLURM_JOB_ID",
                                       "SLURM_ARRAY_TASK_ID",
                                       "OMPI_COMM_WORLD_LOCAL_SIZE",
                                       "MPI_LOCALNRANKS",
                                       "SLURM_NTASKS_PER_NODE"};
  const auto clear = [&] {
    for (const auto& name : names) unsetenv(name.c_str());
  };
  clear();
  CHECK(ranks_of_environment().size == 1);
  setenv("SLURM_PROCID", "0", 1), setenv("SLURM_JOB_ID", "12", 1), setenv("SLURM_ARRAY_TASK_ID", "3", 1);
  CHECK(ranks_of_environment().size == 1);  // the script of a batch job
  CHECK(ranks_of_environment().array_task);
  setenv("SLURM_STEP_ID", "1", 1), setenv("SLURM_STEP_NUM_TASKS", "4", 1), setenv("SLURM_PROCID", "2", 1);
  CHECK(ranks_of_environment().rank == 2);
  CHECK(ranks_of_environment().launch == "slurm=12.1");
  clear();
  setenv("OMPI_COMM_WORLD_RANK", "1", 1), setenv("OMPI_COMM_WORLD_SIZE", "2", 1), setenv("PMIX_NAMESPACE", "77", 1);
  CHECK(ranks_of_environment().rank == 1);
  CHECK(ranks_of_environment().launch == "PMIX_NAMESPACE=77");
  CHECK(ranks_of_environment().here == 1);
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "2", 1);
  CHECK(ranks_of_environment().here == 2);  // they share the memory of one machine
  setenv("OMPI_COMM_WORLD_LOCAL_SIZE", "0", 1);
  CHECK(ranks_of_environment().here == 1);
  clear();
}
