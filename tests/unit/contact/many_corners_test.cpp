// Convex bodies with hundreds of corners: the same contact law as for a brick at any number, and a message beyond the bound.
#include <catch2/catch.hpp>

#include "engine/analysis/start/at_rest.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/solve/step.h"
#include "tests/unit/contact/bodies.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;
using namespace erbs::trial;

namespace {

// Corners spread evenly over a ball by the golden angle; `flat` scales its height.
std::vector<Vec3> corners(int n, double radius = 0.2, double flat = 1) {
  std::vector<Vec3> x;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), angle = i * pi * (3 - std::sqrt(5.0));
    x.push_back(radius * Vec3(r * std::cos(angle), r * std::sin(angle), flat * z));
  }
  return x;
}

Polyhedron lifted(const Polyhedron& p, double by) { return translated(p, Vec3(0, 0, by)); }

Polyhedron plate() { return box_polyhedron({-3, -3, -0.5}, {3, 3, 0}); }

// J, largest deviation of the ledger from the bodies' initial energy.
double missing(Bodies& bodies, double until) {
  bodies.step(true);
  const double before = bodies.total();
  double worst = 0;
  while (bodies.t < until) {
    bodies.step();
    worst = std::max(worst, std::abs(bodies.total() - before));
  }
  return worst;
}

}  // namespace

TEST_CASE("the force of a stone of many faces is the derivative of its energy", "[contact][hull]") {
  const int n = GENERATE(60, 120, 250);
  const ContactShape a = contact_shape(hull(corners(n))), b = contact_shape(hull(corners(n, 0.15, 0.7)));
  OverlapRoom room;
  const auto energy = [&](const Vec3& shift, const Vec3& theta) {
    int separating_axis = -1;
    const PairPose pose{rotation(theta).toRotationMatrix(), shift};
    return find_overlap(a, b, pose, separating_axis, room).total > 0 ? overlap_energy(a, b, pose, room) : 0.0;
  };
  const Vec3 shift(0.12, 0.2, 0.16), theta(0.3, -0.2, 0.5);
  int separating_axis = -1;
  const Patch patch = find_overlap(a, b, {rotation(theta).toRotationMatrix(), shift}, separating_axis, room);
  REQUIRE(patch.total > 0);
  const double h = 1e-6;
  Vec3 force;
  for (int i = 0; i < 3; ++i) force[i] = -(energy(shift + h * Vec3::Unit(i), theta) - energy(shift - h * Vec3::Unit(i), theta)) / (2 * h);
  CHECK((patch.force - force).norm() < 1e-5 * force.norm());  // central differences
}

TEST_CASE("a stone of many corners lies, rolls and falls as one of few", "[contact][hull]") {
  const int n = GENERATE(12, 60, 120, 250);
  const double kn = 1e9;
  const Polyhedron stone = hull(corners(n));
  const double mass = 2000 * mass_properties(stone).volume;
  INFO(n << " corners, " << stone.faces.size() << " faces");
  const PairLaw law{kn, 0.4 * kn, 0.6, 0.3};
  SECTION("falls") {
    Bodies bodies({{{lifted(plate(), 0)}, 0}, {{lifted(stone, 0.4)}, 2000, Vec3(0, 0, -2)}}, {kn, 0.4 * kn, 0, 1}, 2e-5);
    bodies.gravity = Vec3(0, 0, -9.81);
    CHECK(missing(bodies, 0.3) < 1e-3 * mass * (9.81 * 0.4 + 2));
    CHECK(bodies.block[1].u.z() > -0.2);
  }
  SECTION("rolls") {
    Bodies bodies({{{plate()}, 0}, {{lifted(stone, 0.201)}, 2000, Vec3(0.5, 0, 0), Vec3(0, 2.5, 0)}}, law, 4e-5);
    bodies.gravity = Vec3(0, 0, -9.81);
    CHECK(missing(bodies, 1) < 1e-2 * mass * 0.25);
    CHECK(bodies.block[1].u.x() > 0.01);
  }
  SECTION("lies") {
    const Plane face = face_plane(stone, 0);
    const Polyhedron lying = transformed(stone, Quat::FromTwoVectors(face.n, -Vec3::UnitZ()), Vec3(0, 0, face.d + 1e-4));
    Bodies bodies({{{plate()}, 0}, {{lying}, 2000}}, law, 4e-5);
    bodies.gravity = Vec3(0, 0, -9.81);
    bodies.run(1);
    const Vec3 before = bodies.block[1].u;
    bodies.run(2);
    CHECK((bodies.block[1].u - before).norm() < 2e-4);                                         // it rocks on a facet of 20 mm for long
    const double pressure = mass * 9.81 / (0.5 * 4 * pi * 0.04 / double(stone.faces.size()));  // on half a face of mean size
    CHECK(bodies.max_depth < 2 * pressure / kn);
  }
}

TEST_CASE("a heap of stones of many corners is the same for any number of threads", "[contact][hull]") {
  const auto after = [](int threads) {
    Script script(quiet());
    const Scene scene = script.load_text(R"(
      material{ name = "stone", density = 2000, kn = 1e8, ks = 4e7, friction = 0.6, restitution = 0.2 }
      ground{ material = "stone" }
      gravity(g)
      for k = 1, 5 do
        local n, v = 30 * k + 70, {}
        for i = 1, n do
          local z, angle = 1 - (2 * i - 1) / n, i * 2.399963
          local r = math.sqrt(1 - z * z)
          v[i] = { .2 * r * math.cos(angle), .15 * r * math.sin(angle), .12 * z }
        end
        block{ name = "s" .. k, vertices = v, at = { .05 * (k % 2), .04 * (k % 3), .13 + .26 * (k - 1) }, free = true, material = "stone" }
      end
      analysis{ duration = .3, start = "rest" }
    )",
                                         "stones.lua");
    Prepared run = prepare(scene, false);
    start_at_rest(scene, run, threads);
    Solver solver(run.model, run.state, run.range, threads);
    solver.advance_until([&] { return run.state.time.t >= 0.3; });
    CHECK(run.state.observed.max_penetration_relative < 0.05);
    return state_hash(run.state);
  };
  const std::string one = after(1);
  CHECK(one == after(2));
  CHECK(one == after(3));
}

TEST_CASE("a stone past the bound is refused with its name, its line and the bound", "[contact][hull]") {
  const auto mistake_of = [](int n) -> std::string {
    Script script(quiet());
    try {
      prepare(script.load_text(fmt::format(R"(
        material{{ name = "stone", density = 2000 }}
        ground{{}}
        local v = {{}}
        for i = 1, {0} do
          local z = 1 - (2 * i - 1) / {0}
          local r = math.sqrt(1 - z * z)
          v[i] = {{ r * math.cos(2.399963 * i), r * math.sin(2.399963 * i), z + 2 }}
        end
        block{{ name = "boulder", vertices = v, free = true, material = "stone" }}
        analysis{{ duration = 1 }})",
                                           n),
                               "stones.lua"),
              false);
    } catch (const Errors& errors) { return errors.messages.at(0); }
    return "";
  };
  CHECK(mistake_of(256) == "");
  const std::string message = mistake_of(257);
  CHECK(contains(message, "stones.lua:10: block 'boulder'"));
  CHECK(contains(message, "257 corners"));
  CHECK(contains(message, "up to 256"));
}
