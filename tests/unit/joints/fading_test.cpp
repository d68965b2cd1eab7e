// Beds that become softer once their bond is gone: both kernels, threads, resumption, contacts that replace them, and mistakes.
#include <catch2/catch.hpp>

#include "engine/joints/cracked/fading.h"
#include "engine/record/folder/checkpoint.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

const char* soft = "mortar{E=1e9, thickness=10*mm, ft=20*kPa, c=30*kPa, mu=0.6, kn_cracked=1e10}";
const char* strong_shake = "ground_motion{wave=sine{amplitude=2*g, frequency=6}, direction=\"y\"} analysis{duration=1";

int faded(const State& s) {
  return int(std::count_if(s.joints.share.begin(), s.joints.share.end(), [](StiffnessShare share) { return share.n < 0.5; }));
}

}  // namespace

TEST_CASE("faded beds move alike in both kernels", "[joints]") {
  Prepared fast, plain;
  test::run_to(test::small_wall(std::string(strong_shake) + "}", soft), 1, 0.05, fast);
  test::run_to(test::small_wall(std::string(strong_shake) + ", kernel=\"reference\"}", soft), 1, 0.05, plain);
  REQUIRE(faded(fast.state) > 3);
  CHECK(faded(plain.state) == faded(fast.state));
  CHECK(fast.state.energy.crushing > 0);
  CHECK(plain.state.energy.crushing == Approx(fast.state.energy.crushing).epsilon(1e-3));
  double apart = 0, way = 0;
  for (std::size_t b = 0; b < fast.state.pose.u.size(); ++b) {
    apart = std::max(apart, (fast.state.pose.u[b] - plain.state.pose.u[b]).norm());
    way = std::max(way, fast.state.pose.u[b].norm());
  }
  CHECK(apart < 1e-4 * way);
}

TEST_CASE("faded beds keep the ledger, as joints and as the contacts that replace them", "[joints]") {
  const Scene scene = test::small_wall(std::string(strong_shake) + "}", soft);
  Prepared one, three;
  test::run_to(scene, 1, 0.4, one);
  test::run_to(scene, 3, 0.4, three);
  CHECK(state_hash(one.state) == state_hash(three.state));
  REQUIRE(faded(one.state) > 10);
  const State& s = one.state;
  CHECK(s.energy.residual_worst < 1e-4);
  const auto released = std::count(s.joints.stage.begin(), s.joints.stage.end(), JointStage::contact);
  CHECK(released > 0);
  int former = 0;
  for (const ContactPair& pair : s.contacts.list.pair) {
    former += pair.former_joint != 0;
    if (pair.former_joint == 1) CHECK(pair.law.kn >= 1e10 * (1 - 1e-12));
  }
  CHECK(former > 0);
}

TEST_CASE("a bed without kn_cracked does not fade", "[joints]") {
  Prepared run;
  test::run_to(test::small_wall(std::string(strong_shake) + "}"), 1, 0.05, run);
  CHECK(run.state.joints.share.empty());
}

TEST_CASE("a bed fades at the same rate whatever the step", "[joints]") {
  for (const double fraction : {.9, .3, .1, .02}) {
    Script script(Script::Options{.quiet = true});
    const Scene scene = script.load_text(
        "material{ name = 'brick', density = 1800 } box{ name = 'base', size = {1, 1, .2}, at = {0, 0, -.2}, fixed = true }"
        "box{ name = 'b', size = {.3, .3, .3}, at = {.3, .3, .01} }"
        "joint{ law = mortar{ kn = 1e9, ft = 1e3, c = 1e3, mu = .7, kn_cracked = 1e6 }, thickness = .01 }"
        "force{ block = 'b', wave = half_sine{ amplitude = 600, frequency = 50 }, direction = 'z' } analysis{ duration = .1, dt_fraction "
        "= " +
            std::to_string(fraction) + "}",
        "bed.lua", {});
    Prepared early, late;
    test::run_to(scene, 1, 0.02, early);
    test::run_to(scene, 1, 0.035, late);
    const double before = early.state.joints.share.front().n, after = late.state.joints.share.front().n;
    INFO("fraction " << fraction << ": " << before << ", " << after);
    REQUIRE(before < .9);
    CHECK(std::log(before / after) * Fading::fade_time == Approx(late.state.time.t - early.state.time.t).epsilon(.1));
  }
}

TEST_CASE("a block that slides from its bed keeps the ledger while its contact fades", "[joints]") {
  for (const double kn : {1e6, 1e7, 1e9})
    for (const double part : {.5, .1})
      for (const double friction : {.1, .7}) {
        CAPTURE(kn, part, friction);
        Script script(Script::Options{.quiet = true});
        const Scene scene = script.load_text(
            fmt::format("gravity(g) material{{ name = 'stone', density = 2000, kn = 1e10 }} ground{{ size = 10 }}"
                        "box{{ name = 'b', size = {{.3, .2, .3}}, at = {{0, 0, 0}}, initial = {{ velocity = {{1, 0, 0}} }} }}"
                        "joint{{ law = mortar{{ kn = {0}, ks = {1}, ft = 100, c = 100, mu = {3}, kn_cracked = {0} * {2}, ks_cracked = {1} "
                        "* {2} }} }}"
                        "analysis{{ duration = 1 }}",
                        kn, .4 * kn, part, friction),
            "slide.lua", {});
        Prepared run;
        test::run_to(scene, 1, 0.1, run);
        REQUIRE(run.state.joints.stage.front() == JointStage::contact);
        CHECK(run.state.energy.crushing > 0);
        CHECK(run.state.energy.residual_worst < 2e-5);
      }
}
