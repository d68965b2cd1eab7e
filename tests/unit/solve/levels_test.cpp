// Levels (model/levels.h): contacts of loose blocks act once in several steps while a stiff joint keeps the step short. Accounts stay
// exact, and bits do not depend on threads or stops.
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "engine/analysis/dynamic.h"
#include "engine/analysis/start/at_rest.h"
#include "engine/analysis/start/prepare.h"
#include "engine/model/levels.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/record/format/csv.h"
#include "engine/solve/step.h"
#include "tests/support/small_wall.h"
#include "tests/unit/record/two_bricks.h"
#include "tests/unit/solve/scene_run.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;
using test::dynamic_run;

namespace {

// Two bonded blocks that keep the step short.
std::string pier(const std::string& material) {
  return R"(
    for i = 0, 1 do
      box{ name = "pier" .. i, group = "pier", material = ")" +
         material + R"(", size = {.3, .3, .1}, center = {5, 0, .05 + .1 * i}, fixed = i == 0 }
    end
    joint{ law = mortar{ kn = 2e13, ks = 8e12, ft = 1e8, c = 1e8, mu = .6 }, between = {"pier", "pier"} })";
}

// A dry wall is thrown over; its bricks fall on each other and on soft ground, beside a stiff pier.
std::string falling(int levels) {
  return R"(
    material{ name = "brick", density = 1800, friction = 0.6, kn = 1e10 }
    material{ name = "earth", density = 1800, friction = 0.6, kn = 5e8 }
    ground{ size = 20, material = "earth" }
    wall{ name = "w", at = {0, 0, 0}, length = 1.2, courses = 7, brick = {length = 0.3, width = 0.125, height = 0.1}, joint = 0, quiet = true }
    joint{ law = dry{ kn = 2e11, mu = 0.6 }, between = {"w", "w"} }
    joint{ law = dry{ kn = 2e11, mu = 0.6 }, between = {"w", "ground"} })" +
         pier("brick") + R"(
    ground_motion{ wave = half_sine{ amplitude = 2*g, frequency = 2 }, direction = "y" }
    analysis{ duration = 1, levels = )" +
         std::to_string(levels) + " }";
}

}  // namespace

TEST_CASE("a slow pair has the interval of macro steps, a fast one that of steps", "[levels]") {
  TimeStep time;
  time.last_dt = 2e-6, time.last_substeps = 3, time.dt = 1e-6, time.substeps = 4;
  CHECK(interval_before(time, false) == 2e-6);
  CHECK(interval_before(time, true) == Approx(6e-6));
  CHECK(interval_after(time, false) == 1e-6);
  CHECK(interval_after(time, true) == Approx(4e-6));
}

TEST_CASE("the ledger and the fall are those of one level", "[levels]") {
  Metrics of[2];
  for (const int levels : {1, 4}) {
    const test::Scratch to("levels_fall");
    Metrics& m = of[levels > 1];
    m = dynamic_run(falling(levels), to.path, Existing::refuse);
    INFO("levels " << levels);
    CHECK(m.status == "completed");
    CHECK(m.collapse.collapsed);
    CHECK(m.residual_relative < 5e-4);
    CHECK(m.momentum_residual < 1e-9);
  }
  CHECK(of[1].collapse.time_s.value_or(0) == Approx(of[0].collapse.time_s.value_or(1)).margin(0.02));
  CHECK(of[1].state_hash != of[0].state_hash);  // levels were used
}

TEST_CASE("in a small heap where no joint keeps the step short, levels change no bit", "[levels]") {
  std::string hash[2];
  for (const bool levels : {false, true}) {
    const std::string text = std::string(R"(
    material{ name = "brick", density = 1800, friction = 0.6, kn = 1e10 }
    ground{ size = 20 }
    for i = 0, 5 do
      box{ name = "b" .. i, free = true, size = {0.3, 0.125, 0.1}, center = {.1 * (i % 2), 0, .06 + .12 * i}, rotation = {.1 * i, .05, 0} }
    end
    analysis{ duration = .5, levels = )") +
                             (levels ? "4" : "1") + " }";
    const test::Scratch to("levels_loose");
    hash[levels] = dynamic_run(text, to.path, Existing::refuse).state_hash;
  }
  CHECK(hash[0] == hash[1]);
}

// The ground sways a little at .9 s, which wakes a brick that has slept beside another that still bounces.
TEST_CASE("a sleeper wakes alike in a run with levels that was stopped, and is recorded at rest", "[levels][sleep][resume]") {
  const std::string text = R"(
    material{ name = "brick", density = 1800, friction = 0.6, restitution = 0.1, kn = 1e9, ks = 4e8 }
    ground{ size = 40, material = "brick" }
    box{ name = "still", size = {.3, .125, .1}, center = {0, 1, .05}, free = true }
    box{ name = "late", size = {.3, .125, .1}, center = {0, 0, 1}, rotation = {.4, .2, 0}, free = true }
    ground_motion{ wave = sine{ amplitude = .01 * g, frequency = 4, start = .9, duration = 1 }, direction = "x" }
    recorder{ name = "still", quantity = "velocity", block = "still" }
    analysis{ duration = .95, start = "rest", levels = 4, output_dt = 1e-4, sleep = true })" +
                           pier("brick");
  const test::Scratch whole("sleeper_whole"), stopped("sleeper_stopped");
  const Metrics one = dynamic_run(text, whole.path, Existing::refuse);
  CHECK(one.momentum_residual < 1e-12);
  for (const double until : {.7, .8}) dynamic_run(text, stopped.path, until < .75 ? Existing::refuse : Existing::resume, until);
  const Metrics other = dynamic_run(text, stopped.path, Existing::resume);
  CHECK(other.state_hash == one.state_hash);
  CHECK(other.momentum_residual == one.momentum_residual);
  const CsvTable rows = read_csv(whole.path + "/histories.csv");
  const std::vector<double> t = rows.column("time_s"), v = rows.column("still_vz_rel_m_s");
  int still = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < .5 || t[i] > .9) continue;
    CHECK(v[i] == 0);
    ++still;
  }
  CHECK(still > 3000);
}

// A driven block takes a new velocity in every step, also within a macro step.
TEST_CASE("the velocity of a driven block is recorded with levels as without", "[levels]") {
  for (const int levels : {1, 4}) {
    const test::Scratch to("levels_driven");
    dynamic_run(R"(
    material{ name = "brick", density = 1800, friction = 0.6, kn = 1e9 }
    ground{ size = 40, material = "brick" }
    box{ name = "plate", size = {.3, .3, .1}, center = {2, 0, 1}, free = true }
    box{ name = "rests", size = {.3, .125, .1}, center = {0, 0, .05}, free = true }
    motion{ block = "plate", direction = "x", wave = sine{ amplitude = .15, frequency = 3 } }
    recorder{ name = "plate", quantity = "velocity", block = "plate" }
    analysis{ duration = .4, start = "rest", output_dt = 2e-3, levels = )" +
                    std::to_string(levels) + " }" + pier("brick"),
                to.path, Existing::refuse);
    const CsvTable rows = read_csv(to.path + "/histories.csv");
    const std::vector<double> t = rows.column("time_s"), v = rows.column("plate_vx_rel_m_s");
    const double w = 2 * pi * 3;
    double error = 0;
    for (std::size_t i = 1; i < t.size(); ++i) error = std::max(error, std::fabs(v[i] - 0.15 * w * std::cos(w * t[i])));
    INFO("levels " << levels);
    CHECK(error < 1e-6);  // m/s, of central differences; the interval of a macro step would leave 2e-3
  }
}

// Weight acts together with the contact that bears it: were it to act more often, the soft brick would fall and be pushed back within each
// interval, and the ledger of 4 and 6 levels would show 1.6e-4.
TEST_CASE("the ledger of bricks at rest closes beside a shorter interval", "[levels]") {
  for (const char* kn : {"1e8", "1e9", "1e10"}) {
    std::string one_level;
    for (const int levels : {1, 2, 4, 6}) {
      const std::string text = std::string(R"(
    material{ name = "hard", density = 1800, friction = 0.6, kn = 2e11 }
    material{ name = "soft", density = 1800, friction = 0.6, kn = )") +
                               kn + R"( }
    ground{ size = 20, material = "soft" }
    for i, kind in ipairs{ "soft", "hard" } do
      box{ name = kind, material = kind, free = true, size = {0.3, 0.125, 0.1}, center = {i, 0, 0.05} }
    end
    box{ name = "small", material = "hard", free = true, size = {0.03, 0.03, 0.01}, center = {2, 0, 0.105} })" +
                               pier("hard") + "\n    analysis{ duration = 1, levels = " + std::to_string(levels) + " }";
      const test::Scratch to("levels_rest");
      const Metrics m = dynamic_run(text, to.path, Existing::refuse);
      INFO("kn " << kn << ", levels " << levels);
      CHECK(m.status == "completed");
      CHECK(m.residual_relative < 2e-5);
      if (levels == 1) one_level = m.state_hash;
      else CHECK(m.state_hash != one_level);  // levels were used
    }
  }
}

// Samples lie at the start of macro steps. None is left out, however short the time between them.
TEST_CASE("a macro step is no longer than the time between two rows", "[levels]") {
  const double duration = 0.01;
  for (const double every : {2e-5, 4e-5, 6e-5, 1.4e-4}) {
    std::string one_level;
    for (const int levels : {1, 4, 8}) {
      const std::string text = fmt::format(R"(
    material{{ name = "soft", density = 1800, friction = 0.6, kn = 1e7 }}
    ground{{ size = 20, material = "soft" }}
    for i = 0, 3 do box{{ name = "brick" .. i, free = true, size = {{0.3, 0.125, 0.1}}, center = {{i, 0, 0.05}} }} end
    {}
    analysis{{ duration = {}, output_dt = {}, levels = {} }})",
                                           pier("soft"), duration, every, levels);
      const test::Scratch to("levels_rows");
      const std::string hash = dynamic_run(text, to.path, Existing::refuse).state_hash;
      if (levels == 1) one_level = hash;
      else CHECK(hash != one_level);  // levels were used
      const std::vector<double> t = read_csv(to.path + "/energy.csv").column("time_s");
      INFO(every << " s, " << levels << " levels");
      const double due = std::ceil(duration / every - 1e-6) + 1;
      CHECK(double(t.size()) <= due + 1);  // and the end
      CHECK(double(t.size()) >= due - 1);  // the last two may fall on one step
      for (std::size_t i = 1; i + 1 < t.size(); ++i) CHECK(t[i] - t[i - 1] < 2.01 * every);
    }
  }
}

// Between two kicks of a slow spring, once in an interval H, a fast mode of frequency w turns by the angle w H. The map of both together
// has the trace 2 cos(w H) - (w H / r) sin(w H), r the ratio of the stiffnesses, and grows where its magnitude exceeds 2 (Biesiadecki and
// Skeel 1993; Fong, Darve and Lew 2008): just below each multiple of pi, in a band of width pi / r. Intervals up to w H = 1 are far below.
TEST_CASE("resonance of a slow spring with a fast mode lies beyond the intervals of levels", "[levels]") {
  const auto trace = [](double angle, double ratio) { return 2 * std::cos(angle) - angle / ratio * std::sin(angle); };
  for (double ratio = 1; ratio < 2e6; ratio *= 10) {
    INFO("ratio " << ratio);
    for (double angle = 0.01; angle <= 1; angle += 0.01) CHECK(std::fabs(trace(angle, ratio)) < 2);
    const double pi = std::acos(-1.0);
    CHECK(std::fabs(trace(pi - 0.5 / std::max(1.0, ratio), ratio)) > 2);
    if (ratio >= 100) CHECK(std::fabs(trace(pi - 4 / ratio, ratio)) < 2);  // below the band
  }
}

// Two springs on one mass: a bonded bed above, and below soft ground, whose contact alone would bear an interval of up to a thousand steps.
TEST_CASE("a soft contact on a block with a stiff joint acts as often as the joint", "[levels]") {
  const auto result = [](double ratio, int levels) {
    const std::string text = fmt::format(R"(
    local soft, ratio = 1e7, {}
    material{{ name = "brick", density = 1800, friction = 0.6, kn = soft }}
    ground{{ size = 20, material = "brick" }}
    box{{ name = "anvil", group = "above", size = {{0.3, 0.125, 0.1}}, center = {{0, 0, 0.15}}, fixed = true }}
    box{{ name = "brick", group = "below", size = {{0.3, 0.125, 0.1}}, center = {{0, 0, 0.05}} }}
    for i = 1, 5 do box{{ name = "free" .. i, size = {{0.3, 0.125, 0.1}}, center = {{i, 0, 0.05}}, free = true }} end
    joint{{ law = mortar{{ kn = ratio * soft, ks = 0.4 * ratio * soft, ft = 1e7, c = 1e7, mu = 0.6 }}, between = {{"above", "below"}} }}
    analysis{{ duration = 0.2, start = "equilibrium", levels = {} }})",
                                         ratio, levels);
    const test::Scratch to("levels_two_springs");
    return dynamic_run(text, to.path, Existing::refuse);
  };
  for (const double ratio : {1.0, 1e2, 1e4, 1e6}) {
    INFO("ratio " << ratio);
    // The brick lifts off and lands by some 1e-7 m, with one level as well; 2e-5 is the bound of the free brick at rest, as above.
    const Metrics eight = result(ratio, 8), one = result(ratio, 1);
    CHECK(eight.residual_relative < 1.1 * one.residual_relative + 2e-5);
    if (ratio > 1e5) CHECK(eight.state_hash != one.state_hash);  // levels were used once the free bricks had settled
  }
}

TEST_CASE("a run with levels has the same bits for any number of threads, and when it was stopped within macro steps", "[levels][resume]") {
  const std::string text = falling(5);
  const test::Scratch whole("levels_whole"), threads("levels_threads"), parts("levels_parts");
  const Metrics expected = dynamic_run(text, whole.path, Existing::refuse);
  CHECK(dynamic_run(text, threads.path, Existing::refuse, {}, 3).state_hash == expected.state_hash);
  Existing existing = Existing::refuse;
  for (const double until : {0.3, 0.45, 0.5203, 0.61, 0.8}) dynamic_run(text, parts.path, existing, until), existing = Existing::resume;
  const Metrics got = dynamic_run(text, parts.path, existing);
  CHECK(got.steps == expected.steps);
  CHECK(got.state_hash == expected.state_hash);
  CHECK(got.energy == expected.energy);
}

namespace {

// Hash of the state at its end, with one Solver or with a new one whenever the ledger has closed for the `every`th time.
std::string hash_with_new_solvers(const std::string& text, double until, int every) {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(text, "scene.lua");
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  std::optional<Solver> solver(std::in_place, run.model, run.state, run.range, 1);
  for (int closed = 1; run.state.time.t < until && !solver->broken(); ++closed) {
    solver->advance();
    if (every > 0 && closed % every == 0) solver.emplace(run.model, run.state, run.range, 1);
  }
  return state_hash(run.state);
}

// A heap of loose bricks, and one that strikes it and flies off.
std::string thrown_heap(const std::string& kn) {
  return R"(
    material{ name = "brick", density = 1800, friction = 0.6, restitution = .5, kn = )" +
         kn + R"( }
    ground{ size = 40, material = "brick" }
    for i = 0, 11 do
      box{ name = "b" .. i, free = true, size = {.3, .125, .1}, center = {.1 * (i % 2), 0, .06 + .2 * i}, rotation = {.1 * i, .05, 0},
           initial = { velocity = {(i % 3 - 1) * 2, i % 2, -2} } }
    end)" +
         pier("brick") + R"(
    analysis{ duration = 2, levels = 8, start = "rest" })";
}

}  // namespace

// A Solver knows from the state alone what it needs, as after a resumption: of blocks that fly off, too, which leave all their pairs.
TEST_CASE("a Solver that is built anew in a run with levels continues with the same bits", "[levels][resume]") {
  for (const char* kn : {"1e8", "1e10"}) {
    const std::string one = hash_with_new_solvers(thrown_heap(kn), .7, 0);
    for (const int every : {1, 7}) {
      INFO("kn " << kn << ", every " << every);
      CHECK(hash_with_new_solvers(thrown_heap(kn), .7, every) == one);
    }
  }
}
