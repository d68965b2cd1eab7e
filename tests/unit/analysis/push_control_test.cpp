// Pushes by a loading machine, which controls the displacement of a point: friction, what the machine does not hold, and behind a peak.
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "engine/base/units.h"
#include "tests/unit/analysis/push.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;
using test::push, test::PushOutcome, test::stone;

// A pier of half the width of its height is held by the machine; a slender one beside it falls first.
TEST_CASE("what the machine does not hold falls at the capacity all the same", "[push]") {
  for (const double width : {0.2, 0.3}) {
    const std::string text = stone + "box{ name = 'stocky', size = {.5, .5, 1}, at = {-1, 0, 0} }" +
                             fmt::format("box{{ name = 'slender', size = {{ {}, .5, 1 }}, at = {{1, 0, 0}} }}", width) +
                             "joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .7 } } analysis{ kind = 'pushover', limit = 'never', "
                             "monitor = { block = 'stocky' }, ";
    CAPTURE(width);
    const test::Scratch by_load("push_by_load"), by_machine("push_by_machine");
    const PushOutcome load = push(text + "}", by_load.path),
                      machine = push(text + "control = 'displacement', displacement = 1*mm }", by_machine.path);
    const Capacity &a = *load.metrics.capacity, &b = *machine.metrics.capacity;
    REQUIRE(machine.metrics.status == "completed");
    // The toe of the slender pier is pressed in: scenes/verify/v49_push_block.lua has the formula.
    const double k = std::sqrt(2 * 2000 * width * 0.5 * standard_g / (1e10 * 0.5));
    CHECK(a.peak.multiplier == Approx(width - 3 * std::pow(k / 3, 2. / 3)).epsilon(0.003));
    CHECK(b.peak.multiplier == Approx(a.peak.multiplier).epsilon(0.004));  // two brackets
    REQUIRE(b.above);
    CHECK(*b.above > b.peak.multiplier);
    CHECK(*b.above < 1.0021 * b.peak.multiplier);
    CHECK(b.peak.most < 0.05);
    CHECK(b.mechanism == a.mechanism);
    CHECK(machine.metrics.collapse.collapsed);
  }
}

// The cohesion c of the bed falls over a slip of 2 Gf2 / c: multiplier = mu + c (1 - slip / slip_ultimate) / pressure.
TEST_CASE("control by displacement follows a bed that softens faster than its machine is stiff at first", "[push]") {
  const double Gf2 = GENERATE(50.0, 100.0, 200.0, 2000.0), thickness = GENERATE(0.1, 0.2), c = 0.02e6, mu = 0.6;
  const test::Scratch dir("push_soft");
  const auto outcome = push(stone + fmt::format("box{{ name = 'b', size = {{.9, .9, {}}}, at = {{-.45, -.45, 0}} }}"
                                                "joint{{ law = mortar{{ kn = 1e11, ks = 4e10, mu = {}, ft = .03*MPa, c = {}, Gf1 = {}, "
                                                "Gf2 = {} }} }} analysis{{ kind = 'pushover', limit = 'never', control = 'displacement', "
                                                "displacement = 20*mm }}",
                                                thickness, mu, c, Gf2 / 4, Gf2),
                            dir.path);
  CAPTURE(Gf2, thickness);
  REQUIRE(outcome.metrics.status == "completed");
  CHECK_FALSE(lua::mentions(outcome.warnings, "leaps"));
  const double pressure = 2000 * thickness * standard_g, peak = outcome.metrics.capacity->peak.multiplier;
  std::istringstream curve(outcome.curve);
  std::string line;
  double worst = 0, before = 0, gap = 0, highest = 1;
  while (std::getline(curve, line)) {
    std::istringstream row(line);
    double multiplier = 0, slip = 0;
    char comma = 0;
    if (!(row >> multiplier >> comma >> slip)) continue;
    const double bond = std::max(0.0, 1 - slip * c / (2 * Gf2));
    if (before > highest) worst = std::max(worst, std::fabs(multiplier / (mu + c * bond / pressure) - 1));
    if (multiplier == Approx(peak).epsilon(1e-9)) highest = slip;
    gap = std::max(gap, slip - before), before = slip;
  }
  CHECK(highest < 0.01);
  CHECK(worst < 0.03);  // the bed turns a little
  CHECK(gap < 1e-3);
}

TEST_CASE("a push against gravity passes the load that lifts the weight", "[push]") {
  const test::Scratch dir("push_up");
  const auto outcome = push(stone +
                                "box{ name = 'b', size = {.3, .2, .1}, at = {0, 0, 0} }"
                                "joint{ law = mortar{ kn = 1e10, ks = 4e9, mu = .6, ft = .01*MPa, c = .1*MPa } } "
                                "analysis{ kind = 'pushover', limit = 'never', direction = 'z', step = .25, up_to = 20 }",
                            dir.path);
  CHECK(outcome.metrics.capacity->peak.multiplier == Approx(1 + 0.01e6 / (2000 * 0.1 * standard_g)).epsilon(0.01));
  CHECK(outcome.metrics.capacity->mechanism == "parting");
}

TEST_CASE("control by displacement slides a block at its friction, however stiff its bed and whatever pushes", "[push]") {
  const auto [kn, ks] = GENERATE(std::pair(1e10, 1e9), std::pair(1e8, 1e9), std::pair(1e9, 1e6));
  const std::string pattern = GENERATE("", "pattern = { { block = 'b', force = { 0, 1000, 0 } } }, ");
  const double weight = 2000 * 2 * 2 * 0.1 * standard_g, unit = pattern.empty() ? weight : 1000;
  const test::Scratch dir("push_stiff");
  const auto metrics = push(fmt::format("material{{ name = 'stone', density = 2000, kn = {0}, ks = {0} }}"
                                        "box{{ name = 'floor', size = {{6, 6, .5}}, at = {{-3, -3, -.5}}, fixed = true }}"
                                        "box{{ name = 'b', size = {{2, 2, .1}}, at = {{-1, -1, 0}} }}"
                                        "joint{{ law = dry{{ kn = {0}, ks = {1}, mu = .3 }} }}"
                                        "analysis{{ kind = 'pushover', direction = 'y', limit = 'never', control = 'displacement', {2}"
                                        "displacement = {3} }}",
                                        kn, ks, pattern, 2 * 0.3 * weight / (4 * ks)),
                            dir.path)
                           .metrics;
  CAPTURE(kn, ks, pattern);
  REQUIRE(metrics.status == "completed");
  CHECK(metrics.capacity->peak.multiplier == Approx(0.3 * weight / unit).epsilon(2e-4));
  CHECK(metrics.capacity->past_peak);
}

// What the brittle bond of a corbel sets free within one step, which is stable and far too long for it, would be missing in the ledger.
TEST_CASE("a brittle bond that breaks under a push leaves its energy in the ledger", "[push][energy]") {
  const double kn = GENERATE(1e8, 3.218e8, 3e9), c = GENERATE(400.0, 793.5, 3000.0), mu = 0.318, density = 2550;
  const test::Scratch dir("push_bond");
  const auto metrics =
      push(fmt::format("material{{ name = 'stone', density = {} }}"
                       "box{{ name = 'floor', size = {{3, 3, .5}}, center = {{0, 0, -.25}}, fixed = true }}"
                       "box{{ name = 'b1', size = {{.61, .267, .0822}}, center = {{0, 0, .0411}} }}"
                       "box{{ name = 'b2', size = {{.61, .267, .0822}}, center = {{.0448, 0, .1233}} }}"
                       "joint{{ law = mortar{{ kn = {}, ks = {}, ft = 462, c = {}, mu = {} }} }}"
                       "analysis{{ kind = 'pushover', direction = {{-1, 0, 0}}, limit = 'never', control = 'displacement', "
                       "displacement = 80*mm, monitor = {{ block = 'b2' }} }}",
                       density, kn, 0.4 * kn, c, mu),
           dir.path)
          .metrics;
  CAPTURE(kn, c);
  CHECK(metrics.status == "completed");
  CHECK(metrics.residual_relative < 1e-2);
  const double bond = c / (density * 2 * 0.0822 * standard_g);  // of the lower bed; its points break one after the other
  CHECK(metrics.capacity->peak.multiplier > mu + 0.5 * bond);
  CHECK(metrics.capacity->peak.multiplier < 1.002 * (mu + bond));
}

// A machine as stiff as the way is short would drive waves between the two blocks.
TEST_CASE("control by displacement may push one block and look at another, however short the way", "[push]") {
  const auto [kn, ks] = GENERATE(std::pair(1e10, 1e9), std::pair(1e8, 1e9), std::pair(1e9, 1e6));
  const int on = GENERATE(1, 2), at = GENERATE(1, 2);
  const double share = GENERATE(0.02, 0.3, 3.0);  // of the displacement at which the lower block slides
  const double lower = 2000 * (4 + 1) * 0.1 * standard_g, upper = 2000 * 0.1 * standard_g, slides = 0.3 * (on == 1 ? lower : upper) / 1000;
  const test::Scratch dir("push_remote");
  const auto metrics = push(fmt::format("material{{ name = 'stone', density = 2000, kn = {0}, ks = {0} }}"
                                        "box{{ name = 'floor', size = {{6, 6, .5}}, at = {{-3, -3, -.5}}, fixed = true }}"
                                        "box{{ name = 'b1', size = {{2, 2, .1}}, at = {{-1, -1, 0}} }}"
                                        "box{{ name = 'b2', size = {{1, 1, .1}}, at = {{-.5, -.5, .1}} }}"
                                        "joint{{ law = dry{{ kn = {0}, ks = {1}, mu = .3 }} }}"
                                        "analysis{{ kind = 'pushover', direction = 'y', limit = 'never', control = 'displacement', "
                                        "displacement = {2}, pattern = {{ {{ block = 'b{3}', force = {{ 0, 1000, 0 }} }} }}, "
                                        "monitor = {{ block = 'b{4}' }} }}",
                                        kn, ks, share * 0.3 * lower / (4 * ks), on, at),
                            dir.path)
                           .metrics;
  CAPTURE(kn, ks, on, at, share);
  REQUIRE(metrics.status == "completed");
  const double multiplier = metrics.capacity->peak.multiplier;
  if (share > 1 || (on == 2 && at == 1 && share > 0.2)) {
    CHECK(multiplier == Approx(slides).epsilon(2e-3));  // the bracket, where what slides off is not what is looked at
  } else {
    const double sheared = share * 0.3 * lower / 1000;  // by shear of the beds alone; where they turn as well, less
    CHECK(multiplier < 1.001 * (on == 2 && at == 2 ? sheared / (1 + 4) : sheared));
    CHECK(multiplier > 0.7 * (on == 2 && at == 2 ? sheared / (1 + 4) : sheared));
    CHECK_FALSE(metrics.capacity->above);
  }
}

// The block is a contact from 20 mm on, with dashpots that local damping makes count 1.8 times.
TEST_CASE("a block that has slid out of its bed keeps its friction, whatever damps its way", "[push]") {
  const std::string how = GENERATE("critical", "kinetic", "local", "adaptive");
  const test::Scratch dir("push_slid_out");
  const PushOutcome out = push(
      "material{ name = 'stone', density = 2000, kn = 1e9, ks = 1e9, friction = 1 }"
      "box{ name = 'floor', size = {6, 6, .5}, at = {-3, -3, -.5}, fixed = true }"
      "box{ name = 'b', size = {2, 2, .1}, at = {-1, -1, 0} } joint{ law = dry{ kn = 1e9, ks = 1e5, mu = .3 } }"
      "analysis{ kind = 'pushover', direction = 'y', limit = 'never', control = 'displacement', "
      "displacement = 26*mm, relaxation = '" +
          how + "' }",
      dir.path);
  CAPTURE(how);
  std::istringstream last(out.curve.substr(out.curve.rfind('\n', out.curve.size() - 2) + 1));
  double multiplier = 0;
  last >> multiplier;
  CHECK(multiplier > 0.28);  // where the block overshoots, its springs unload a little
  CHECK(multiplier < 0.3003);
  CHECK(out.metrics.residual_relative < 1e-4);
}

TEST_CASE("control by displacement names the mechanism past the peak, and leaves the state there as it is", "[push]") {
  const auto pushed = [](const char* far) {
    const test::Scratch dir("push_past");
    return push(stone +
                    "box{ name = 'b', size = {.4, .4, 1.2}, at = {-.2, -.2, 0} } joint{ law = dry{ kn = 1e10, ks = 4e9, mu = .7 } } "
                    "analysis{ kind = 'pushover', limit = 'never', control = 'displacement', displacement = " +
                    far + " }",
                dir.path)
        .metrics;
  };
  const Metrics past = pushed("20*mm"), before = pushed(".5*mm");
  CHECK(past.capacity->past_peak);
  CHECK(past.capacity->mechanism == "overturning");
  CHECK_FALSE(past.capacity->above);
  CHECK_FALSE(past.collapse.collapsed);
  CHECK(past.residual_relative < 1e-5);
  CHECK_FALSE(before.capacity->past_peak);
  CHECK(before.capacity->mechanism.empty());
}

TEST_CASE("a push that no machine can control is refused with the remedy", "[push][bad-input]") {
  const std::string block = stone +
                            "box{ name = 'b', size = {.4, .4, 1}, at = {-.2, -.2, 0} } joint{ law = dry{ kn = 1e10, mu = .6 } } "
                            "analysis{ kind = 'pushover', direction = 'x', control = 'displacement', displacement = .01, ";
  for (const auto& [push_by, said] :
       {std::pair{"pattern = { { block = 'b', force = {-1e3, 0, 0} } } }", "against its direction; turn direction"},
        {"pattern = { { block = 'b', force = {0, 1e3, 0} } } }", "in no way along its direction"}}) {
    const test::Scratch dir("push_backwards");
    CHECK_THROWS_WITH(push(block + push_by, dir.path), Catch::Contains(said));
  }
}

TEST_CASE("a push by forces has its curve along their resultant, unless the scene gives a direction", "[push]") {
  const auto pushed = [](const std::string& analyses) {
    const test::Scratch dir("push_resultant");
    return push(stone +
                    "for i = 0, 1 do box{ name = 'b' .. i, group = 'col', size = {.4, .4, .5}, at = {-.2, -.2, .5 * i} } end "
                    "joint{ law = dry{ kn = 1e10, mu = .6 } } " +
                    analyses + " analysis{ limit = 'never', step = .05, up_to = .1 }",
                dir.path)
        .metrics.capacity->peak;
  };
  const std::string forces = "pattern = { { group = 'col', force = {0, -3e3, 0} }, { block = 'b1', force = {-4e3, 0, 0} } } }";
  const CurvePoint along = pushed("analysis{ kind = 'pushover', " + forces);
  CHECK(along.base_shear == Approx(500).epsilon(1e-3));
  CHECK(along.displacement > 1e-7);
  CHECK(pushed("analysis{ kind = 'pushover', direction = '-x', " + forces).base_shear == Approx(400).epsilon(1e-3));
  CHECK(pushed("analysis{ kind = 'pushover', direction = '-x' } analysis{ " + forces).base_shear == Approx(400).epsilon(1e-3));
  // The last pattern counts.
  CHECK(pushed("analysis{ kind = 'pushover', " + forces + " analysis{ pattern = { { block = 'b0', force = {0, 0, -2e3} } } }").base_shear ==
        Approx(200).epsilon(1e-3));
}

TEST_CASE("the base shear of a push in any direction is what the push adds, without the weight", "[push]") {
  for (const std::string direction : {"{1, 0, 0}", "{.8, 0, .6}", "{.8, 0, -.6}", "{.6, .8, 0}", "{0, 0, -1}"}) {
    CAPTURE(direction);
    const test::Scratch dir("push_oblique");
    const auto outcome = push(stone +
                                  "box{ name = 'b', size = {.4, .4, 1}, at = {-.2, -.2, 0} } joint{ law = dry{ kn = 1e10, mu = .6 } } "
                                  "analysis{ kind = 'pushover', limit = 'never', step = .05, up_to = .1, direction = " +
                                  direction + " }",
                              dir.path);
    const CurvePoint& at = outcome.metrics.capacity->peak;
    CHECK(at.multiplier == Approx(0.1));
    CHECK(at.base_shear_over_weight == Approx(0.1).epsilon(1e-3));
  }
}

TEST_CASE("a tilt to a side that is not level counts along the level part of it", "[push]") {
  const test::Scratch dir("push_oblique");
  const PushOutcome got = push(stone +
                                   "box{ name = 'b', size = {.4, .4, 1}, at = {-.2, -.2, 0} } joint{ law = dry{ kn = 1e11, mu = .9 } } "
                                   "analysis{ kind = 'tilt', direction = { 1, 0, -.5 }, step = 4*deg, bracket = .01, fall = 0 }",
                               dir.path);
  const Capacity& found = *got.metrics.capacity;
  CHECK((found.peak.multiplier > .97 * .4 && found.peak.multiplier < 1.002 * .4));  // pressed hinges, as in V50
  CHECK(found.peak.base_shear_over_weight == Approx(std::sin(std::atan(found.peak.multiplier))).epsilon(1e-3));
  CHECK(found.limit->dry.lower == Approx(.4).epsilon(1e-3));
}
