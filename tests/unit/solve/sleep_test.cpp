// Sleeping blocks: unchanged while asleep, woken for the right reason at the right time, and neutral to ledger, threads and restart.
#include <catch2/catch.hpp>

#include "engine/analysis/dynamic.h"
#include "engine/record/folder/checkpoint.h"
#include "tests/support/small_wall.h"
#include "tests/unit/record/two_bricks.h"
#include "tests/unit/solve/scene_run.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;
using test::block_index;

namespace {

// Nine bricks fall in a heap, and a tenth lies on a tray that is drawn away at 4 s; `more`: loads, analysis.
std::string heap(const std::string& more) {
  return R"(
    material{ name = "brick", density = 1800, kn = 2e9, ks = 8e8, friction = 0.6, restitution = 0.2 }
    material{ name = "ice", density = 1800, kn = 2e9, ks = 8e8, friction = 0.02 }
    ground{ size = 20, material = "brick" }
    local state = 12345
    local function random() state = (state * 1103515245 + 12345) % 2147483648 return state / 2147483648 end
    for k = 0, 8 do
      box{ name = "b" .. k, material = "brick", free = true, size = {.3, .125, .1}, center = {.36 * (k % 2), .22 * (k // 2 % 2), .12 + .22 * (k // 4)},
        initial = { rotation = {.2 * random(), .2 * random(), .5 * random()} } }
    end
    box{ name = "tray", material = "ice", free = true, size = {.4, .3, .02}, center = {.18, .11, 1.2} }
    box{ name = "top", material = "ice", free = true, size = {.3, .125, .1}, center = {.18, .11, 1.26} }
    motion{ block = "tray", direction = "x", wave = table_wave{ times = {0, 4, 4.1, 99}, values = {0, 0, 1, 1} } }
  )" + more;
}

const std::string awake = "analysis{ duration = 5, start = 'rest' }", asleep = "analysis{ duration = 5, start = 'rest', sleep = true }";

struct Ran {
  Prepared run;
  std::optional<Solver> solver;
  std::vector<std::pair<double, int>> count;  // blocks asleep, at samples
};

// Runs to `until` (s); samples every step from `from` on.
void go(Ran& r, const std::string& script, double until, double from = 1e9, int threads = 1) {
  Script loaded(Script::Options{.quiet = true});
  const Scene scene = loaded.load_text(heap(script), "heap.lua");
  r.run = prepare(scene, false);
  start_at_rest(scene, r.run, threads);
  r.solver.emplace(r.run.model, r.run.state, r.run.range, threads);
  const State& s = r.run.state;
  while (s.time.t < until && !r.solver->broken())
    if (r.solver->advance({.next = from}) == Solver::Stop::sample) r.count.push_back({r.solver->sample().t, s.sleep.count});
}

// m, at the earlier of the two ends. Impacts shorten the step, and a run ends with the first step past its end.
double apart(const Ran& a, const Ran& b) {
  double out = 0;
  const double t = std::min(a.run.state.time.t, b.run.state.time.t);
  const auto at = [&](const State& s, std::size_t i) { return Vec3(s.pose.u[i] - (s.time.t - t) * s.motion.v[i]); };
  for (std::size_t i = 0; i < a.run.state.pose.u.size(); ++i) out = std::max(out, (at(a.run.state, i) - at(b.run.state, i)).norm());
  return out;
}

}  // namespace

TEST_CASE("a heap that sleeps lies where the one that does not lies", "[solve][sleep]") {
  Ran still, lively;
  go(still, asleep, 3.95, 3.9);
  go(lively, awake, 3.95, 3.9);
  const State &s = still.run.state, &l = lively.run.state;
  CHECK(s.sleep.count == 10);
  CHECK(l.sleep.count == 0);
  INFO("apart " << apart(still, lively) << " m");
  CHECK(apart(still, lively) < 1e-6);  // m: possible creep of 1e-6 m/s for a second, had it not come to rest by itself
  CHECK(s.motion.v[std::size_t(block_index(still.run.model, "b3"))].norm() == 0);
  CHECK(s.energy.sleep > 0);
  CHECK(s.energy.sleep < 10 * 0.5 * 6.75 * 1e-12);  // ten bricks at the speed limit of sleep
  CHECK(s.energy.residual_worst < 1.01 * l.energy.residual_worst);
  CHECK(s.energy.elastic == Approx(l.energy.elastic).epsilon(1e-4));  // of springs that still oscillate below the limits
  CHECK(s.observed.momentum_residual < 1e-9);
  CHECK(s.observed.max_penetration_relative == l.observed.max_penetration_relative);
  CHECK(still.solver->contacts().sums().touching() == lively.solver->contacts().sums().touching());
  const Model& m = still.run.model;
  double weight = 0;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[std::size_t(b)] == Kind::moving && m.block_name[std::size_t(b)] != "top") weight += m.mass[std::size_t(b)] * standard_g;
  CHECK(-still.solver->block_wrench(block_index(m, "ground")).z() == Approx(weight).epsilon(1e-3));
  CHECK(still.solver->contacts().slept() > 0);
}

// Pairs at rest do not act, and yet have the interval of their heap, beside a pier that keeps the step short.
TEST_CASE("a heap with levels sleeps where it would lie awake, and what wakes has the interval of its heap", "[solve][sleep][levels]") {
  for (const int levels : {2, 4}) {
    const std::string how = R"(
    for i = 0, 1 do box{ name = "pier" .. i, material = "brick", group = "pier", size = {.3, .3, .1}, center = {5, 0, .05 + .1 * i}, fixed = i == 0 } end
    joint{ law = mortar{ kn = 1e12, ks = 4e11, ft = 1e7, c = 1e7, mu = .6 }, between = {"pier", "pier"} }
    analysis{ duration = 5, start = 'rest', levels = )" +
                            std::to_string(levels);
    Ran still, lively;
    go(still, how + ", sleep = true }", 3.95);
    go(lively, how + " }", 3.95);
    INFO("levels " << levels << ", apart " << apart(still, lively) << " m");
    CHECK(still.run.state.sleep.count >= 9);
    CHECK(still.run.state.time.substeps == 1 << (levels - 1));
    CHECK(apart(still, lively) < 1e-6);
    for (const double until : {4.2, 4.6}) {         // its tray is drawn away, and the last brick wakes and falls
      const TimeStep& time = still.run.state.time;  // a division of the blocks acts from the next macro step on
      while (time.t < until && !still.solver->broken()) still.solver->advance();
      still.solver->advance({.next = 0});
      const bool levels_now = still.run.state.time.substeps > 1;
      const PairList& list = still.run.state.contacts.list;
      const auto fast = [&](int b) { return !list.fast.empty() && list.fast[std::size_t(b)] != 0; };  // what has just landed
      for (const ContactPair& pair : list.pair) CHECK(int(pair.slow) == int(levels_now && !fast(pair.a) && !fast(pair.b)));
      CHECK(2 * std::ranges::count_if(list.pair, &ContactPair::slow) >= std::ptrdiff_t(levels_now ? list.pair.size() : 0));
    }
    CHECK(still.run.state.energy.residual_worst < 1e-3);
  }
}

TEST_CASE("a sleeper whose support is drawn away falls, and wakes the heap that it falls on", "[solve][sleep]") {
  Ran still, before, lively;
  go(still, asleep, 4.6, 3.99);
  go(before, asleep, 4.46);  // until it lands: the steps of the blow follow differences in the last digits
  go(lively, awake, 4.46);
  int least = 10;
  double falls = 0, lands = 0;
  for (const auto& [t, count] : still.count) {
    if (falls == 0 && count < 10) falls = t;
    if (lands == 0 && count < 9) lands = t;
    least = std::min(least, count);
  }
  CHECK(falls == Approx(4).margin(2 * still.run.state.time.dt_target));
  CHECK(lands - falls > 0.2);
  // Blocks still asleep are isolated: none of them touches a block that is awake.
  const Model& m = still.run.model;
  const auto& asleep_now = still.run.state.sleep.asleep;
  for (const ContactPair& p : still.run.state.contacts.list.pair) {
    const std::size_t a = std::size_t(p.a), b = std::size_t(p.b);
    if (p.touching && m.kind[a] == Kind::moving && m.kind[b] == Kind::moving) CHECK(asleep_now[a] == asleep_now[b]);
  }
  CHECK(least <= 2);
  INFO("apart " << apart(before, lively) << " m");
  CHECK(apart(before, lively) < 1e-6);
  CHECK(still.run.state.energy.residual_worst < 1e-2);
}

TEST_CASE("all wake in the step in which the ground begins to shake, and none sleeps while it does", "[solve][sleep]") {
  const std::string shake = "ground_motion{ direction = 'x', wave = sine{ amplitude = 3, frequency = 5, start = 3.5, duration = 0.4 } }";
  Ran still, lively;
  go(still, shake + asleep, 3.6, 3.48);
  go(lively, shake + awake, 3.6, 3.48);
  for (const auto& [t, count] : still.count) {
    INFO(t);
    if (t < 3.5 - still.run.state.time.dt_target) CHECK(count == 10);
    if (t > 3.5 + still.run.state.time.dt_target) CHECK(count == 0);
  }
  INFO("apart " << apart(still, lively) << " m");
  CHECK(apart(still, lively) < 1e-6);
}

TEST_CASE("a turn of gravity wakes all", "[solve][sleep]") {
  Ran still;
  go(still, "tilt{ axis = 'y', wave = table_wave{ times = {0, 3.5, 3.6, 99}, values = {0, 0, 1e-3, 1e-3} } }" + asleep, 3.55, 3.48);
  CHECK(still.count.front().second == 10);
  CHECK(still.count.back().second == 0);
}

TEST_CASE("threads and samples do not change a bit of debris that sleeps and wakes", "[solve][sleep]") {
  Ran one, two, sampled;
  go(one, asleep, 4.6);
  go(two, asleep, 4.6, 1e9, 2);
  go(sampled, asleep, 4.6, 0);
  CHECK(one.solver->contacts().slept() > 0);
  CHECK(state_hash(one.run.state) == state_hash(two.run.state));
  CHECK(one.run.state.time.step <= sampled.run.state.time.step + 128);
  go(sampled, asleep, one.run.state.time.t - 0.5 * one.run.state.time.dt, 0);
  REQUIRE(one.run.state.time.step == sampled.run.state.time.step);
  CHECK(state_hash(one.run.state) == state_hash(sampled.run.state));
}

TEST_CASE("a run stopped while debris sleeps and resumed ends as if never stopped, to the bit", "[analysis][resume][sleep]") {
  const std::string script =
      heap("recorder{ name = 'ground', quantity = 'reaction', axis = 'z' } analysis{ duration = 4.7, start = 'rest', sleep = true }");
  const auto run = [&](const std::string& dir, Existing existing, std::optional<double> until) {
    Script loaded(Script::Options{.quiet = true});
    const Scene scene = loaded.load_text(script, "heap.lua");
    RunOptions options;
    options.directory = dir;
    options.existing = existing;
    options.until = until;
    return run_dynamic(scene, script, options).metrics;
  };
  const test::Scratch whole("sleep_whole"), parts("sleep_parts");
  const Metrics expected = run(whole.path, Existing::refuse, {});
  Existing existing = Existing::refuse;
  int asleep_then = 0;
  for (const double until : {0.7, 3.7, 4.45}) {
    const Metrics stopped = run(parts.path, existing, until);
    CHECK(stopped.status == "stopped");
    asleep_then = std::max(asleep_then, stopped.blocks_asleep);
    existing = Existing::resume;
  }
  CHECK(asleep_then == 10);
  const Metrics got = run(parts.path, Existing::resume, {});
  CHECK(got.state_hash == expected.state_hash);
  CHECK(got.energy == expected.energy);
  CHECK(got.blocks_asleep == expected.blocks_asleep);
}
