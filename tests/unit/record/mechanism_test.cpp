#include "engine/record/results/mechanism.h"

#include <catch2/catch.hpp>

#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

// Brick 1 rotated by `angle` about the lower edge at x = 0.1, z = 0.05, then shifted.
test::TwoBricks turned(double angle, const Vec3& shift) {
  auto t = test::two_bricks();
  const Vec3 edge(0.1, 0, 0.05), arm = t.model.rest[1] - edge;
  t.state.pose.q[1] = rotation(Vec3(0, angle, 0));
  t.state.pose.u[1] = t.state.pose.q[1] * arm - arm + shift;
  return t;
}

}  // namespace

TEST_CASE("a block on its edge is a hinge, and the edge is found", "[record][mechanism]") {
  const auto t = turned(0.1, Vec3::Zero());
  const Mechanism m = mechanism_of(t.model, t.state.pose, 2.0);
  REQUIRE(m.moved.size() == 1);
  CHECK(m.moved[0].kind == Movement::hinge);
  CHECK(m.moved[0].rotation == Approx(0.1));
  CHECK(m.moved[0].opening == Approx(0.02).epsilon(0.01));
  CHECK(m.moved[0].slip < 0.002);
  CHECK(m.moved[0].at[0] == Approx(0.1));
  CHECK(std::abs(m.moved[0].at[1]) < 1e-12);
  CHECK(m.moved[0].at[2] == Approx(0.05));
  CHECK(summary(m, t.model) == "1 joint opened as a hinge: between base and top by 5.7 deg");
}

TEST_CASE("a shifted block has slid, a lifted one has parted, a still one is no mechanism", "[record][mechanism]") {
  const auto slid = turned(0.01, {0.03, 0, 0}), lifted = turned(0.01, {0, 0.001, 0.04}), still = turned(0, {1e-5, 0, 0});
  CHECK(summary(mechanism_of(slid.model, slid.state.pose, 0), slid.model) == "1 joint slid: between base and top by 30 mm");
  CHECK(summary(mechanism_of(slid.model, slid.state.pose, 0), slid.model, 0) ==
        "1 joint slid, most of all between base and top by 30 mm; metrics.json lists them all");
  CHECK(
      summary(mechanism_of(lifted.model, lifted.state.pose, 0), lifted.model).starts_with("1 joint separated: between base and top by 4"));
  CHECK(count(mechanism_of(lifted.model, lifted.state.pose, 0), Movement::part) == 1);
  CHECK(mechanism_of(still.model, still.state.pose, 0).moved.empty());
  CHECK(summary(mechanism_of(still.model, still.state.pose, 0), still.model).empty());
}
