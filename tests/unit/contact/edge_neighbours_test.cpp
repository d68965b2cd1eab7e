// Blocks that meet along an edge at rest: the force they carry while skipped, and a contact test in time.
#include <catch2/catch.hpp>

#include "engine/analysis/start/at_rest.h"
#include "engine/contact/broad/edge_neighbours.h"
#include "engine/solve/step.h"
#include "tests/unit/contact/bodies.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;
using namespace erbs::trial;

namespace {

constexpr double next_to_nothing = 1e-4;  // of the weight

struct Neighbours {
  Bodies bodies;
  ContactPair pair;

  Neighbours(const Polyhedron& a, const Polyhedron& b)
      : bodies({{{a}, 1800}, {{b}, 1800}}, {5e10, 2e10, 0.6, 0.2}, 1e-5), pair(new_pair(0, 0, 1, 0, bodies.law, 0, bodies.shapes)) {}
  PairFrame frame() const { return pair_frame(pair, bodies.shapes, bodies.block[0], bodies.block[1]); }
  EdgeAtRest edge() const { return edge_at_rest(pair, frame(), next_to_nothing); }
};

Polyhedron brick_at(double x, double y, double z) { return translated(brick(), {x, y, z}); }

// Twenty columns of bricks in stack bond on a joint that fails: 38 diagonal neighbours a course.
const char* const stack_bond = R"(
  gravity(g)
  material{ name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = 5e10, ks = 2e10 }
  box{ name = "base", group = "base", material = "brick", size = { 7, 1, .2 }, at = { -.5, -.4, -.2 }, fixed = true }
  for i = 0, 19 do for k = 0, 3 do
    box{ group = "wall", material = "brick", size = { .3, .2, .1 }, at = { .3 * i, 0, .1 * k } }
  end end
  joint{ law = mortar{ kn = 1e12, ks = 4e11, mu = .6, ft = 20 * MPa, c = 30 * MPa } }
  joint{ between = { "base", "wall" }, law = mortar{ kn = 1e12, ks = 4e11, mu = .6, ft = 1e3, c = 1e3 } }
  ground_motion{ wave = sine{ amplitude = g, frequency = 5 }, direction = "x" }
  analysis{ duration = .15 }
)";

}  // namespace

TEST_CASE("edges and corners that meet at zero gap are known, faces and gaps are not", "[contact][edges]") {
  const Polyhedron one = brick_at(0, 0, 0);
  CHECK(Neighbours(one, brick_at(0.3, 0, 0.1)).edge().touches);      // along an edge
  CHECK(Neighbours(one, brick_at(0.3, 0.125, 0.1)).edge().touches);  // at a corner
  CHECK(!Neighbours(one, brick_at(0, 0, 0.1)).edge().touches);
  CHECK(!Neighbours(one, brick_at(0.3, 0, 0.05)).edge().touches);
  CHECK(!Neighbours(one, brick_at(0.301, 0, 0.1)).edge().touches);
}

TEST_CASE("what is not looked at bears next to nothing", "[contact][edges]") {
  const double side = GENERATE(0.0, 0.06, 0.125);
  Neighbours two(brick_at(0, 0, 0), brick_at(0.3, side, 0.1));
  const EdgeAtRest edge = two.edge();
  REQUIRE(edge.touches);
  const double most = next_to_nothing * standard_g * two.bodies.mass[0];
  std::mt19937 random{3};
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  int idle = 0;
  double greatest = 0;
  for (int k = 0; k < 3000; ++k) {
    ContactBlock b = two.bodies.block[1];
    b.u = 0.5 * edge.movement * draw();
    b.rotation = rotation(edge.movement * draw()).toRotationMatrix();
    ContactPair pair = two.pair;
    PairResult r;
    pair_force(pair, two.bodies.shapes, two.bodies.block[0], b, two.bodies.settings, 0, false, two.bodies.room, r);
    const double force = r.wrench.force.norm();
    if (idle_way(edge, pair_frame(pair, two.bodies.shapes, two.bodies.block[0], b).pose) > 0) ++idle, greatest = std::max(greatest, force);
  }
  CHECK(idle > 100);
  CHECK(greatest <= most);
  ContactBlock b = two.bodies.block[1];
  b.u = Vec3(-1.5, 0, -1.5) * edge.movement;
  CHECK(idle_way(edge, pair_frame(two.pair, two.bodies.shapes, two.bodies.block[0], b).pose) < 0);
}

TEST_CASE("the way that a pair may wait is no longer than its blocks take to press", "[contact][edges]") {
  Neighbours two(brick_at(0, 0, 0), brick_at(0.3, 0.03, 0.1));
  const EdgeAtRest edge = two.edge();
  const double reach = two.bodies.shapes.part(0).reach;
  std::mt19937 random{5};
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int k = 0; k < 1000; ++k) {
    const Vec3 u[2] = {draw(), draw()}, turn[2] = {draw() / reach, draw() / reach};
    const double size = 1e-3 * edge.movement, way = size * ((u[1] - u[0]).norm() + reach * (turn[0].norm() + turn[1].norm()));
    ContactBlock at[2] = {two.bodies.block[0], two.bodies.block[1]};
    for (int i = 0; i < 2; ++i) at[i].u = size * u[i], at[i].rotation = rotation(size * turn[i]).toRotationMatrix();
    const double left = idle_way(edge, pair_frame(two.pair, two.bodies.shapes, at[0], at[1]).pose);
    CHECK(left >= idle_way(edge, edge.pose) - 1.001 * way - 1e-15);
  }
}

TEST_CASE("diagonal neighbours of a wall that slides as one are left alone", "[solve][edges]") {
  Script script(quiet());
  const Scene scene = script.load_text(stack_bond, "wall.lua");
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  Solver solver(run.model, run.state, run.range, 1);
  solver.advance_until([&] { return run.state.time.t >= 0.15; });
  const double steps = double(run.state.time.step);
  CHECK(run.state.pose.u[1].norm() > 1e-4);                              // the wall has slid
  CHECK(double(solver.contacts().sums().touched()) < 1.5 * 20 * steps);  // its former joint, and few more: 114 pairs meet along edges
  CHECK(run.state.observed.max_penetration_relative < 1e-3);
}
