// Columns of blocks, from which interlock takes its scale: of joints at the start, of contacts as they are.
#include "engine/model/columns.h"

#include <catch2/catch.hpp>

#include "engine/analysis/dynamic.h"
#include "engine/contact/broad/search.h"
#include "engine/record/format/csv.h"
#include "tests/support/folder.h"
#include "tests/support/small_wall.h"
#include "tests/unit/record/two_bricks.h"
#include "tests/unit/solve/scene_run.h"

using namespace erbs;
using namespace erbs::analysis;
using test::block_index;

namespace {

// A pier of four courses on dry beds, on a fixed base; `more` adds to it.
Prepared built(const std::string& more, double slope = 0) {
  lua::Script script(lua::Script::Options{.quiet = true});
  const Scene scene = script.load_text(
      fmt::format(
          "gravity{{ {}, 0, {} }}\n"
          "material{{ name = 'stone', density = 1800, kn = 1e10, ks = 4e9, friction = .6 }}\nanalysis{{ duration = 1, start = 'rest' }}\n"
          "box{{ name = 'base', group = 'base', size = {{40, 20, .2}}, at = {{-20, -10, -.2}}, fixed = true }}\n"
          "for k = 0, 3 do box{{ name = 'p' .. k, group = 'pier', size = {{.3, .2, .1}}, at = {{0, 0, .1 * k}} }} end\n"
          "joint{{ between = {{'base', 'pier'}}, law = dry{{ kn = 1e10, mu = .6 }} }}\n"
          "joint{{ between = {{'pier', 'pier'}}, law = dry{{ kn = 1e10, mu = .6 }} }}\n{}",
          standard_g * std::sin(slope), -standard_g * std::cos(slope), more),
      "columns.lua");
  return prepare(scene, false);
}

Hop of_joint(const Model& m, const std::string& a, const std::string& b) {
  for (const Joint& joint : m.joint)
    if ((joint.a == block_index(m, a) && joint.b == block_index(m, b)) || (joint.a == block_index(m, b) && joint.b == block_index(m, a)))
      return joint.hop;
  FAIL("no joint " << a << " | " << b);
  return {};
}

// After the blocks have met: of the contact of two blocks.
Hop of_contact(Prepared run, const std::string& a, const std::string& b, double until = 0.02) {
  Solver solver(run.model, run.state, run.range, 1);
  solver.advance_until([&] { return run.state.time.t >= until; });
  const int x = block_index(run.model, a), y = block_index(run.model, b);
  const int at = find_pair(run.state.contacts.list, std::min(x, y), 0, std::max(x, y), 0);
  REQUIRE(at >= 0);
  return run.state.contacts.list.pair[std::size_t(at)].law.hop;
}

std::string brick(int k, double x, double z, const std::string& more = "group = 'loose', free = true") {
  return fmt::format("box{{ name = 'q{}', size = {{.3, .2, .1}}, at = {{{}, 0, {}}}, {} }}\n", k, x, z, more);
}

}  // namespace

TEST_CASE("a joint hops with the column through it, whatever stands beside it or on one raft with it", "[solve][interlock]") {
  const Prepared alone = built("");
  const Hop hop = of_joint(alone.model, "p1", "p2");
  REQUIRE(hop.time > 0);
  CHECK(hop.loan == Approx(3 * hop.time));
  CHECK(of_joint(alone.model, "base", "p0").time == hop.time);
  const Hop undamped =
      of_joint(built("joint{ between = {'pier', 'pier'}, law = dry{ kn = 1e10, mu = .6, damping = 0 } }\n").model, "p1", "p2");
  CHECK(undamped.loan == Approx(20 * undamped.time));
  std::string stack, tower, raft = "box{ name = 'raft', group = 'pier', size = {8, .2, .1}, at = {2, 0, 0} }\n";
  for (int k = 0; k < 20; ++k) {
    const double z = 0.1 * k;
    stack += brick(k, 5, z);
    tower += brick(k, 0.3, z, "group = 'pier'");  // joined to the pier along its side
    raft += brick(k, 3, z + 0.1, "group = 'pier'");
  }
  raft += "box{ name = 'low', group = 'pier', size = {.3, .2, .1}, at = {8, 0, .1} }\n";
  const std::string steel =
      "material{ name = 'steel', density = 7800, kn = 1e14, ks = 4e13 }\n" + brick(1, 5, 0, "free = true, material = 'steel'");
  for (const std::string& more : {brick(1, 5, 8), stack, steel}) CHECK(of_joint(built(more).model, "p1", "p2").time == hop.time);
  const Prepared beside = built(tower);
  const Hop low = of_joint(beside.model, "p1", "p2"), high = of_joint(beside.model, "q1", "q2");
  CHECK(low.loan == Approx(3 * low.time));
  CHECK(high.loan == Approx(20. / 3 * high.time));
  CHECK(of_joint(beside.model, "p1", "q1").loan == Approx(low.loan).epsilon(0.5));  // the lower one of both
  const Prepared on_raft = built(raft);
  const Hop of_low = of_joint(on_raft.model, "raft", "low"), of_tower = of_joint(on_raft.model, "raft", "q0");
  CHECK(of_low.loan == Approx(2 * of_low.time));
  CHECK(of_tower.loan == Approx(7 * of_tower.time));
}

TEST_CASE("contacts hop with the column of the moment", "[solve][interlock]") {
  const double one = of_contact(built(brick(0, 5, 0)), "base", "q0").time;
  REQUIRE(one > 0);
  for (const double gap : {0.0, 0.002}) {  // lying on each other, and after a fall
    std::string stack;
    for (int k = 0; k < 12; ++k) stack += brick(k, 5, k * (0.1 + gap));
    const double until = gap > 0 ? 0.2 : 0.02;
    const Hop hop = of_contact(built(stack), "base", "q0", until);
    CHECK(hop.time == Approx(one * std::sqrt(12 * 13 / 2)));
    CHECK(hop.loan == Approx(4 * hop.time));
    CHECK(of_contact(built(stack), "q10", "q11", until).time == Approx(hop.time));
  }
  std::string row;  // end to end up a slope: side by side, not on each other
  for (int k = 0; k < 10; ++k) row += brick(k, 5 + 0.3 * k, 0);
  CHECK(of_contact(built(row, -0.35), "base", "q4").time == Approx(one).epsilon(0.05));
}

// Its beds have been closed from the start, so their asperities are interlocked when the first hop opens them.
TEST_CASE("a stack just below the angle of friction stays when it is moved by ten nanometres", "[solve][interlock]") {
  const std::string scene = R"(
    material { name = "brick", density = 1800 }
    local mu, way = .6, math.rad(334)
    local slope = math.atan(.985 * mu)
    transform { rotation = { math.sin(way) * slope, math.cos(way) * slope, 0 }, function()
      box { name = "base", size = { 1.6, 1.4, .1 }, at = { -.6, -.6, -.1 }, fixed = true }
      for c = 1, 5 do box { name = "p" .. c, size = { .4, .2, .05 }, at = { 0, 0, (c - 1) * .05 } } end
    end }
    joint { law = dry { kn = 1e11, mu = mu } }
    recorder { name = "top", quantity = "displacement", block = "p5" }
    analysis { duration = .3 }
  )";
  const test::Folder folder;
  lua::Script script(lua::Script::Options{.quiet = true});
  analysis::RunOptions options;
  options.directory = folder.file("run"), options.noise = 1e-8, options.threads = 1;
  analysis::run_dynamic(script.load_text(scene, "scene.lua"), scene, options);
  const CsvTable table = read_csv(folder.file("run/histories.csv"));
  const auto last = [&](const char* name) { return table.column(name).back(); };
  CHECK(std::hypot(last("top_ux_rel_m"), last("top_uy_rel_m")) < 4e-6);  // 1e-5 of its length, as in h27
}
