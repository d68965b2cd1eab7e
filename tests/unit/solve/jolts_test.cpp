// Blows that loads are known to give, where no approach foretells them.
#include <catch2/catch.hpp>

#include "tests/support/small_wall.h"

using namespace erbs;

namespace {

// A block at rest on a plate with this load, to `until` (s).
analysis::Prepared on_plate(const std::string& load, double until, const std::string& bed = "") {
  lua::Script script(lua::Script::Options{.quiet = true});
  const std::string blocks =
      "gravity(g) material{ name = 's', density = 2000, kn = 1e10, friction = .5, restitution = 0 } "
      "box{ name = 'plate', size = {1, 1, .2}, at = {-.5, -.5, -.2} } "
      "box{ name = 'block', size = {.3, .3, .3}, at = {-.15, -.15, 0}, free = ";
  const Scene scene =
      script.load_text(blocks + (bed.empty() ? "true } " : "false } ") + bed + load + " analysis{ duration = 1 }", "jolt.lua", {});
  analysis::Prepared out;
  test::run_to(scene, 1, until, out);
  return out;
}

double speed(const analysis::Prepared& run) { return run.state.motion.v[1].z(); }

}  // namespace

TEST_CASE("a plate that starts at once throws a block at no more than its speed, whenever it starts", "[solve][jolts]") {
  for (const double start : {0.01, 0.010013, 0.0101}) {
    const analysis::Prepared run = on_plate(
        fmt::format(
            "motion{{ block = 'plate', direction = 'z', wave = table_wave{{ times = {{0, {}, 1}}, values = {{0, 0, 1}}, hold = true }} }}",
            start),
        start + 0.004);
    CHECK(speed(run) == Approx(1 / (1 - start)).epsilon(0.06));
    CHECK(run.state.energy.residual_worst < 1e-4);
  }
}

TEST_CASE("a leap of a motion ends no run", "[solve][jolts]") {
  for (const char* direction : {"x", "z"}) {
    const analysis::Prepared run =
        on_plate(fmt::format("motion{{ block = 'plate', direction = '{}', wave = table_wave{{ times = {{0, .01}}, "
                             "values = {{0, -2e-4}}, hold = false }} }}",
                             direction),
                 0.015);
    CHECK(run.state.time.step < 20000);
    CHECK(run.state.time.dt > 1e-7);
  }
}

TEST_CASE("a dry bed that the ground leaves within a step keeps the ledger", "[solve][jolts]") {
  for (const double kn : {1e8, 1e9, 1e11}) {
    const analysis::Prepared run = on_plate(
        "motion{ block = 'plate', direction = 'x', wave = 0 } ground_motion{ direction = 'z', wave = pulse{ amplitude = -2*g, start = "
        ".02, duration = .03 } }",
        0.05, fmt::format("joint{{ law = dry{{ kn = {}, mu = .6 }} }} ", kn));
    CHECK(run.state.energy.residual_worst < 1e-4);
  }
}

TEST_CASE("a jolt shortens the step before mortar that it breaks, not where the bond bears it", "[solve][jolts]") {
  const std::string start = "motion{ block = 'plate', direction = 'z', wave = table_wave{ times = {0, .02, 1}, values = {0, 0, .3} } }";
  for (const double ft : {2e4, 1e5, 2e7}) {
    CAPTURE(ft);
    const std::string bed = fmt::format("joint{{ law = mortar{{ kn = 1e10, ft = {}, c = {}, mu = .6 }} }} ", ft, 2 * ft);
    const analysis::Prepared run = on_plate(start, 0.03, bed);
    const bool bears = ft > 1e6;  // .3 m/s sqrt(k m) = 66 kN, .73 MPa
    CHECK((run.state.joints.stage[0] == JointStage::intact) == bears);
    CHECK(run.state.energy.residual_worst < (bears ? 1e-6 : 1e-4));
    if (bears) CHECK(run.state.time.dt == Approx(run.state.time.dt_target));
  }
}
