#include <catch2/catch.hpp>

#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

// Blocks H x B x h on dry joints, each under its own weight and a moment that shifts it off centre by e H.
Scene eccentric(const std::string& shares, const std::string& law) {
  const std::string text = R"(
    H, B, h, rho = 0.3, 0.125, 0.1, 1800
    material{name="brick", density=rho}
    joint{law=)" + law + R"(}
    for i, e in ipairs{)" + shares +
                           R"(} do
      box{name="foot"..i, size={H,B,.1}, at={2*H*i,0,-.1}, material="brick", fixed=true}
      box{name="free"..i, size={H,B,h}, at={2*H*i,0,0}, material="brick"}
      if e > 0 then moment{block="free"..i, wave=rho*g*H*B*h*e*H, direction="y"} end
    end
    analysis{duration=1})";
  Script script(Script::Options{.quiet = true});
  return script.load_text(text, "eccentric.lua");
}

// Eight dry courses with half bricks at the ends of every other course: 0.96 m long, 0.8 m high, 0.12 m thick.
Scene dry_wall(const std::string& more) {
  const std::string text = R"(
    material{name="brick", density=1800}
    joint{law=dry{kn=1e10, mu=0.7}}
    box{name="foot", size={1.5,.3,.1}, at={-.2,-.1,-.1}, material="brick", fixed=true}
    for c = 0, 7 do
      local odd = c % 2
      for i = 0, 3 + odd do
        local half = odd == 1 and (i == 0 or i == 4)
        local x = odd == 1 and math.max(0, i * .24 - .12) or i * .24
        box{name="b"..c.."_"..i, size={half and .12 or .24, .12, .1}, at={x, 0, c*.1}, material="brick"}
      end
    end
    analysis{duration=1}
  )" + more;
  Script script(Script::Options{.quiet = true});
  return script.load_text(text, "dry_wall.lua");
}

double turn(const Prepared& run, const std::string& block) {
  const auto at = std::find(run.model.block_name.begin(), run.model.block_name.end(), block) - run.model.block_name.begin();
  return rotation_vector(run.state.pose.q[std::size_t(at)]).y();
}

Prepared started(Scene scene, const std::string& start, double ramp_time = 0) {
  scene.analysis.start = start;
  scene.analysis.ramp_time = ramp_time;
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  return run;
}

// Largest difference of displacement, relative to the largest displacement.
double difference(const Prepared& a, const Prepared& b) {
  double size = 0, worst = 0;
  for (std::size_t i = 0; i < a.state.pose.u.size(); ++i) {
    size = std::max(size, b.state.pose.u[i].norm());
    worst = std::max(worst, (a.state.pose.u[i] - b.state.pose.u[i]).norm());
  }
  return worst / size;
}

}  // namespace

TEST_CASE("a block under a load off its centre finds its rotation, however far off", "[analysis]") {
  std::string shares = "0.01";
  for (int i = 2; i <= 47; ++i) shares += fmt::format(",{}", i / 100.0);
  const Prepared run = started(eccentric(shares, "dry{kn=1e11, mu=0.6}"), "equilibrium");
  REQUIRE(run.equilibrium.converged);
  CHECK(run.equilibrium.iterations < 30);
  const double H = 0.3, B = 0.125, h = 0.1, kn = 1e11, load = 1800 * standard_g * H * B * h;
  for (int i = 1; i <= 47; ++i) {
    const double e = i / 100.0, a = std::min(H, 3 * (0.5 - e) * H);
    const double expected = e > 1.0 / 6 ? 2 * load / (kn * B * a * a) : load * e * H / (kn * B * H * H * H / 12);
    // The weight shifts by theta h / 2. This changes the moment by a share of 3 h theta / a, and the rotation by twice that.
    CHECK(turn(run, "free" + std::to_string(i)) == Approx(expected).epsilon(6 * h * expected / a + 2e-6 + 1e-8 * H / a));
  }
}

TEST_CASE("a load past the edge of its joint has no equilibrium, and says which block", "[analysis]") {
  const Prepared run = prepare(eccentric("0.1,0.51,0.3", "dry{kn=1e9, mu=0.6}"), false);
  State state = run.state;
  std::vector<double> push(6 * std::size_t(run.model.nblock) + 6, 0.0);
  for (const auto& p : run.model.force_loads)
    for (int i = 0; i < 3; ++i) push[6 * std::size_t(p.block) + 3 + std::size_t(i)] += value(p.wave, 0) * p.direction[i];
  const Equilibrium found = settle(run.model, state, push);
  CHECK_FALSE(found.converged);
  CHECK_THAT(found.why, Catch::Contains("free2"));
  CHECK(found.given_up == 1);
  for (std::size_t b = 0; b < std::size_t(run.model.nblock); ++b) {  // its neighbours have theirs all the same
    CAPTURE(run.model.block_name[b]);
    const bool rests = run.model.block_name[b] == "free1" || run.model.block_name[b] == "free3";
    CHECK((state.pose.u[b] != run.state.pose.u[b]) == rests);
    CHECK(bool(found.found[b]) == rests);
  }
}

TEST_CASE("eccentric loads by Newton and by a damped ramp give the same rotation", "[analysis]") {
  const Scene scene = eccentric("0.05,0.2,0.3,0.4", "dry{kn=1e10, mu=0.6}");
  const Prepared direct = started(scene, "equilibrium"), ramped = started(scene, "ramp", 1);
  REQUIRE(direct.equilibrium.converged);
  for (int i = 1; i <= 4; ++i)
    CHECK(turn(direct, "free" + std::to_string(i)) == Approx(turn(ramped, "free" + std::to_string(i))).epsilon(2e-3));
}

TEST_CASE("a leaning dry wall comes to rest on its opened joints as the damped ramp does", "[analysis]") {
  // Out of its plane the wall would overturn at 0.12 / 0.8 = 0.15. In its plane, its stepped corner fails first.
  for (const char* down : {"{0,.1*g,-g}", "{0,-.13*g,-g}", "{.1*g,0,-g}", "{-.05*g,.1*g,-g}"}) {
    CAPTURE(down);
    const Scene scene = dry_wall("gravity" + std::string(down));
    const Prepared direct = started(scene, "equilibrium");
    CHECK(direct.equilibrium.why == "");
    CAPTURE(direct.equilibrium.iterations);
    REQUIRE(direct.equilibrium.converged);
    CHECK(difference(direct, started(scene, "ramp", 1)) < 0.03);  // sticking of joints depends on the path
  }
}

TEST_CASE("a mortared wall cracked by an eccentric load is found, and near what the damped ramp finds", "[analysis]") {
  const Scene scene = test::small_wall(
      "for i=0,3 do force{block='b5_'..i, wave=2000, direction={0,0,-1}, point={i*.26+.2,.1,.65}} end analysis{duration=1}");
  const Prepared direct = started(scene, "equilibrium");
  REQUIRE(direct.equilibrium.converged);
  CHECK(std::any_of(direct.state.joints.stage.begin(), direct.state.joints.stage.end(),
                    [](JointStage t) { return t == JointStage::cracked; }));
  // Cracks and slips depend on the path: one step to the full load breaks other joints than a growing load. Ramps of 0.5 to 4 s all end
  // 0.028 from here.
  CHECK(difference(direct, started(scene, "ramp", 0.5)) < 0.04);
}

namespace {

Scene brick_scene(const std::string& text) {
  Script script(Script::Options{.quiet = true});
  return script.load_text("material{name='brick', density=1800}\n" + text + "\nanalysis{duration=1}", "scene.lua");
}

// Equilibrium under gravity alone, from the initial state.
struct Settled {
  Prepared run;
  Equilibrium found;
};
Settled settled(const Scene& scene, Linear how) {
  Settled out{prepare(scene, false), {}};
  out.found = settle(out.run.model, out.run.state, std::vector<double>(6 * std::size_t(out.run.model.nblock) + 6, 0.0), how);
  return out;
}

}  // namespace

TEST_CASE("equilibrium by iterations is that by factors", "[analysis]") {
  const std::string mortar = "joint{law=mortar{E=1e9, thickness=10*mm, ft=1*MPa, c=2*MPa, mu=0.6}, thickness=10*mm, tolerance=0.1*mm}";
  const std::string wall =
      "wall{length=3, courses=14, brick={length=.24,width=.12,height=.09}, joint=10*mm, base={thickness=.1,margin=.1}, quiet=true}";
  const Scene scenes[] = {
      // Four cases: a wall leaning out of its plane, its softest direction; an arch; a tall leaning mast; bricks beside a block on a joint
      // a hundred thousand times softer.
      brick_scene(mortar + wall + "gravity{0,.05*g,-g}"),
      brick_scene("joint{law=mortar{E=1e9, thickness=10*mm, ft=5*MPa, c=9*MPa, mu=0.6}}"
                  "arch{radius=5, thickness=.8, width=1, voussoirs=41, material='brick'}"),
      brick_scene("joint{law=mortar{E=1e9, thickness=10*mm, ft=50*MPa, c=90*MPa, mu=0.6}, thickness=10*mm, tolerance=0.1*mm}"
                  "box{name='foot', size={1,1,.1}, at={-.3,-.3,-.11}, material='brick', fixed=true}"
                  "for i=0,119 do box{name='m'..i, size={.4,.3,.1}, at={0,0,i*.11}, material='brick'} end gravity{.02*g,.01*g,-g}"),
      brick_scene(mortar +
                  "joint{between={'soft','wall'}, law=mortar{kn=1e6, ks=4e5, thickness=10*mm, ft=1*MPa, c=1*MPa, mu=0.6}, "
                  "thickness=10*mm, tolerance=0.1*mm}" +
                  wall + "box{name='loose', group='soft', size={.2,.12,.1}, at={.03,0,14*.1+.01}, material='brick'}")};
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    const Settled direct = settled(scenes[i], Linear::direct), iterated = settled(scenes[i], Linear::iterative);
    REQUIRE(direct.found.converged);
    REQUIRE(iterated.found.converged);
    CHECK(iterated.found.unbalanced <= std::max(1e-11, 2 * direct.found.unbalanced));
    CHECK(difference(iterated.run, direct.run) < 1e-9);
  }
}

TEST_CASE("joints that open and slide come to the same rest by iterations and by factors", "[analysis]") {
  const Scene scene = dry_wall("gravity{0,.1*g,-g}");
  const Settled direct = settled(scene, Linear::direct), iterated = settled(scene, Linear::iterative);
  REQUIRE(direct.found.converged);
  REQUIRE(iterated.found.converged);
  // Both residuals are within 1e-11. A joint open on most of its face is some 1e4 times softer than an intact one.
  CHECK(difference(iterated.run, direct.run) < 1e-6);
}

TEST_CASE("without equilibrium iterations say what factors say", "[analysis]") {
  const Scene falls = brick_scene(
      "joint{law=dry{kn=1e9, mu=0.6}} box{name='foot', size={.3,.1,.1}, at={0,0,-.1}, material='brick', fixed=true}"
      "box{name='over', size={.7,.1,.1}, at={0,0,0}, material='brick'}");
  const Settled direct = settled(falls, Linear::direct), iterated = settled(falls, Linear::iterative);
  CHECK_FALSE(direct.found.converged);
  CHECK_FALSE(iterated.found.converged);
  CHECK_THAT(iterated.found.why, Catch::Contains("block over"));
  CHECK_THAT(direct.found.why, Catch::Contains("block over"));
  CHECK(iterated.run.state.pose.u[1] == Vec3::Zero());
}

namespace {

// Stacks of five plates, each on its own slope at a share of the friction limit, inclined towards `way` (deg).
Scene slopes(const std::string& shares, double way) {
  return brick_scene(fmt::format(R"(
    local way = {} * math.pi / 180
    for i, share in ipairs{{{}}} do
      local slope, id = math.atan(share * .6), 's' .. i
      transform{{ rotation = {{ math.sin(way) * slope, math.cos(way) * slope, 0 }}, at = {{ 2 * i, 0, 0 }}, function()
        box{{ name=id..'_base', group=id, size={{.6,.4,.1}}, at={{-.1,-.1,-.1}}, material='brick', fixed=true }}
        for c = 0, 4 do box{{ name=id..'_'..c, group=id, size={{.4,.2,.05}}, at={{0,0,c*.05}}, material='brick' }} end
      end }}
      joint{{ between={{id,id}}, law=dry{{ kn=1e10, mu=.6 }} }}
    end)",
                                 way, shares));
}

}  // namespace

TEST_CASE("a step that friction turns against the residual is braked, not halved to nothing", "[analysis]") {
  for (const double way : {0., 30., 45., 60., 90., 180., 270.}) {
    CAPTURE(way);
    const Settled stack = settled(slopes("0.985", way), Linear::direct);
    CHECK(stack.found.why == "");
    CHECK(stack.found.converged);
  }
}

TEST_CASE("of many stacks only the one past its friction limit is not at rest, and the others keep their equilibrium to the bit",
          "[analysis]") {
  const Scene scene = slopes("0.985,0.985,1.02,0.985,0.985,0.985", 90);
  const Settled direct = settled(scene, Linear::by_size);
  const Prepared run = started(scene, "equilibrium");
  CHECK(direct.found.given_up == 1);
  CHECK(run.fallers.size() == 5);
  for (const int b : run.fallers) CHECK_THAT(run.model.block_name[std::size_t(b)], Catch::StartsWith("s3_"));
  CHECK(falling_share(run) == Approx(1.0 / 6));
  for (std::size_t b = 0; b < run.model.block_name.size(); ++b) {
    if (run.model.block_name[b].starts_with("s3_")) continue;
    CHECK(run.state.pose.u[b] == direct.run.state.pose.u[b]);
    CHECK(run.state.pose.q[b].coeffs() == direct.run.state.pose.q[b].coeffs());
  }
  for (int j = 0; j < run.model.njoint; ++j) {
    const Joint& joint = run.model.joint[std::size_t(j)];
    if (run.model.joint_name(j).starts_with("s3_")) continue;
    CHECK(run.state.joints.stage[std::size_t(j)] == direct.run.state.joints.stage[std::size_t(j)]);
    for (int i = joint.first_point; i < joint.first_point + joint.type->points; ++i)
      CHECK(run.state.joints.history[std::size_t(i)].slip_s == direct.run.state.joints.history[std::size_t(i)].slip_s);
  }
}

TEST_CASE("what no ramp brings to rest is told, what it does is not", "[analysis]") {
  const Prepared falls = started(brick_scene("joint{law=dry{kn=1e9, mu=0.6}}"
                                             "box{name='foot', size={.3,.1,.1}, at={0,0,-.1}, material='brick', fixed=true}"
                                             "box{name='over', size={.7,.1,.1}, at={0,0,0}, material='brick'}"
                                             "box{name='other', size={.3,.1,.1}, at={0,3,-.1}, material='brick', fixed=true}"
                                             "box{name='fine', size={.3,.1,.1}, at={0,3,0}, material='brick'}"),
                                 "ramp");
  REQUIRE(falls.fallers.size() == 1);
  CHECK(falls.model.block_name[std::size_t(falls.fallers[0])] == "over");
  CHECK(started(eccentric("0.05,0.2,0.3,0.4", "dry{kn=1e10, mu=0.6}"), "ramp").fallers.empty());
}
