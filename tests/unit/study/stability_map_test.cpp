#include "engine/study/stability_map.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace erbs;
using namespace erbs::study;

namespace {

// One mass on one spring, omega = 1: is the leapfrog with mass damping bounded?
bool bounded(double dt, double c, bool explicit_damping) {
  double x = 1, v = 0;
  for (int i = 0; i < 20000 && std::fabs(x) < 1e6; ++i) {
    v = explicit_damping ? (1 - c * dt) * v - dt * x : ((1 - 0.5 * c * dt) * v - dt * x) / (1 + 0.5 * c * dt);
    x += dt * v;
  }
  return std::fabs(x) < 1e6;
}

const Stiffness one = {2, std::sqrt(2.0), 0.5};  // omega_max = 1

}  // namespace

TEST_CASE("the room of mass damping is where a mass on a spring stays bounded", "[study][map]") {
  for (const double dt : {0.1, 1.0, 1.9}) {
    const auto centred = room_of({false, false}, one, dt), direct = room_of({false, true}, one, dt);
    REQUIRE(centred);
    REQUIRE(direct);
    CHECK(std::isinf(centred->most));
    CHECK(bounded(dt, 1e3, false));
    CHECK(bounded(dt, 0.995 * direct->most, true));
    CHECK_FALSE(bounded(dt, 1.005 * direct->most, true));
  }
  CHECK_FALSE(room_of({false, false}, one, 2.01));
  CHECK_FALSE(bounded(2.01, 0, false));
}

TEST_CASE("the sweep needs what it feeds, up to the limit of a block between held neighbours", "[study][map]") {
  const auto room = room_of({true, false}, one, 1.0);
  REQUIRE(room);
  CHECK(room->least == Approx(0.25));
  CHECK_FALSE(room_of({true, false}, one, 1.42));
  // Four times the stiffness: half the limits, four times the energy input.
  CHECK_FALSE(room_of({true, false}, stiffer(one, 4), 0.71));
  CHECK(room_of({true, false}, stiffer(one, 4), 0.7)->least == Approx(0.7));
  MapRun run;
  run.scheme.sequential = true, run.dt = 1, run.damping = 0.2;
  CHECK_FALSE(foretold(run, one));
  run.damping = 0.3;
  CHECK(foretold(run, one));
}

TEST_CASE("runs of a map are compared at the last time at which both were looked at", "[study][map]") {
  MapRun run, reference;
  CHECK_FALSE(ratio_of(run, reference));
  reference.seen = {{0.01, 2}, {0.1, 4}, {0.5, 8}};
  run.seen = {{0.01001, 1}, {0.1001, 3}};
  CHECK(*ratio_of(run, reference) == Approx(0.75));
  run.seen.push_back({0.3, 1e3});  // the run ended here by its time limit
  CHECK(*ratio_of(run, reference) == Approx(0.75));
}
