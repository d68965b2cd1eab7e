// Limit analysis against numbers on paper: columns, walls, arches, wedges.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/units.h"
#include "tests/unit/analysis/limit/limit_scenes.h"

using namespace erbs;
using namespace erbs::test;
using analysis::LimitOptions;
using analysis::LimitResult;

namespace {

// Both solvers, and both multipliers, agree with `value`.
void check_multiplier(const std::string& scene, double value, double tolerance, const Vec3& direction = Vec3::UnitX()) {
  const LimitResult r = limit_of(scene, direction);
  INFO(r.method << ": " << r.associated.lower << " .. " << r.associated.upper);
  CHECK(r.stands);
  CHECK(r.associated.converged);
  CHECK(r.associated.lower == Approx(value).epsilon(tolerance));
  CHECK(r.associated.upper == Approx(value).epsilon(tolerance));
}

}  // namespace

TEST_CASE("a block slides or topples, whichever comes first (V37)", "[limit]") {
  check_multiplier(single_block("{ 1, 1, 3 }", dry(0.7)), 1.0 / 3, 1e-6);
  check_multiplier(single_block("{ 1, 1, 2 }", dry(0.4)), 0.4, 1e-6);
  check_multiplier(single_block("{ 1, 1, 3 }", dry(0.7)), std::sqrt(2.0) / 3, 1e-6, Vec3(1, 1, 0).normalized());
}

TEST_CASE("walls of Ferris and Tin-Loi in both bonds (V42)", "[limit]") {
  const std::string brick = "{ length = 0.4, width = 0.2, height = 0.175 }";
  const LimitResult halves = limit_of(bond_wall(brick, "5", 6, true, 0.65));
  CHECK(halves.associated.middle() == Approx(0.64286).epsilon(2e-5));
  WARN(halves.nonassociated.lower << " " << halves.nonassociated.upper << " rounds " << halves.rounds << " excess "
                                  << halves.friction_excess);
}
