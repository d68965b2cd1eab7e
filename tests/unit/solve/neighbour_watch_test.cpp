// Which blocks of an intact structure the watch hands to contact.
#include <catch2/catch.hpp>
#include <numeric>

#include "engine/analysis/dynamic.h"
#include "engine/solve/contacts/neighbour_watch.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

struct Watched {
  Prepared run;
  ContactBodies bodies;
  NeighbourWatch watch;

  explicit Watched(const std::string& script) : run(prepared(script)), bodies(run.model), watch(run.model, run.state, bodies, 0.006) {
    bodies.initialise();
  }
  static Prepared prepared(const std::string& script) {
    Script loaded(Script::Options{.quiet = true});
    return prepare(loaded.load_text(script, "watch.lua"), false);
  }
  // Names of nothing: the number of blocks marked.
  int marks(double time) {
    std::vector<std::uint8_t> loose(std::size_t(run.model.nblock), 0);
    watch.find(time, loose);
    return std::accumulate(loose.begin(), loose.end(), 0);
  }
  State& state() { return run.state; }
};

// Bricks in columns without bond between the courses: corners meet in fours.
const std::string stacked = R"(
  material{ name = "brick", density = 1800, kn = 2e10, ks = 8e9 }
  box{ name = "foot", fixed = true, size = {2, .1, .1}, at = {-1, 0, -.1} }
  for x = 0, 2 do for z = 0, 2 do box{ name = "b" .. x .. z, size = {.2, .1, .06}, at = {.2 * x, 0, .06 * z} } end end
  joint{ law = mortar{ kn = 1e11, ks = 4e10, ft = 1e5, c = 1e5, mu = .6 } } gravity(g) analysis{ duration = 1 }
)";

// Two towers of two bricks, with a gap.
std::string towers(double gap) {
  return "material{ name = 'brick', density = 1800, kn = 2e10, ks = 8e9 } box{ name = 'foot', fixed = true, size = {2, .1, .1}, at = {-1, "
         "0, -.1} }"
         "for i, x in ipairs{ 0, .2 + " +
         std::to_string(gap) +
         " } do for z = 0, 1 do box{ name = 'b' .. i .. z, size = {.2, .1, .06}, at = {x, 0, .06 * z} } end end joint{ law = mortar{ kn = "
         "1e11, "
         "ks = 4e10, ft = 1e5, c = 1e5, mu = .6 } } joint{ between = { 'none', '' }, none = true, optional = true } gravity(g) analysis{ "
         "duration = 1 }";
}

}  // namespace

TEST_CASE("bricks that meet at corners alone are no contacts until they have moved", "[solve][contact]") {
  Watched wall(stacked);
  CHECK(wall.marks(0.01) == 0);
  wall.state().pose.u[5].x() = 0.002;
  CHECK(wall.marks(0.01) == 0);
  wall.state().pose.u[5].x() = 0.004;  // the brick in the middle, beyond half the margin
  CHECK(wall.marks(0.01) > 0);
}

TEST_CASE("towers with a gap are contacts once their speed may close it", "[solve][contact]") {
  Watched apart(towers(0.02));
  REQUIRE(apart.run.model.nblock == 5);
  CHECK(apart.marks(0.01) == 0);
  apart.state().motion.v[2].x() = 1;  // the upper brick of the first tower
  CHECK(apart.marks(0.005) == 0);
  CHECK(apart.marks(0.025) >= 2);
  apart.state().motion.v[2].x() = 0;
  apart.state().pose.u[2].x() = 0.0199;
  CHECK(apart.marks(0.005) >= 2);
  for (int b = 1; b < 5; ++b) apart.state().motion.v[std::size_t(b)].x() = 0;
  apart.state().pose.u[2].x() = 0;
  for (int b = 1; b < 5; ++b) apart.state().pose.u[std::size_t(b)].x() = 3;  // all of them far away: no way towards each other
  CHECK(apart.marks(0.005) == 0);
}

TEST_CASE("the watch decides by the present state, whenever it listed its pairs", "[solve][contact]") {
  Watched old(towers(0.05));
  for (int i = 0; i < 40; ++i) {
    for (const std::size_t b : {1u, 2u}) old.state().pose.u[b].x() = 0.0005 * i * double(b), old.state().motion.v[b].x() = 0.1 * i;
    Watched fresh(towers(0.05));
    fresh.state() = old.state();
    CHECK(old.marks(0.006) == fresh.marks(0.006));
  }
}
