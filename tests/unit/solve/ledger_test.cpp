// The energy ledger is useful only if a wrong term shows. Each term is falsified in turn, and the energy tolerance must be exceeded.
#include <catch2/catch.hpp>
#include <string>

#include "engine/solve/energy.h"
#include "tests/support/folder.h"
#include "tests/support/small_wall.h"
#include "tests/unit/solve/scene_run.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

constexpr double tolerance = 1e-2;  // the largest energy tolerance of a run (analysis/verdict.cpp)

const std::string head = R"(
material{ name = "stone", density = 2000, restitution = 0.3, friction = 0.4 }
box{ name = "base", group = "base", size = {2, 2, 0.1}, center = {0, 0, -0.05}, fixed = true }
)";
const std::string plate = R"(box{ name = "block", group = "block", size = {0.4, 0.4, 0.04}, center = {0, 0, 0.02} })";
const std::string dry = R"( joint{ law = dry{ kn = 1e9, mu = 0.4 } })";

struct Term {
  const char* name;
  double Energy::*member;
  std::string scene;
};

const Term terms[] = {
    {"friction", &Energy::friction, head + plate + dry + "ground_motion{ wave = 8, direction = 'x' } analysis{ duration = 0.1 }"},
    {"base_work", &Energy::base_work, head + plate + dry + "ground_motion{ wave = 8, direction = 'x' } analysis{ duration = 0.1 }"},
    {"external_work", &Energy::external_work,
     head + plate + dry +
         "force{ block = 'block', wave = pulse{ amplitude = 80, start = 0.01, duration = 0.2 } } analysis{ duration = 0.1 }"},
    {"motion's work", &Energy::external_work,
     head + plate +
         " joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1e8, c = 1e8, mu = 0.6 } }"
         "motion{ block = 'block', wave = table_wave{ times = {0, 0.1}, values = {0, 1e-3} } } analysis{ duration = 0.1, dt = 1e-5 }"},
    {"turning's work", &Energy::external_work,
     head + plate +
         " joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1e8, c = 1e8, mu = 0.6 } }"
         "turning{ block = 'block', axis = {1, 2, 3}, wave = table_wave{ times = {0, 0.1}, values = {0, 1e-3} } } analysis{ duration = "
         "0.1, dt = 1e-5 }"},
    {"tilt_work", &Energy::tilt_work,
     head + plate + dry + "tilt{ axis = 'y', wave = table_wave{ times = {0, 0.2}, values = {0, 0.8} } } analysis{ duration = 0.2 }"},
    {"fracture", &Energy::fracture,
     head + plate +
         " joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1e4, c = 1e4, mu = 0.6, Gf1 = 5 } } gravity(0)"
         "motion{ block = 'block', direction = 'z', wave = table_wave{ times = {0, 0.1}, values = {0, 5e-4} } } analysis{ duration = 0.1, "
         "dt = 1e-5 }"},
    {"crushing", &Energy::crushing,
     head + plate +
         " joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1e4, c = 1e4, mu = 0.6, fc = 1e5 } }"
         "motion{ block = 'block', direction = 'z', wave = table_wave{ times = {0, 0.1}, values = {0, -5e-4} } } analysis{ duration = 0.1, "
         "dt = 1e-5 }"},
    {"damping", &Energy::damping,
     head + "box{ name = 'block', size = {1, 1, 1}, center = {0, 0, 9}, free = true } damping{ mass = 2, scope = 'all' } analysis{ "
            "duration = 0.3, dt = 1e-3 }"},
    {"contact_damping", &Energy::contact_damping,
     head + "box{ name = 'block', size = {0.4, 0.4, 0.04}, center = {0, 0, 0.03}, free = true } analysis{ duration = 0.1, dt_fraction = "
            "0.05 }"},
};

Energy energy_of(const Term& term, double share) {
  Script script(Script::Options{.quiet = true});
  const Scene scene = script.load_text(term.scene, "ledger.lua", {});
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  Solver solver(run.model, run.state, run.range, 1);
  // Every settlement reduces the growth of the term by (1 - share), as a law would that books too little.
  double kept = 0;
  const auto spoil = [&] {
    double& now = run.state.energy.*term.member;
    now = kept = kept + share * (now - kept);
  };
  while (run.state.time.t < scene.analysis.duration && !solver.broken()) {
    solver.advance({.next = 0});
    spoil();
  }
  return run.state.energy;
}

}  // namespace

TEST_CASE("the gate fails as soon as one term of the ledger books a tenth too little", "[solve][ledger]") {
  for (const Term& term : terms) {
    INFO(term.name);
    const Energy sound = energy_of(term, 1), spoiled = energy_of(term, 0.9);
    CHECK(std::abs(sound.*term.member) > 0);
    CHECK(sound.residual_worst < tolerance);
    CHECK(spoiled.residual_worst > tolerance);
  }
}

TEST_CASE("without gravity the measure of the ledger is the motion of the driven blocks, also if they only turn", "[solve][ledger]") {
  const std::string scene = head + plate + "box{ name = 'top', size = {.4, .4, .2}, center = {0, 0, .14} } gravity(0)" +
                            " joint{ law = mortar{ kn = 1e9, ks = 4e8, ft = 1e8, c = 1e8, mu = 0.6 } } analysis{ duration = .1 }";
  const auto reference = [&](const std::string& motion) {
    Script script(Script::Options{.quiet = true});
    const Scene loaded = script.load_text(scene + motion, "driven.lua", {});
    Prepared run = prepare(loaded, false);
    const Solver solver(run.model, run.state, run.range, 1);
    return run.state.energy.reference;
  };
  const double mass = 2000 * .4 * .4 * .2, arm = .12, speed = .03, spin = .2;
  CHECK(reference("motion{ block = 'block', wave = function(t) return .03 * t end }") == Approx(mass / 2 * speed * speed).epsilon(1e-3));
  CHECK(reference("turning{ block = 'block', axis = 'y', wave = function(t) return .2 * t end }") ==
        Approx(mass / 2 * spin * spin * arm * arm).epsilon(1e-3));
}

TEST_CASE("the gate fails when a tenth of what is stored is lost, or anything appears in reset", "[solve][ledger]") {
  // A wall in full swing under its pulse: kinetic and elastic energy, potential energy and work of the ground.
  const Scene scene = test::small_wall("ground_motion{wave=pulse{amplitude=0.5, duration=0.02}, direction='y'} analysis{duration=0.05}");
  Prepared run;
  test::run_to(scene, 1, 0.012, run);
  const Energy sound = run.state.energy;
  CHECK(sound.residual_worst < 1e-6);
  for (double Energy::*member : {&Energy::kinetic, &Energy::elastic, &Energy::gravity, &Energy::base_work}) {
    Energy spoiled = sound;
    spoiled.*member *= 0.9;
    settle(spoiled, 0, run.state.time.t, -1);
    CHECK(spoiled.residual_relative > 1e-6);
  }
  Energy spoiled = sound;
  spoiled.reset += 0.1 * sound.kinetic;
  settle(spoiled, 0, run.state.time.t, -1);
  CHECK(spoiled.residual_relative > 1e-6);
}

// The weight of the block passes through the centre of the base, about which its moment is round-off.
TEST_CASE("momentum is conserved to round-off, however the scene lies in space", "[solve][ledger]") {
  for (const char* rotation : {"{0, 0, 0}", "{.7, -.4, .3}", "{3, 0, 0}", "{.1, 2, -1}"}) {
    INFO(rotation);
    const test::Folder folder;
    const std::string gravity = R"(
      local angle = math.sqrt(r[1] ^ 2 + r[2] ^ 2 + r[3] ^ 2)
      local k, s, versine = { r[1] / angle, r[2] / angle, r[3] / angle }, math.sin(angle), 1 - math.cos(angle)
      if angle > 0 then
        gravity { -g * (k[2] * s + k[1] * k[3] * versine), g * (k[1] * s - k[2] * k[3] * versine), g * ((1 - k[3] ^ 2) * versine - 1) }
      end
    )";
    const std::string scene = "local r = " + std::string(rotation) + gravity + "transform { rotation = r, function() " + head + plate +
                              " end } " + dry + " analysis { duration = 0.05 }";
    const Metrics m = test::dynamic_run(scene, folder.file("run"), Existing::refuse);
    CHECK(m.momentum_residual < 1e-12);
  }
}

// The third order of the expansion of intact joints, times the force of a joint, is more than a millionth of what little moves here.
TEST_CASE("the ledger of an elastic pier under a large load closes, however little it sways", "[solve][ledger]") {
  for (const char* amplitude : {".001", ".01", ".1"}) {
    INFO(amplitude);
    const test::Folder folder;
    const std::string scene = R"(
      material { name = "brick", density = 1800 }
      ground { size = 10 }
      for i = 0, 29 do box { name = "b" .. i, size = { .5, .25, .1 }, at = { 0, 0, i * .1 }, material = "brick" } end
      joint { law = mortar { kn = 1e10, ft = 10 * MPa, c = 20 * MPa, mu = .7 } }
      force { block = "b29", wave = .5 * MPa * .5 * .25, direction = "-z" }
      analysis { duration = .6 }
      ground_motion { direction = "y", wave = sine { frequency = 2 * Hz, amplitude = g * )" +
                              std::string(amplitude) + " } }";
    const Metrics m = test::dynamic_run(scene, folder.file("run"), Existing::refuse);
    CHECK(m.status == "completed");
    CHECK(m.diagnostics.energy_residual < 1e-6);
  }
}

// From zero on: what the first millisecond errs is nothing beside the work that the force will do.
TEST_CASE("a wedge without weight that a force drives in closes its ledger", "[solve][ledger]") {
  const test::Folder folder;
  const std::string scene = R"(
    gravity(0)
    material { name = "s", density = 2000, friction = .3 }
    prism { name = "w", axis = "y", height = .5, polygon = { { 0, -.1 }, { 0, .1 }, { .5, .19 }, { .5, -.19 } } }
    prism { name = "L", axis = "y", height = .5, polygon = { { 0, -.69 }, { .5, -.69 }, { .5, -.19 }, { 0, -.1 } }, fixed = true }
    prism { name = "R", axis = "y", height = .5, polygon = { { .5, .19 }, { .5, .69 }, { 0, .69 }, { 0, .1 } }, fixed = true }
    joint { law = dry { kn = 1e10, mu = .3 } }
    force { block = "w", direction = "-z", wave = table_wave { times = { 0, .2, .4 }, values = { 0, 2e4, 0 } } }
    analysis { duration = .5 }
  )";
  const Metrics m = test::dynamic_run(scene, folder.file("run"), Existing::refuse);
  CHECK(m.status == "completed");
  CHECK(m.diagnostics.energy_residual < 1e-6);
}
