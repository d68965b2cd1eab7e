// Stiffness of a contact patch, against closed forms of a brick on a slab.
#include "engine/contact/law/patch_stiffness.h"

#include <catch2/catch.hpp>

#include "tests/unit/contact/bodies.h"

using namespace erbs;
using namespace erbs::trial;

TEST_CASE("the patch under a brick resists as its closed forms say, from whichever side it is seen", "[contact][step]") {
  const double kn = 1e10, ks = 4e9, depth = 1e-7, l = 0.30, b = 0.125, h = 0.10, area = l * b;
  const bool slab_first = GENERATE(true, false);
  const Polyhedron slab = box_polyhedron({-1, -1, -0.2}, {1, 1, 0}), stone = translated(brick(l, b, h), {0.3, -0.2, h / 2 - depth});
  const Body ground{{slab}, 0}, body{{stone}};
  Bodies two(slab_first ? std::vector{ground, body} : std::vector{body, ground}, {kn, ks, 0.6, 0.2}, 1e-6);
  two.forces();
  REQUIRE(two.list.pair.size() == 1);
  PatchStiffness k;
  REQUIRE(patch_stiffness(two.list.pair.front(), two.shapes, two.block[0], two.block[1], two.room, k));
  const Mat6& on = slab_first ? k.on_b : k.on_a;
  const double along = l * l / 12, across = b * b / 12, arm = h / 2;
  Mat6 paper = Mat6::Zero();
  paper.diagonal() << ks * area, ks * area, kn * area, kn * area * across + ks * area * arm * arm,
      kn * area * along + ks * area * arm * arm, ks * area * (along + across);
  paper(0, 4) = paper(4, 0) = -ks * area * arm;  // a force along x rotates it about y
  paper(1, 3) = paper(3, 1) = ks * area * arm;
  // Tolerance: the depth as a share of the sides, which carry pressure too.
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) CHECK(on(r, c) == Approx(paper(r, c)).epsilon(1e-4).margin(1e-4 * kn * area * arm * arm));
}
