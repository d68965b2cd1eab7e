// The verification report repeats the results of the runs, and the README repeats the report.
#include <catch2/catch.hpp>

#include "lua/reports/book.h"
#include "tests/support/places.h"
#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

const std::string falling = R"(-- A brick falls.
label("quick")
material{ name = "brick", density = 1800 }
box{ name = "b", size = { .3, .2, .1 }, center = { 0, 0, 10 }, free = true }
analysis{ duration = 0.1, dt = 1e-3, start = "rest", output_dt = 0.01 }
recorder{ name = "b", quantity = "displacement", block = "b", axis = "z" }
metric("fall", "m", function(run) return -run.last("b_uz_rel_m") end)
)";
const std::string good = "-- Round-off only.\nexpect('metrics.fall', 0.5 * g * 0.1^2, { rel = 1e-9, source = 'g t^2 / 2' })\n";

}  // namespace

TEST_CASE("README's line is the summary of the book", "[lua]") {
  const std::string book = text_of(test::in_source("/tests/README.md")), readme = text_of(test::in_source("/README.md"));
  const size_t from = book.find("\n**"), to = book.find("**\n", from + 3);
  REQUIRE(to != std::string::npos);
  CHECK(contains(readme, book.substr(from + 3, to - from - 3)));
}

TEST_CASE("the share of a tolerance is 1 at its end", "[lua]") {
  const Scene scene = scene_of(
      "expect('time_s', 2, { rel = 0.1 }) expect('time_s', 1.9, { abs = 0.4 }) expect('time_s', 4.2, { below = true })\n"
      "expect('time_s', 1, { above = true }) expect('time_s', nil, { between = { 2, 2.2 } }) expect('status', 'completed')\n"
      "expect('steps', 1, { abs = 1 })");
  const auto verdicts = judge(scene.expectations, Json{{"time_s", 2.1}, {"status", "completed"}});
  const double expected[] = {0.5, 0.5, 0.5, 1 / 2.1, 0, 0};
  for (size_t i = 0; i < 6; ++i) {
    INFO(i);
    CHECK(verdicts[i].used == Approx(expected[i]).margin(1e-12));
    CHECK(verdicts[i].passed);
  }
  CHECK_FALSE(std::isfinite(verdicts[6].used));
}

TEST_CASE("the book holds every case, those that fail with their reason", "[program]") {
  Bench bench;
  namespace fs = std::filesystem;
  fs::create_directories(bench.folder / "tests");
  fs::create_directories(bench.folder / "media");
  fs::create_directories(bench.folder / "cases");
  bench.write("README.md", "Above\n<!-- verification -->\nold\n<!-- /verification -->\nBelow\n");
  bench.write("cases/v01_good.lua", falling + good);
  bench.write("cases/v02_wrong.lua", falling + "expect('metrics.fall', 1, { rel = 0.1 })\n");
  bench.write("cases/h01_broken.lua", falling + "expect('metrics.fall', 1, { rel = 0.1 })\nbox{ size = 3 }\n");
  bench.write("cases/v03_slow.lua", "-- Not quick.\n" + falling.substr(falling.find("material")) + good);
  const std::string book = (bench.folder / "tests/README.md").string();
  CHECK(bench.erbs({"test", (bench.folder / "cases").string(), "-o", bench.out(), "--book", book, "--quick"}) == 4);
  CHECK(contains(bench.said, "3 expectations of 3 cases: 1 passed, 2 failed (2 cases)"));
  const std::string text = text_of(book);
  CHECK(contains(text, "`v01_good` | `metrics.fall` | 0.04905 | 0.04905"));
  CHECK(contains(text, "*Tolerance:* Round-off only."));
  CHECK(contains(text, "*Source:* g t^2 / 2."));
  CHECK(contains(text, "](../cases/v01_good.lua): A brick falls."));
  CHECK(contains(text, "**v02_wrong** metrics.fall: expected 1 rel 0.1, got 0.04905"));
  CHECK(contains(text, "**h01_broken** exit code 2"));
  CHECK_FALSE(contains(text, "v03_slow"));
  CHECK(fs::exists(bench.folder / "media/book_b1.svg"));
  const std::string readme = text_of(bench.folder / "README.md");
  CHECK(contains(readme,
                 "Above\n<!-- verification -->\n[The verification book](tests/README.md): 3 cases, 3 expectations: 1 passed, 2 failed;"));
  CHECK(contains(readme, "Below"));
}

TEST_CASE("a slope asked of converge{} makes a scene of a folder a case, a comment or another slope does not", "[program]") {
  Bench bench;
  namespace fs = std::filesystem;
  fs::create_directories(bench.folder / "cases");
  const std::string drop = falling + "local h = param('h', 1, '')\nconverge{ param = 'h', values = { 1, .5, .25 },\n";
  const std::string error = "  error = function(run) return run.time_s * h end }\n";
  bench.write("cases/v01_order.lua", drop + "  slope = -1,\n" + error);
  bench.write("cases/v02_commented.lua", drop + "  -- slope = 1 or expect(1)\n" + error);
  bench.write("cases/v03_roof.lua", falling + "local slope = 3\n");
  bench.erbs({"test", (bench.folder / "cases").string(), "-o", bench.out()});
  INFO(bench.said);
  CHECK(contains(bench.said, "v01_order"));
  CHECK(contains(bench.said, "of 1 case"));
}

TEST_CASE("the grid tells the worst of each invariant, keeps what is done, and honours fixed steps and limits of use", "[program]") {
  Bench bench;
  const std::string stack = R"(
material{ name = "stone", density = 2000 }
ground{ size = 4, material = "stone" }
box{ name = "a", size = { .4, .4, .2 }, at = { 0, 0, 0 }, material = "stone" }
joint{ law = dry{ kn = 1e8, ks = 4e7, mu = 0.6 } }
analysis{ duration = 0.02, output_dt = 0.01, energy_gate = 1 }
metric("points", "", function(run) return run.contact_points end)
)";
  bench.write("stack.lua", "-- A stone rests.\n" + stack + "expect('metrics.points', 20, { below = true })\n");
  bench.write("fixed.lua", "-- A brick falls.\nlabel('fixed_dt')\n" + falling + good);
  bench.write("limited.lua",
              "-- Fine steps only.\n" + stack + "use_limit{ dt_fraction = 0.5, reason = 'it walks' }\nexpect('blocks', 2, { abs = 0 })\n");
  const auto at = [&](const char* name) { return (bench.folder / name).string(); };
  const std::vector<std::string> words = {"test", at("stack.lua"), at("fixed.lua"), at("limited.lua"), "--grid",
                                          "-o",   bench.out(),     "--book",        at("grid.md")};
  CHECK(bench.erbs(words) == 4);
  INFO(bench.said);
  CHECK(contains(bench.said, "23 runs"));  // 9 and two with levels, 1, 9 and two with levels
  CHECK(contains(bench.said, "5 runs refused"));
  CHECK(contains(bench.said, "FAILED 3"));  // with 25 points
  CHECK(contains(text_of(at("grid.md")), "it walks"));
  std::vector<std::string> again = words;
  again.emplace_back("--resume");
  CHECK(std::filesystem::exists(bench.folder / "out/stack/run_levels2/metrics.json"));
  CHECK_FALSE(std::filesystem::exists(bench.folder / "out/fixed/run_levels4/metrics.json"));  // a block alone touches nothing
  const auto made = std::filesystem::last_write_time(bench.folder / "out/stack/run_dt0.2_p4/metrics.json");
  CHECK(bench.erbs(again) == 4);
  CHECK(std::filesystem::last_write_time(bench.folder / "out/stack/run_dt0.2_p4/metrics.json") == made);
}

TEST_CASE("the grid runs a scene over its family, or over seeds, and says where an invariant fails", "[program]") {
  Bench bench;
  const std::string family = R"(
local h = param('height', 1, '')
if h > 10 then error('too high', 0) end
metric('size', '', h + param('seed', 1, ''))
family({ height = { 2, 7, 11 }, seed = { 3 } }, { combinations = 1 })
analysis{ energy_gate = 1 }
)";
  bench.write("drop.lua", "-- A brick falls.\n" + falling + family + "expect('metrics.size', 7, { below = true })\n");
  const std::string scene = (bench.folder / "drop.lua").string();
  CHECK(bench.erbs({"test", scene, "--grid", "-o", bench.out()}) == 4);
  INFO(bench.said);
  CHECK(contains(bench.said, "7 runs, "));  // three steps, heights of 2 and 7, a seed, a combination
  CHECK(contains(bench.said, "1 run refused"));
  CHECK(contains(bench.said, "refused: drop at height 11: "));
  CHECK(contains(bench.said, ":11: too high"));
  CHECK(contains(bench.said, "drop metrics.size fails at height 7"));
  CHECK(bench.erbs({"test", scene, "--seeds", "7", "-o", bench.out()}) == 4);
  INFO(bench.said);
  CHECK(contains(bench.said, "7 runs, "));
  CHECK(contains(bench.said, "drop metrics.size fails at seed 6; seed 7"));
  CHECK(bench.erbs({"test", scene, "--seeds", "2", "-D", "height=2", "-o", bench.out()}) == 0);
  bench.write("still.lua", "-- A brick falls.\n" + falling + good);
  CHECK(bench.erbs({"test", (bench.folder / "still.lua").string(), "--seeds", "2", "-o", bench.out()}) == 2);
  CHECK(contains(bench.said, "has no param \"seed\"; write param"));
}

TEST_CASE("a run may depart from its scene, and tells how far to trust it", "[program]") {
  Bench bench;
  const std::string column = R"(
material{ name = "stone", density = 2000 }
ground{ size = 4, material = "stone" }
for i = 0, 3 do box{ name = "s" .. i, size = { .4, .4, .2 }, at = { 0, 0, 0.2 * i }, material = "stone" } end
joint{ law = dry{ kn = 1e8, ks = 4e7, mu = 0.6 } }
analysis{ duration = 0.1 }
recorder{ name = "top", quantity = "displacement", block = "s3" }
)";
  REQUIRE(bench.run(column, {"--dt-fraction", "0.25", "--points", "16", "--noise", "1e-7", "--twin", "--no-figures"}) == 0);
  const Json metrics = read_json(bench.out() + "/metrics.json");
  CHECK(metrics["contact_points"] == 4 * 16);
  CHECK(metrics["dt_s"].get<double>() == Approx(0.25 * metrics["dt_critical_s"].get<double>()));
  CHECK(metrics["trust"]["dt_margin"].get<double>() == Approx(0.25));
  CHECK(metrics["trust"]["energy_residual"].get<double>() == metrics["energy"]["residual_relative"].get<double>());
  CHECK(metrics["trust"]["twin"] == true);
  CHECK(metrics["trust"]["chaos_horizon_s"].is_null());
  CHECK(metrics["trust"]["warned_share"] == 0.0);
  CHECK(contains(bench.said, "trust: largest energy residual"));
  CHECK(contains(bench.said, "no chaos within the run"));
  const std::string noisy = metrics["state_hash"];
  REQUIRE(bench.run(column, {"--dt-fraction", "0.25", "--points", "16", "--no-figures", "--force"}) == 0);
  CHECK(read_json(bench.out() + "/metrics.json")["state_hash"] != noisy);
  CHECK(bench.run(column, {"--points", "5", "--force"}) == 2);
  CHECK(contains(bench.said, "not a square number"));
}
