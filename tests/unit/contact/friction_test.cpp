// Friction of a contact patch: threshold, creep, stop, torsion; energy ledgers of frictional impact and of rocking; release of a joint.
#include <catch2/catch.hpp>
#include <random>

#include "engine/contact/law/frame.h"
#include "engine/contact/law/pair_law.h"
#include "tests/unit/contact/bodies.h"

using namespace erbs;
using namespace erbs::trial;

namespace {

const double contact_stiffness = 1e10;
double small_step(double part = 0.2) { return part * step_unit(contact_stiffness, 1800 * 0.00375, 0.0375); }

// A brick on a wide floor, with gravity inclined by `slope` about y. A rotation of 1e-8 breaks the symmetry.
Bodies on_slope(double slope, double mu, double dt, double direction = 0, double h = 0.1) {
  Body floor{{box_polyhedron({-5, -5, -1}, {5, 5, 0})}, 0};
  const double sink = 1800 * h * 9.81 * std::cos(slope) / contact_stiffness;
  const Polyhedron lying = transformed(brick(0.3, 0.125, h), rotation({1e-8, 2e-8, direction}), {0, 0, h / 2 - sink});
  Bodies two({floor, {{lying}}}, {contact_stiffness, 0.4 * contact_stiffness, mu, 0.3}, dt);
  two.gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope));
  two.want_energy = false;
  return two;
}

}  // namespace

TEST_CASE("the factor of an impact answers for its restitution", "[contact]") {
  const double e[] = {.9375, .7484, .5936, .4107, .1970}, x[] = {.1, .5, 1, 2, 5};
  for (int i = 0; i < 5; ++i) CHECK(impact_factor(e[i]) == Approx(x[i]).epsilon(2e-3));
}

TEST_CASE("the torsion radius is that of Int |x| dA / A", "[contact]") {
  for (double q : {0.01, 0.0625, 0.15}) {
    const double p = 0.15, exact = (std::hypot(p, q) + p * p / (2 * q) * std::asinh(q / p) + q * q / (2 * p) * std::asinh(p / q)) / 3;
    CHECK(scalar::torsion_radius<double>(4 * p * q, std::sqrt((p * p + q * q) / 3)) == Approx(exact).epsilon(4e-3));
  }
}

// V05.
TEST_CASE("a brick slides when the slope exceeds the friction angle", "[contact][verify]") {
  const double mu = 0.6, angle = std::atan(mu);
  for (double direction : {0.0, 0.7}) {
    Bodies below = on_slope(angle - 2e-4, mu, small_step(0.3), direction), above = on_slope(angle + 2e-4, mu, small_step(0.3), direction);
    // Gravity slowly rotates from the vertical, so that the start is no shock.
    for (Bodies* two : {&below, &above}) {
      const Vec3 end = two->gravity;
      while (two->t < 0.6) {
        const double share = std::min(1.0, two->t / 0.2), slope = share * std::atan2(end.x(), -end.z());
        two->gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope));
        two->step(two->t == 0);
      }
    }
    CHECK(below.block[1].u.norm() < 2e-6);
    CHECK(below.block[1].v.norm() < 2e-5);
    const double a = 9.81 * (std::sin(angle + 2e-4) - mu * std::cos(angle + 2e-4));
    CHECK(above.block[1].v.x() == Approx(a * 0.4).epsilon(0.05));
  }
}

// V06, shortened: the criterion is the drift per second.
TEST_CASE("a brick that sticks does not creep", "[contact][verify]") {
  Bodies two = on_slope(0.9 * std::atan(0.6), 0.6, small_step(0.5), 0.3);
  two.run(0.5);
  const Vec3 settled = two.block[1].u;
  two.run(2.0);
  CHECK((two.block[1].u - settled).norm() < 1e-8 * 0.1);
  CHECK(two.block[1].v.norm() < 1e-8);
}

// V07. The brick is thin: a tall brick opens at its heel and chatters on its elastic joint, even in the limit of small steps.
TEST_CASE("a sliding brick stops where it must, in 16 directions", "[contact][verify]") {
  const double mu = 0.6, v0 = 0.5, exact = v0 * v0 / (2 * mu * 9.81);
  double shortest = 1, longest = 0;
  for (int i = 0; i < 16; ++i) {
    const double angle = 2 * M_PI * i / 16;
    Bodies two = on_slope(0, mu, small_step(0.3), 0, 0.03);
    two.block[1].v = v0 * Vec3(std::cos(angle), std::sin(angle), 0);
    two.run(0.12);
    const double travel = std::hypot(two.block[1].u.x(), two.block[1].u.y());
    shortest = std::min(shortest, travel);
    longest = std::max(longest, travel);
    CHECK(std::abs(std::atan2(std::sin(angle) * two.block[1].u.x() - std::cos(angle) * two.block[1].u.y(), travel)) < 1e-3);
    CHECK(two.friction + two.tangential + two.damping == Approx(0.5 * two.mass[1] * v0 * v0).epsilon(2e-3));
  }
  CHECK(shortest == Approx(exact).epsilon(1e-3));
  CHECK(longest == Approx(exact).epsilon(1e-3));
  CHECK(longest - shortest < 1e-3 * exact);
}

TEST_CASE("a spinning brick stops after I w / (mu N r)", "[contact][verify]") {
  const double mu = 0.6, w0 = 5, r = 0.08548;
  Bodies two = on_slope(0, mu, small_step(0.5));
  const double inertia = two.inertia[1](2, 2), stop = inertia * w0 / (mu * two.mass[1] * 9.81 * r);
  two.block[1].w = {0, 0, w0};
  two.spin[1] = {0, 0, inertia * w0};
  double stopped = 0;
  while (two.t < 0.1) {
    two.step(two.t == 0);
    if (two.block[1].w.z() > 0.01 * w0) stopped = two.t;
  }
  CHECK(stopped / 0.99 == Approx(stop).epsilon(0.015));
}

// Pressure is uniform and constant but eccentric; random shaking stays within the limit at times and exceeds it at others.
TEST_CASE("slip of a patch takes energy in every step, wherever its pressure lies", "[contact]") {
  std::mt19937 random(7);
  for (const double off : {0.0, 0.02, 0.3}) {
    const double a = 0.3, b = 0.1;
    Patch patch;
    patch.normal = Vec3::UnitZ();
    patch.area = a * b;
    patch.second = patch.area / 12 * Vec3(a * a, b * b, 0).asDiagonal();
    patch.gyration = std::sqrt((a * a + b * b) / 12);
    patch.pressure_centre = {off, 0.7 * off, 0};
    ContactPair pair;
    pair.law = {contact_stiffness, 0.4 * contact_stiffness, 0.6, 0.3};
    pair.n = patch.normal, pair.area = patch.area, pair.gyration = patch.gyration;
    const double normal = 100, reach = pair.law.mu * normal / (pair.law.ks * patch.area);
    ContactBlock below, above;
    below.inverse_mass = below.inverse_inertia = above.inverse_inertia = 0;
    above.inverse_mass = 1e-3;
    const PairSettings settings = pair_settings(ContactSettings{}, 1e-3);
    double least = 0, sum = 0, stored = 0, work = 0;
    Vec3 force = Vec3::Zero();
    double torsion = 0;
    Vec3 moved = Vec3::Zero(), speed = Vec3::Zero();
    for (int step = 0; step < 20000; ++step) {
      const Vec3 kick = random_vector(random);
      speed = 0.9 * speed + 0.2 * reach * kick;  // slip x, slip y, rotation times the radius of gyration
      moved += speed;
      above.u = {moved.x(), moved.y(), 0};
      above.rotation = Eigen::AngleAxisd(moved.z() / patch.gyration, Vec3::UnitZ()).toRotationMatrix();
      OnePair w{};
      set_lane(w, 0, pair, below, above, 1);
      scalar::gather_pairs<double>(w);
      w.total[0] = w.normal[2][0] = 1, w.area[0] = patch.area, w.gyration[0] = patch.gyration, w.size[0] = normal / contact_stiffness;
      for (int i = 0; i < 3; ++i) w.second[i][0] = patch.second(i, i), w.pressure_centre[i][0] = patch.pressure_centre[i];
      w.linear[0][0] = 1e3 * speed.x(), w.linear[1][0] = 1e3 * speed.y(), w.angular[2][0] = 1e3 * speed.z() / patch.gyration;
      scalar::springs<double>(w, settings);
      scalar::return_map<double>(w);
      const scalar::Springs<double> f = scalar::springs_after<double>(w);
      const Vec3 now(f.force.x, f.force.y, f.force.z);
      work += -0.5 * ((now + force).head<2>().dot(speed.head<2>()) + (f.torsion + torsion) * speed.z() / patch.gyration);
      force = now, torsion = f.torsion;
      scalar::finish<double>(w, settings);
      scalar::write(w.p, pair_rows, &pair.law.kn);
      least = std::min(least, f.slipped);
      sum += f.slipped;
      stored = f.stored;
      const Vec3 whole = now + w.share[0] * Vec3(w.dashpots[0][0], w.dashpots[1][0], w.dashpots[2][0]);
      CHECK(whole.norm() <= pair.law.mu * normal * (1 + 1e-9));
    }
    const double scale = pair.law.mu * normal * reach;
    INFO("off " << off << ": least " << least / scale << " sum " << sum / scale);
    CHECK(least > -1e-9 * scale);
    CHECK(sum > 1000 * scale);
    CHECK(work == Approx(sum + stored).epsilon(1e-3));
  }
}

TEST_CASE("oblique collisions with friction and damping close the ledger and keep momentum", "[contact]") {
  std::mt19937 random(4);
  std::vector<double> errors;
  for (int round = 0; round < 12; ++round) {
    const Vec3 way = random_vector(random).normalized();
    Body a{{transformed(brick(), rotation(random_vector(random)), Vec3::Zero())}}, b;
    b.parts = {transformed(brick(), rotation(random_vector(random)), 0.36 * way)};
    b.v = -3 * way + random_vector(random);
    a.w = 3 * random_vector(random);
    b.w = 3 * random_vector(random);
    Bodies two({a, b}, {contact_stiffness, 0.4 * contact_stiffness, 0.6, 0.5}, small_step());
    two.step(true);
    const double before = two.kinetic;
    const Vec3 momentum = two.momentum(), angular = two.angular_momentum();
    two.run(0.15);
    errors.push_back(std::abs(two.total() / before - 1));
    CHECK((two.momentum() - momentum).norm() < 1e-12 * momentum.norm());
    CHECK((two.angular_momentum() - angular).norm() < 1e-11 * (angular.norm() + 0.3 * momentum.norm()));
    CHECK(two.damping >= -1e-4 * before);
    CHECK(two.friction >= -1e-4 * before);
    INFO(round << ": friction " << two.friction << " damping " << two.damping << " of " << before << " residual " << errors.back());
    CHECK(errors.back() < 1e-3);
  }
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 1e-4);
}

TEST_CASE("rocking with friction closes the ledger", "[contact]") {
  const double alpha = std::atan(0.25), start = 0.5 * alpha;
  Body floor{{box_polyhedron({-5, -5, -1}, {5, 5, 0})}, 0};
  const Vec3 toe(0.125, 0, 0);
  const Quat lean = rotation({0, start, 0});
  Polyhedron block = transformed(box_polyhedron({-0.125, -0.375, 0}, {0.125, 0.375, 1}), lean, toe - lean * toe);
  const double kn = 1e10, dt = 0.2 * step_unit(kn, 1800 * 0.1875, 0.1875);
  Bodies two({floor, {{block}}}, {kn, 0.4 * kn, 0.7, 1}, dt);
  two.gravity = {0, 0, -9.81};
  two.settings.settling = two.settings.settling_tangential = 0;
  two.step(true);
  const double before = two.total(),
               swing = two.mass[1] * 9.81 * 0.5 * std::hypot(0.25, 1) * (std::cos(alpha - start) - std::cos(alpha)) * -1;
  double worst = 0;
  while (two.t < 3) {
    two.step();
    worst = std::max(worst, std::abs(two.total() - before));
  }
  INFO("worst " << worst << " of " << swing << " friction " << two.friction << " damping " << two.damping);
  CHECK(worst < 1e-3 * std::abs(swing) * 20);
  CHECK(two.friction >= -1e-4 * std::abs(swing));
}

// Hard case 3.
TEST_CASE("a loaded contact turned as a whole keeps its force and does no work", "[contact][hard]") {
  Body lower{{box_polyhedron({-0.5, -0.5, -0.2}, {0.5, 0.5, 0})}};
  Body upper{{translated(brick(), {0.05, 0.02, 0.05 - 1e-5})}};
  Bodies two({lower, upper}, {contact_stiffness, 0.4 * contact_stiffness, 0.6, 1}, 1e-4);
  two.settings.settling = two.settings.settling_tangential = 0;
  two.t = 1;
  two.forces();
  two.block[1].u.x() += 2e-6;  // shear below the limit
  two.forces();
  const Vec3 force = two.force[1], moment = two.moment[1];
  const double stored = two.tangential;
  REQUIRE(force.x() < -100);
  const Vec3 centre_a = two.block[0].rest, centre_b = two.block[1].rest + two.block[1].u;
  for (int i = 1; i <= 3600; ++i) {
    const Quat turn = rotation(2 * M_PI * i / 3600 * Vec3(0.3, -0.5, 0.8).normalized());
    two.block[0].rotation = two.block[1].rotation = turn.toRotationMatrix();
    two.block[1].u = turn * (centre_b - centre_a) + centre_a - two.block[1].rest;
    two.list.valid = true;
    two.forces();
    if (i % 400 == 0) {
      CHECK((turn.conjugate() * two.force[1] - force).norm() < 1e-9 * force.norm());
      CHECK((turn.conjugate() * two.moment[1] - moment).norm() < 1e-9 * force.norm());
    }
  }
  CHECK(two.tangential == Approx(stored).epsilon(1e-7));
}

// Hard case 14. A face of .0375 m2 with a pressure of 300 N and a shear of 54 N stores N^2 / (2 kn A) + T^2 / (2 ks A).
TEST_CASE("a contact takes over from a joint without a jump of force or energy", "[contact][hard]") {
  const double area = 0.0375, kn = GENERATE(0.1, 1.0, 10.0) * contact_stiffness, sunk = GENERATE(1e-6, 2e-7, 4e-8);
  CAPTURE(kn, sunk);
  Body lower{{box_polyhedron({-0.5, -0.5, -0.2}, {0.5, 0.5, 0})}, 0};
  Body upper{{translated(brick(), {0.05, 0.02, 0.05 - sunk})}};
  Bodies two({lower, upper}, {kn, 0.4 * kn, 0.6, 0.3}, 1e-5);
  two.list.margin = 0.01;
  two.want_energy = true;
  search(two.list, two.shapes, two.block, std::vector<std::uint8_t>{1, 1}, {}, [&](int, int) { return two.law; });
  const Vec3 force(-50, 20, 300);
  REQUIRE(two.list.pair.size() == 1);
  const auto begin = [&](double stored, double most = 0) {
    Vec6 before;
    before << force, Vec3::Zero();
    return release_to_contact(two.list.pair[0], two.shapes, two.block[0], two.block[1], before, stored, most, two.room);
  };
  const double pressing = 300.0 * 300 / (2 * kn * area), shearing = 2900 / (0.8 * kn * area);
  two.t = 1;
  two.dt = 1e-9;
  SECTION("the joint had the stiffness of the face") {
    CHECK(begin(pressing + shearing) == Approx(pressing + shearing).epsilon(1e-6));
    two.forces();
    CHECK((two.force[1] - force).norm() < 1e-3 * force.norm());
    CHECK(two.elastic == Approx(pressing).epsilon(1e-3));
    CHECK(two.tangential == Approx(shearing).epsilon(1e-3));
  }
  SECTION("ten times that: what is stored is kept, force falls by its root") {
    CHECK(begin(0.1 * (pressing + shearing)) == Approx(0.1 * (pressing + shearing)).epsilon(1e-6));
    two.forces();
    CHECK((two.force[1] - std::sqrt(0.1) * force).norm() < 1e-3 * force.norm());
  }
  SECTION("the same, where so little energy is of no interest: force is kept") {
    CHECK(begin(0.1 * (pressing + shearing), pressing + shearing) == Approx(pressing + shearing).epsilon(1e-3));
    two.forces();
    CHECK((two.force[1] - force).norm() < 1e-3 * force.norm());
  }
  SECTION("it stored nothing: neither does the contact") {
    CHECK(begin(0) <= 1e-8 * pressing);
    two.forces();
    CHECK(two.force[1].norm() < 1e-3 * force.norm());
  }
  SECTION("lifted until the faces part") {
    begin(0.01 * pressing);
    CHECK(two.list.pair[0].lift.norm() > 0);
    two.block[1].u.z() += 1e-4;
    two.forces();
    CHECK(two.list.pair[0].lift.isZero(0));
  }
}

TEST_CASE("a pair lists its memory for checkpoints", "[contact]") {
  ContactPair p;
  std::size_t bytes = 0;
  each(p, [&](auto, auto& x) { bytes += sizeof(x); });
  CHECK(bytes + sizeof(Corners) + alignof(ContactPair) > sizeof(ContactPair));  // only padding, and corners, which are found anew
}
