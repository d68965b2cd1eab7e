// Separated pairs, tested again with the separating feature of their last test.
#include <catch2/catch.hpp>
#include <random>

#include "engine/contact/law/frame.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/contact/law/pair_batch.h"
#include "tests/unit/contact/bodies.h"

using namespace erbs;
using namespace erbs::trial;

namespace {

Polyhedron prism() {  // lies on its side, 6 corners and 5 faces
  Polyhedron p;
  p.vertices = {{-.1, -.06, -.05}, {.1, -.06, -.05}, {0, -.06, .07}, {-.1, .06, -.05}, {.1, .06, -.05}, {0, .06, .07}};
  p.faces = {{0, 1, 2}, {5, 4, 3}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  return p;
}

}  // namespace

TEST_CASE("a pair judged in short is as far apart, and lands as hard, as one judged in full", "[contact]") {
  std::mt19937 random(7);
  const auto draw = [&](double most) { return std::uniform_real_distribution(-most, most)(random); };
  int faces = 0, other_faces = 0, edges = 0, impact_bound = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Bodies two({{{trial % 2 ? brick() : prism()}}, {{trial % 3 ? brick(0.2, 0.2, 0.2) : prism()}}}, {1e9, 4e8, 0.6, 0.2}, 2e-5);
    ContactBlock &a = two.block[0], &b = two.block[1];
    ContactPair pair = new_pair(0, 0, 1, 0, two.law, impact_factor(two.law.restitution), two.shapes);
    for (ContactBlock* block : {&a, &b}) {
      block->rotation = Quat(draw(1), draw(1), draw(1), draw(1)).normalized().toRotationMatrix();
      block->u = Vec3(draw(0.16), draw(0.16), draw(0.16));
      block->v = Vec3(draw(5), draw(5), draw(5));
      block->w = Vec3(draw(5), draw(5), draw(5));
    }
    PairResult before;
    if (pair_force(pair, two.shapes, a, b, two.settings, 2e-5, false, two.room, before) || !(before.apart > 1e-4)) continue;
    b.u += Vec3(draw(5e-5), draw(5e-5), draw(5e-5));
    const PairBodies bodies = bodies_of(pair, two.shapes);
    const PairFrame frame{bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
    const double dt = 2e-5 * (1 + trial % 50);
    PairResult in_short, in_full;
    REQUIRE(still_separated(cached_axis(pair, *bodies.reference, *bodies.other), pair, frame, two.settings, dt, in_short));
    const int kept_by = pair.separating_axis, own = int(bodies.reference->normal.size()), all = own + int(bodies.other->normal.size());
    CHECK_FALSE(pair_force(pair, two.shapes, a, b, two.settings, dt, false, two.room, in_full));
    CHECK(pair.separating_axis == kept_by);
    CHECK(in_short.apart == Approx(in_full.apart).margin(1e-14));
    // by the part of a face that can press within some steps, which follows the distance
    CHECK(in_short.impact_omega2_a == Approx(in_full.impact_omega2_a).epsilon(1e-9));
    CHECK(in_short.impact_omega2_b == Approx(in_full.impact_omega2_b).epsilon(1e-9));
    faces += kept_by < own,
        other_faces += kept_by >= own && kept_by<all, edges += kept_by >= all, impact_bound += in_full.impact_omega2_a> 0;
  }
  CHECK(faces > 100);
  CHECK(other_faces > 100);
  CHECK(edges > 20);
  CHECK(impact_bound > 100);
}

TEST_CASE("bodies that turn together come no nearer: only their relative motion foretells a blow", "[contact]") {
  std::mt19937 random(11);
  const auto draw = [&](double most) { return std::uniform_real_distribution(-most, most)(random); };
  int foretold = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    Bodies two({{{trial % 2 ? brick() : prism()}}, {{brick(0.2, 0.2, 0.2)}}}, {1e9, 4e8, 0.6, 0.2}, 2e-5);
    two.settings.event_budget = 1e-4;
    ContactBlock &a = two.block[0], &b = two.block[1];
    for (ContactBlock* block : {&a, &b}) {
      block->rotation = Quat(draw(1), draw(1), draw(1), draw(1)).normalized().toRotationMatrix();
      block->u = Vec3(draw(0.16), draw(0.16), draw(0.16));
      block->v = trial % 3 ? Vec3(draw(2), draw(2), draw(2)) : Vec3(Vec3::Zero());
      block->w = trial % 3 ? Vec3(draw(2), draw(2), draw(2)) : Vec3(Vec3::Zero());
    }
    const auto foresee = [&] {
      ContactPair pair = new_pair(0, 0, 1, 0, two.law, impact_factor(two.law.restitution), two.shapes);
      PairResult result;
      pair_force(pair, two.shapes, a, b, two.settings, 2e-5, false, two.room, result);
      return result;
    };
    const PairResult alone = foresee();
    if (!(alone.apart > 1e-6)) continue;
    const Vec3 speed(draw(5), draw(5), draw(5)), spin(draw(9), draw(9), draw(9));
    for (ContactBlock* block : {&a, &b}) block->v += speed + spin.cross(block->rest + block->u), block->w += spin;
    const PairResult carried = foresee();
    CHECK(carried.event_rate == Approx(alone.event_rate).epsilon(1e-6).margin(1e-6));
    CHECK(carried.impact_omega2_a == Approx(alone.impact_omega2_a).epsilon(1e-6));
    if (trial % 3 == 0) CHECK(carried.event_rate < 1e-6);
    foretold += alone.event_rate > 0;
  }
  CHECK(foretold > 100);
}
