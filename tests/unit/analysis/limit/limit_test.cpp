// Limit analysis against numbers on paper: blocks, walls, arches, wedges (V37 to V45), by both solvers.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/analysis/limit/outcome.h"
#include "engine/base/units.h"
#include "tests/support/places.h"
#include "tests/unit/analysis/limit/limit_scenes.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::test;
using namespace erbs::lua;
using analysis::LimitLoad;
using analysis::LimitOptions;
using analysis::LimitResult;
using analysis::smooth_multiplier, analysis::limit_analysis;
using Solver = analysis::LimitOptions::Solver;

namespace {

// The multipliers of the simplex method to round-off, of the interior point method to its gap.
void check_multiplier(const std::string& scene, double value, double tolerance, const Vec3& direction = Vec3::UnitX()) {
  for (const Solver solver : {Solver::automatic, Solver::interior}) {
    LimitOptions options;
    options.associated_only = true, options.solver = solver;
    const LimitResult r = limit_of(scene, direction, options);
    INFO(r.method << ": " << r.associated.lower << " .. " << r.associated.upper);
    CHECK(r.stands);
    CHECK(r.associated.converged);
    CHECK(r.associated.lower == Approx(value).margin(tolerance));
    CHECK(r.associated.upper == Approx(value).margin(tolerance));
    CHECK(r.associated.lower < r.associated.upper + 2e-5);
  }
}

std::string arch(int voussoirs, double thickness, double embrace, double mu) {
  return "material { name = 'stone', density = 2000 }\n"
         "arch { radius = 10, width = 1, material = 'stone', voussoirs = " +
         std::to_string(voussoirs) + ", thickness = 10 * " + std::to_string(thickness) + ", embrace = " + std::to_string(embrace) +
         " * deg }\n"
         "joint { law = " +
         dry(mu) + " }\n";
}

// The value between `low` and `high` from which on the structure stands.
template <class F>
double least(double low, double high, F&& scene) {
  LimitOptions options;
  options.associated_only = true;
  while (high - low > 2e-6) {
    const double middle = 0.5 * (low + high);
    (limit_of(scene(middle), Vec3::UnitX(), options).stands ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

TEST_CASE("a block slides or topples, whichever comes first (V37)", "[limit]") {
  check_multiplier(single_block("{ 1, 1, 3 }", dry(0.7)), 1.0 / 3, 1e-5);
  check_multiplier(single_block("{ 1, 1, 2 }", dry(0.4)), 0.4, 1e-5);
  // over a corner, out of the planes of symmetry
  check_multiplier(single_block("{ 1, 1.5, 4 }", dry(0.9)), 0.3125, 1e-5, Vec3(0.8, 0.6, 0));
}

TEST_CASE("the least thickness of a semicircular arch (V39)", "[limit]") {
  const std::pair<int, double> paper[]{{10, 0.10701}, {27, 0.10672}};
  for (const auto& [voussoirs, value] : paper)
    CHECK(least(0.1, 0.12, [n = voussoirs](double t) { return arch(n, t, 180, 3); }) == Approx(value).margin(1e-5));
}

TEST_CASE("the horizontal multiplier of arches (V40), and their mechanism", "[limit]") {
  check_multiplier(arch(7, 0.15, 157.5, 3), 0.37361, 2e-5);
  check_multiplier(arch(27, 0.15, 157.5, 3), 0.35385, 2e-5);
  const Model model = limit_model(arch(7, 0.15, 157.5, 3));
  const LimitResult r = analysis::limit_analysis(model, {}, {});
  CHECK(r.nonassociated.lower == Approx(0.37361).margin(2e-5));  // nothing slides
  const analysis::LimitMechanism mechanism = analysis::limit_mechanism(r, model);
  CHECK(mechanism.kind == "4 hinges");
  CHECK(mechanism.moving == 7);
}

TEST_CASE("the least friction of a semicircular arch (V41)", "[limit]") {
  CHECK(least(0.3, 0.4, [](double mu) { return arch(27, 0.15, 180, mu); }) == Approx(0.3511).margin(1e-4));
}

TEST_CASE("walls of Ferris and Tin-Loi in both bonds (V42)", "[limit]") {
  const std::string brick = "{ length = 0.4, width = 0.2, height = 0.175 }";
  check_multiplier(bond_wall(brick, 5, 6, true, 0.65), 0.64286, 1e-5);
  check_multiplier(bond_wall(brick, 5, 6, false, 0.65), 0.65, 1e-5);
  // Frictionless heads, the least non-associated value, carry 0.63997; the associated value bounds all from above.
  for (const Solver solver : {Solver::simplex, Solver::interior}) {
    LimitOptions options;
    options.solver = solver;
    const LimitResult r = limit_of(bond_wall(brick, 5, 6, true, 0.65), Vec3::UnitX(), options);
    CHECK(r.nonassociated.converged);
    CHECK(r.nonassociated.lower > 0.63997 - 1e-4);
    CHECK(r.nonassociated.lower < 0.64286 + 2e-5);
  }
}

TEST_CASE("running-bond walls with and without friction in the heads (V43)", "[limit]") {
  const std::string brick = "{ length = 0.3, width = 0.15, height = 0.1 }";
  check_multiplier(bond_wall(brick, 4, 16, false, 0.6), 0.57950, 1e-5);
  check_multiplier(bond_wall(brick, 4, 16, true, 0.6), 0.56562, 1e-5);
  check_multiplier(bond_wall(brick, 4, 8, true, 0.6), 0.6, 1e-5);
  check_multiplier(bond_wall(brick, 4, 16, false, 0.6, 0), 0.57546, 1e-5);
  check_multiplier(bond_wall(brick, 4, 16, true, 0.6, 0), 0.56087, 1e-5);
}

TEST_CASE("a wall overturns out of its plane at t over H (V44)", "[limit]") {
  const Model model = limit_model(bond_wall("{ length = 0.3, width = 0.15, height = 0.1 }", 4, 8, true, 0.6));
  analysis::LimitLoad load;
  load.direction = Vec3::UnitY();
  const LimitResult r = analysis::limit_analysis(model, load, {});
  CHECK_FALSE(r.problem.plane);
  CHECK(r.associated.lower == Approx(0.15 / 0.8).margin(1e-5));
  CHECK(r.nonassociated.lower == Approx(0.15 / 0.8).margin(2e-5));
  CHECK(analysis::limit_mechanism(r, model).kind == "out-of-plane overturning as one piece");
}

TEST_CASE("a wedge in a groove slides at mu over the sine of its half angle (V45)", "[limit]") {
  const std::string groove = R"(
    local half, d, mu = 30 * deg, 0.2, 0.3
    local s = d * math.tan(half)
    material { name = "stone", density = 2000 }
    joint { law = dry { kn = 1e10, mu = mu } }
    prism { name = "wedge", axis = "x", height = 0.5, at = { -0.25, 0, 0 }, material = "stone",
      polygon = { { -0.2 * s, 0.2 * d }, { 0.2 * s, 0.2 * d }, { s, d }, { -s, d } } }
    for side, name in pairs { [-1] = "left", [1] = "right" } do
      prism { name = name, axis = "x", height = 1.5, at = { -0.75, 0, 0 }, material = "stone", fixed = true,
        polygon = { { 0, -0.5 * d }, { side * 2 * s, -0.5 * d }, { side * 2 * s, 2 * d }, { 0, 0 } } }
    end)";
  LimitOptions options;
  const LimitResult round = limit_of(groove, Vec3::UnitX(), options);
  // Dilatant faces wedge themselves: friction down the faces at the sine a = mu / tan(half) adds to their pressure.
  const double a = 0.3 / std::tan(30 * pi / 180);
  CHECK(round.associated.lower == Approx(0.6 / std::sqrt(1 - a * a)).margin(2e-5));
  CHECK(round.nonassociated.lower == Approx(0.6).margin(2e-3));  // statics of sliding along the groove; dilatancy of 0.01 mu
  const Model model = limit_model(groove);
  const std::vector<analysis::Thrust> thrusts = analysis::thrusts(round, model);
  REQUIRE(thrusts.size() == 2);
  const double weight = model.mass[std::size_t(round.problem.block_of.front())] * 9.81;
  CHECK(thrusts[0].force.z() + thrusts[1].force.z() == Approx(-weight).epsilon(1e-4));  // on the grooves
  // faceted cones bracket the round ones
  options.facets = 8;
  const LimitResult faceted = limit_of(groove, Vec3::UnitX(), options);
  CHECK(faceted.associated.lower <= round.associated.upper + 1e-5);
  CHECK(faceted.associated.upper >= round.associated.lower - 1e-5);
}

TEST_CASE("faceted cones bracket a block that slides askew", "[limit]") {
  const std::string scene = single_block("{ 1, 1, 0.4 }", dry(0.5)) +
                            "box { name = 'pillar', size = { 0.4, 0.4, 0.5 }, at = { 0.1, 0.3, 0.4 }, material = 'stone' }\n";
  const Vec3 askew = Vec3(1, 0.37, 0.1).normalized();
  LimitOptions options;
  options.associated_only = true;
  const LimitResult round = limit_of(scene, askew, options);
  double width = 1;
  for (const int facets : {4, 8, 32}) {
    options.facets = facets;
    const LimitResult r = limit_of(scene, askew, options);
    CHECK(r.associated.lower <= round.associated.upper + 1e-6);
    CHECK(r.associated.upper >= round.associated.lower - 1e-6);
    CHECK(r.associated.upper - r.associated.lower < width + 1e-9);
    width = r.associated.upper - r.associated.lower;
  }
}

TEST_CASE("a bond carries what its strength allows, and --no-tension drops it", "[limit]") {
  // Full tension over the bed about the toe: lambda W h / 2 = W b / 2 + ft b d b / 2
  const std::string scene = single_block("{ 0.5, 1, 2 }", "mortar { E = 1e9, thickness = 10 * mm, ft = 20 * kPa, c = 1 * MPa, mu = 0.6 }");
  const double weight = 2000 * 0.5 * 1 * 2 * 9.81, value = (weight * 0.25 + 20e3 * 0.5 * 0.25) / weight;
  check_multiplier(scene, value, 2e-5);
  LimitOptions options;
  options.no_tension = true;
  CHECK(limit_of(scene, Vec3::UnitX(), options).associated.lower == Approx(0.25).margin(1e-5));
  // cohesion over the bed: lambda W = c A + mu W
  const std::string low = single_block("{ 2, 1, 0.5 }", "mortar { E = 1e9, thickness = 10 * mm, ft = 5 * kPa, c = 4 * kPa, mu = 0.5 }");
  check_multiplier(low, 0.5 + 4e3 * 2 / (2000 * 2 * 0.5 * 9.81), 2e-5);
}

TEST_CASE("a structure that cannot stand is a result, and a load that never fells it is said", "[limit]") {
  const Model arch_model = limit_model(arch(27, 0.1, 180, 3));
  const LimitResult thin = analysis::limit_analysis(arch_model, {}, {});
  CHECK_FALSE(thin.stands);
  CHECK(thin.standing_share == Approx(0).margin(1e-6));
  CHECK(analysis::limit_mechanism(thin, arch_model).kind == "5 hinges");
  CHECK(limit_of(single_block("{ 1, 1, 1 }", dry(0.5)), -Vec3::UnitZ()).unbounded);
  CHECK(limit_of(single_block("{ 1, 1, 1 }", dry(0.5)), Vec3::UnitZ()).associated.lower == Approx(1));  // lifts off
}

TEST_CASE("limit analysis refuses what has no answer", "[limit]") {
  const std::string block = single_block("{ 1, 1, 1 }", dry(0.5));
  CHECK_THROWS_WITH(limit_of(block, Vec3::Zero()), Catch::Contains("no length"));
  CHECK_THROWS_WITH(limit_of(block + "box { name = 'cloud', size = { 1, 1, 1 }, at = { 0, 0, 5 }, material = 'stone', free = true }"),
                    Catch::Contains("cloud") && Catch::Contains("no path of joints"));
  CHECK_THROWS_WITH(limit_of("material { name = 'stone', density = 2000 }\n"
                             "box { name = 'a', size = { 1, 1, 1 }, at = { 0, 0, 0 }, material = 'stone', fixed = true }"),
                    Catch::Contains("fixed or driven"));
}

TEST_CASE("the load of a scene is the one it is pushed by", "[limit]") {
  lua::Script script(lua::Script::Options{.quiet = true});
  const Scene scene = script.load_text(
      single_block("{ 1, 1, 3 }", dry(0.7)) + "analysis { kind = 'pushover', pattern = { { block = 'block', force = { 0, 2000, 0 } } } }",
      "push.lua");
  const Model model = build(scene).model;
  const analysis::LimitLoad load = analysis::limit_load(scene, model);
  REQUIRE(load.pattern.size() == 1);
  // 2000 N lambda * 1.5 m = W * 0.5 m
  CHECK(analysis::limit_analysis(model, load, {}).associated.lower == Approx(2000 * 3 * 9.81 / 3 / 2000).epsilon(1e-5));
}

TEST_CASE("a tilt turns gravity, while forces and bonds stay as they are", "[limit]") {
  // A block .4 by .4 by 1 m, 2000 kg/m3: toppling by the angle a where W (sin a / 2 - .2 cos a) = .2 F for a weight F on top.
  const auto tilted = [](const std::string& load, const std::string& law) {
    lua::Script script(lua::Script::Options{.quiet = true});
    const Scene scene = script.load_text(
        "material { name = 's', density = 2000 }\n"
        "box { name = 'base', material = 's', fixed = true, size = { 6, 4, .3 }, at = { -3, -2, -.3 } }\n"
        "box { name = 'b', material = 's', size = { .4, .4, 1 }, at = { -.2, -.2, 0 } }\n"
        "joint { law = " +
            law + " }\n" + load,
        "tilt.lua");
    const Model model = build(scene).model;
    const LimitResult r = analysis::limit_analysis(model, analysis::limit_load(scene, model), {});
    CHECK(r.associated.converged);
    CHECK(r.nonassociated.middle() == Approx(r.associated.middle()).epsilon(1e-3));
    return r.associated.middle();
  };
  const std::string tilt = "analysis { kind = 'tilt', direction = 'x' }\n", loose = "dry { kn = 1e11, mu = .9 }";
  const double weight = 0.16 * 2000 * 9.81;
  const double loaded = std::atan(0.4) + std::asin(0.4 * 5000 / weight / std::hypot(1, 0.4));
  CHECK(tilted("force { block = 'b', wave = -5000, direction = 'z', point = { 0, 0, 1 } }\n" + tilt, loose) ==
        Approx(std::tan(loaded)).epsilon(2e-4));  // 1.6045
  // 300 N at the top to x: W (.5 sin a - .2 cos a) + 300 = 0
  CHECK(tilted("force { block = 'b', wave = 300, direction = 'x', point = { 0, 0, 1 } }\n" + tilt, loose) ==
        Approx(std::tan(std::atan(0.4) - std::asin(2 * 300 / weight / std::hypot(1, 0.4)))).epsilon(2e-4));
  // 1500 N up: the factor lowers the answer
  CHECK(tilted("force { block = 'b', wave = 1500, direction = 'z', point = { 0, 0, 1 } }\n" + tilt, loose) ==
        Approx(std::tan(std::atan(0.4) - std::asin(0.4 * 1500 / weight / std::hypot(1, 0.4)))).epsilon(2e-4));
  // oblique gravity, and a direction that is not level: the angle between the gravity of the scene and the one at the fall
  CHECK(tilted("gravity { 1, 0, -9.7 }\n" + tilt, loose) == Approx(std::tan(std::atan(0.4) - std::atan(1 / 9.7))).epsilon(2e-4));  // .2851
  CHECK(tilted("analysis { kind = 'tilt', direction = { 1, 0, -.5 } }", loose) == Approx(0.4).epsilon(2e-4));
  // a bond that holds it down until it slides in no case: more than without
  const std::string bond = "mortar { E = 1e10, thickness = .01, ft = 2000, c = 1e6, mu = .7 }";
  CHECK(tilted(tilt, bond) > tilted("analysis { kind = 'pushover', direction = 'x' }", bond));
}

TEST_CASE("an iteration that does not settle says so, and gives no number beyond the associated one", "[limit]") {
  // Piers in which thousands of head joints are about to slide. With four rows a round has no solution.
  for (const char* rows : {"2", "4"}) {
    Script script(quiet());
    const Scene& scene =
        script.load(in_source("/scenes/valens_aqueduct.lua"), {{"bays", "1"}, {"rows", rows}, {"spacing", "1.5"}, {"length", "1.1"}});
    const Model model = build(scene).model;
    LimitOptions options;
    options.no_tension = true;
    const LimitResult r = analysis::limit_analysis(model, analysis::limit_load(scene, model), options);
    INFO(rows << " rows: " << r.nonassociated.lower << " .. " << r.nonassociated.upper << " after " << r.rounds);
    CHECK(r.associated.converged);
    REQUIRE(r.has_nonassociated);
    CHECK(r.nonassociated.upper < 1.01 * r.associated.upper);  // Radenkovic 1961; a round errs by 1e-3 at most
    CHECK(r.nonassociated.lower > 0.9 * r.associated.lower);
    CHECK(std::fabs(r.nonassociated.upper - r.nonassociated.lower) < 2e-3);
    if (std::string(rows) == "2") CHECK(r.nonassociated.converged);
  }
}

TEST_CASE("the multiplier without friction of upright joints is said where statics clamps blocks", "[limit]") {
  const std::string walls =
      "for _, x in ipairs { -1, 1 } do box { size = { 1, 2, 1 }, at = { x, 0, 0 }, fixed = true, material = 'stone' } end\n";
  for (const double mu : {0.3, 0.7}) {
    const Model model = limit_model(single_block("{ 1, 2, 1 }", dry(mu)) + walls);
    LimitLoad load;
    load.direction = Vec3::UnitY();
    const LimitResult clamped = limit_analysis(model, load, {});
    CHECK(clamped.unbounded);  // both walls may press the block as hard as it takes
    const std::optional<double> smooth = smooth_multiplier(model, load, {}, clamped);
    REQUIRE(smooth);
    CHECK(*smooth == Approx(mu).epsilon(1e-4));  // of its weight on the ground
  }
  const Model alone = limit_model(single_block("{ 1, 2, 1 }", dry(0.5)));
  CHECK_FALSE(smooth_multiplier(alone, {}, {}, limit_analysis(alone, {}, {})));
  const Model arch = limit_model("material { name = 'stone', density = 2000 }\njoint { law = " + dry(0.8) +
                                 " }\narch { radius = 1, thickness = .2, width = .3, voussoirs = 9 }");
  CHECK_FALSE(smooth_multiplier(arch, {}, {}, limit_analysis(arch, {}, {})));  // it does not stand without
}

// The piers of a running bond and their buttresses have blocks with many joints, but only four joints move.
TEST_CASE("an arch on buttressed piers has its four hinges named", "[limit]") {
  const Model model = test::limit_model(R"(
    material { name = "brick", density = 2400 }
    ground { z = 0, size = 10, material = "brick" }
    joint { law = dry { kn = 2e10, mu = .7 } }
    arch { radius = 2, thickness = .4, width = .8, voussoirs = 17, at = { 0, 0, 2.4 }, abutments = false, material = "brick" }
    for _, p in ipairs { { "l", -2.65, -2.65, "-x" }, { "r", 1.75, 2.65, "x" } } do
      wall { name = "w" .. p[1], length = .9, height = 2.4, at = { p[2], -.4, 0 }, brick = { length = .9, width = .8, height = .4 }, joint = 0, quiet = true }
      buttress { name = "b" .. p[1], at = { p[3], 0, 0 }, towards = p[4], width = .8, depth = 1.2, top_depth = .5, courses = 6, block = { length = .5, height = .4 }, material = "brick" }
    end
  )");
  CHECK(analysis::limit_mechanism(analysis::limit_analysis(model, {}, {}), model).kind == "4 hinges");
}
