// Time step with contacts: longer than joints allow once the joints are gone, and never longer than a step given by the scene.
#include <catch2/catch.hpp>

#include "engine/analysis/dynamic.h"
#include "engine/contact/overlap/shape.h"
#include "tests/support/small_wall.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

// A brick joined to another by mortar of 1e12 Pa/m leaps off and comes to rest on the ground beside it. Contacts have 2e10 Pa/m.
const std::string leap = R"(
  material{ name = "brick", density = 1800, kn = 2e10, ks = 8e9, friction = 0.6, restitution = 0.4 }
  ground{ size = 20, material = "brick" }
  box{ name = "foot", material = "brick", fixed = true, size = {.3, .125, .1}, center = {0, 0, .05} }
  box{ name = "leaper", material = "brick", size = {.3, .125, .1}, center = {0, 0, .16}, initial = { velocity = {0, 1.5, 1} } }
  joint{ law = mortar{ E = 1e10, nu = .2, thickness = .01, ft = 1e4, c = 1e4, mu = .6 }, thickness = .01 }
  gravity(g)
)";

struct Stepped {
  Prepared run;
  double longest = 0, shortest = 1e9;  // s
};

Stepped stepped(const std::string& script, double until, int threads = 1) {
  Script loaded(Script::Options{.quiet = true});
  const Scene scene = loaded.load_text(script, "leap.lua");
  Stepped r{prepare(scene, false)};
  start_at_rest(scene, r.run, threads);
  Solver solver(r.run.model, r.run.state, r.run.range, threads);
  const State& s = r.run.state;
  solver.advance_until([&] {
    r.longest = std::max(r.longest, s.time.dt);
    r.shortest = std::min(r.shortest, s.time.dt);
    return s.time.t >= until;
  });
  return r;
}

}  // namespace

TEST_CASE("once the stiff joint is gone the step grows to what debris bears", "[solve][step]") {
  const Stepped r = stepped(leap + "analysis{ duration = 9, start = 'rest' }", 1.5);
  const State& s = r.run.state;
  // The longest step is 0.9 sqrt(2 m / (kn A)). A single brick on its face, on ground that does not give way, allows 0.7 of 2 sqrt(m / (kn
  // A)), with a reserve for rocking.
  const double m = 6.75, k = 2e10 * 0.3 * 0.125, most = 0.9 * std::sqrt(2 * m / k);
  CHECK(r.run.range.longest == Approx(most).epsilon(1e-9));
  CHECK(s.time.dt_target < 0.4 * most);
  CHECK(r.longest <= most);
  CHECK(s.time.dt > 2 * s.time.dt_target);
  CHECK(s.time.dt > 0.7 * std::sqrt(2 * m / k));
  CHECK(s.time.dt < 0.7 * 2 * std::sqrt(m / k));
  // The only energy error is one impact of a face on a face: 0.1 to 1.3 %, by its start within a step. Measured for launches at 1 to 1.2
  // m/s and restitutions of 0.2 to 1.
  CHECK(s.energy.residual_worst < 1.5e-2);
  CHECK(s.motion.v[2].norm() < 1e-6);
  CHECK(s.pose.u[2].z() == Approx(-0.0975).margin(1e-6));  // friction stops its foot as it lands, and it tips onto its side
}

// A plate of mass m pressed between the ground and a slab 25 times as heavy, k = kn A on either side: omega^2 = 2 k / m (1 + m / 2 M).
// Twice the stiffness on the plate would allow .71 of that step.
TEST_CASE("a light plate under a heavy slab holds the step by its own frequency", "[solve][step]") {
  const Stepped r = stepped(leap + R"(
    joint{ between = { "loose", "" }, none = true }
    box{ name = "plate", group = "loose", material = "brick", free = true, size = {.3, .3, .02}, at = {2, 0, 0} }
    box{ name = "slab", group = "loose", material = "brick", free = true, size = {.3, .3, .5}, at = {2, 0, .02} }
    analysis{ duration = 9, start = 'rest' })",
                            1.5);
  const double m = 1800 * 0.3 * 0.3 * 0.02, k = 2e10 * 0.3 * 0.3, limit = 2 / std::sqrt(2 * k / m * (1 + 1 / 50.));
  CHECK(r.run.state.time.dt < 0.7 * limit);
  CHECK(r.run.state.time.dt > 0.6 * limit);
  CHECK(r.run.state.energy.residual_worst < 1e-3);
}

TEST_CASE("a step that the scene names is not exceeded, and a share of the limit is kept", "[solve][step]") {
  const Stepped named = stepped(leap + "analysis{ duration = 9, start = 'rest', dt = 2e-6 }", 0.8);
  CHECK(named.longest <= 2e-6);  // the joint that breaks in the first step shortens it
  CHECK(named.longest > 1.8e-6);
  const Stepped fifth = stepped(leap + "analysis{ duration = 9, start = 'rest', dt_fraction = 0.2 }", 1.2);
  const Stepped whole = stepped(leap + "analysis{ duration = 9, start = 'rest' }", 1.2);
  CHECK(fifth.longest == Approx(whole.longest * 0.2 / 0.9).epsilon(0.1));
}

TEST_CASE("the step grows alike with any number of threads", "[solve][step]") {
  const Stepped one = stepped(leap + "analysis{ duration = 9, start = 'rest' }", 0.6),
                two = stepped(leap + "analysis{ duration = 9, start = 'rest' }", 0.6, 2);
  CHECK(one.run.state.time.step == two.run.state.time.step);
  CHECK(one.run.state.pose.u[2] == two.run.state.pose.u[2]);
}

// A cube of side a, I = m a^2 / 6. Across a face: a^2 / m for sinking, and half of that, Int x^2 dA / I, for rocking. Along it: a^2 / m for
// sliding and a^2 (a / 2)^2 / I for the coupled roll, 2.5 a^2 / m together.
TEST_CASE("the stiffest that may land on a cube is a face of its own", "[contact][step]") {
  const double a = 0.2, m = 16;
  const Vec3 half = Vec3::Constant(a / 2);
  ContactShape shape = contact_shape(box_polyhedron(-half, half));
  ContactBlock block;
  block.inverse_mass = 1 / m;
  block.inverse_tensor = 6 / (m * a * a) * Mat3::Identity();
  set_face_omega2(shape, block);
  CHECK(shape.face_across == Approx(a * a / m));
  CHECK(shape.face_along == Approx(2.5 * a * a / m));
  set_face_omega2(shape, ContactBlock{});  // a fixed block
  CHECK(shape.face_across == 0);
}
