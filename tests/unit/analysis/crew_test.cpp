// The number of threads follows the speed at the moment, and no result depends on it.
#include "engine/analysis/crew.h"

#include <catch2/catch.hpp>

#include "engine/analysis/start/at_rest.h"
#include "engine/model/state_fields.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/solve/step.h"
#include "lua/language/script.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

// A machine with two processors; another program takes the share `taken` of one. It counts seconds and steps of a `Crew`.
struct Machine {
  double speed = 1e5, gain = 1.5,
         idle = 0;  // steps/s of one thread; of two, over that; share of a second processor that a team leaves idle
  double cost = 0;  // s, of a change
  double wall = 0, processor = 0, step = 0;
  int changes = 0;
  void run(Crew& crew, double seconds, double taken) {
    for (const double end = wall + seconds; wall < end;) {
      const bool team = crew.threads() == 2;
      wall += 0.01;
      step += 0.01 * speed * (team ? gain * (taken > 0 ? 0.4 * (1 - taken) : 1) : 1);
      processor += 0.01 * (team ? 2 - taken - idle : 1);
      if (!crew.should_change(long(step), wall, processor)) continue;
      ++changes;
      wall += cost, processor += cost;
      crew.took(cost);
    }
  }
};

}  // namespace

TEST_CASE("a team whose processor is taken goes on alone, and comes together once it is free", "[crew]") {
  Crew crew(2);
  Machine machine;
  machine.run(crew, 5, 0);
  CHECK(crew.threads() == 2);
  CHECK(machine.changes == 0);
  machine.run(crew, 1, 0.5);
  const double before = machine.step;
  machine.run(crew, 20, 0.5);
  CHECK(machine.step - before > 0.9 * 20e5);  // of the steps of one thread
  machine.run(crew, 31, 0);
  CHECK(crew.threads() == 2);
}

TEST_CASE("a team with much work for one thread stays together while it is faster, also where steps are long", "[crew]") {
  const double speed = GENERATE(20.0, 60.0, 1e3, 1e5), cost = GENERATE(0.0, 0.1, 1.0);
  Crew crew(2);
  Machine machine{.speed = speed, .gain = 1.4, .idle = 0.5, .cost = cost};
  machine.run(crew, 300, 0);
  const double before = machine.step, from = machine.wall;
  machine.run(crew, 900, 0);
  // A trial takes 48 steps alone and two changes, in 30 s and in 40 of the cost of a change: at most 3 and 5 %.
  CHECK(machine.step - before > 0.92 * 1.4 * speed * (machine.wall - from));
}

TEST_CASE("one thread stays one", "[crew]") {
  Crew crew(1);
  CHECK_FALSE(crew.should_change(1000, 100, 1));
  CHECK(crew.threads() == 1);
}

TEST_CASE("a run that changes its number of threads on the way has the bits of one that does not", "[crew]") {
  const char* const walls = R"(
material{ name = "brick", density = 1800, friction = 0.6 }
ground{ z = 0, size = 20, material = "brick" }
for i, n in ipairs{6, 4} do
  wall{ name = "w" .. i, at = {0, i * 1.5, 0}, length = 1.25 - 0.1 * i, courses = n,
        brick = {length = 0.3, width = 0.125, height = 0.1}, joint = 10*mm, quiet = true }
end
joint{ law = mortar{ E = 200*MPa, thickness = 10*mm, ft = 0.03*MPa, c = 0.06*MPa, mu = 0.6 }, thickness = 10*mm }
ground_motion{ wave = sine{ amplitude = 2*g, frequency = 5 }, direction = "y" }
analysis{ duration = 0.4 }
)";
  std::string hash[2];
  for (const bool changing : {false, true}) {
    Script script(Script::Options{.quiet = true});
    const Scene scene = script.load_text(walls, "scene.lua");
    Prepared run = prepare(scene, false);
    start_at_rest(scene, run, 1);
    int threads = 1, should_change = 0;
    for (bool ended = false; !ended;) {
      Solver solver(run.model, run.state, run.range, threads);
      solver.advance_until([&] { return (ended = run.state.time.t >= 0.4) || (changing && ++should_change % 5 == 0); });
      threads = 3 - threads;
    }
    hash[changing] = state_hash(run.state);
    CHECK(run.state.contacts.list.pair.size() > 0);
  }
  CHECK(hash[0] == hash[1]);
}
