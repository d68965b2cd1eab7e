// Normal contact law: exact derivative of a volume integral; energy and momentum in collisions; rest; restitution.
#include <catch2/catch.hpp>
#include <random>

#include "tests/unit/contact/bodies.h"

using namespace erbs;
using namespace erbs::trial;

namespace {

// Int phi dV over both bodies. Bisectors and planes cut the overlap into cells by general half-space clipping of polygons; tetrahedra
// integrate them. The code is independent of the engine's surface form.
double volume_integral(const Polyhedron& a, const Polyhedron& b) {
  const auto pa = planes(a), pb = planes(b);
  double sum = 0;
  for (std::size_t f = 0; f < pa.size(); ++f) {
    std::vector<Plane> cell{pa[f]};
    cell.insert(cell.end(), pb.begin(), pb.end());
    for (std::size_t e = 0; e < pa.size(); ++e) {
      if (e == f) continue;
      const Vec3 n = pa[e].n - pa[f].n;  // d_f <= d_e
      cell.push_back({n, pa[e].d - pa[f].d});
    }
    const Vec3 apex = b.vertices[0];
    for (std::size_t g = 0; g < cell.size(); ++g) {
      const double length = cell[g].n.norm();
      const Vec3 n = cell[g].n / length, t = n.unitOrthogonal(), s = n.cross(t);
      const Vec3 c = apex + (cell[g].d / length - n.dot(apex)) * n;
      std::vector<Vec3> loop{c - 9 * t - 9 * s, c + 9 * t - 9 * s, c + 9 * t + 9 * s, c - 9 * t + 9 * s};
      for (std::size_t h = 0; h < cell.size() && !loop.empty(); ++h) {
        if (h == g) continue;
        std::vector<Vec3> kept;
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Vec3 p = loop[i], q = loop[(i + 1) % loop.size()];
          const double dp = cell[h].n.dot(p) - cell[h].d, dq = cell[h].n.dot(q) - cell[h].d;
          if (dp <= 0) kept.push_back(p);
          if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept.push_back(p + dp / (dp - dq) * (q - p));
        }
        loop = kept;
      }
      auto depth = [&](const Vec3& x) { return pa[f].d - pa[f].n.dot(x); };
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const double v = (loop[0] - apex).dot((loop[i] - apex).cross(loop[i + 1] - apex)) / 6;
        sum += v / 4 * (depth(apex) + depth(loop[0]) + depth(loop[i]) + depth(loop[i + 1]));
      }
    }
  }
  return sum;
}

// A random pair that overlaps by up to `depth`.
std::pair<Polyhedron, Polyhedron> overlapping(const Polyhedron& p, const Polyhedron& q, std::mt19937& random, double depth) {
  const Polyhedron a = transformed(p, rotation(random_vector(random)), Vec3::Zero());
  const Quat theta = rotation(random_vector(random));
  const Vec3 way = random_vector(random).normalized();
  double low = 0, high = 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    std::vector<Vec3> moved;
    (volume_integral(a, transformed(q, theta, middle * way)) > 0 ? low : high) = middle;
  }
  return {a, transformed(q, theta, (low - depth) * way)};
}

Polyhedron frustum() {
  std::vector<Vec3> x;
  for (int i = 0; i < 7; ++i) {
    const double c = std::cos(2 * M_PI * i / 7), s = std::sin(2 * M_PI * i / 7);
    x.emplace_back(0.2 * c, 0.2 * s, 0.1);
    x.emplace_back(0.1 * c, 0.1 * s, -0.1);
  }
  return hull(x);
}
Polyhedron skew_pyramid() { return hull({{0, 0, 0}, {0.3, 0, 0}, {0, 0.2, 0}, {0, 0, 0.25}, {0.3, 0, 0.25}}); }

struct Probe {
  Vec3 force, moment;
  double energy;
};

// Engine's force on b and moment about its centroid, with b moved by `by` and rotated by `rotation` about its centroid.
Probe probe(const Polyhedron& a, const Polyhedron& b, const Vec3& by, const Vec3& theta, double kn) {
  Bodies two({{{a}}, {{b}}}, {kn, 0, 0, 1}, 1e-6);
  two.settings.settling = two.settings.settling_tangential = 0;
  two.block[1].u = by;
  two.block[1].rotation = rotation(theta).toRotationMatrix();
  two.forces();
  return {two.force[1], two.moment[1], two.elastic};
}

}  // namespace

TEST_CASE("the force is the derivative of the volume integral, for general convex bodies", "[contact]") {
  std::mt19937 random(7);
  const double kn = 1e10, h = 1e-6;
  for (int round = 0; round < 24; ++round) {
    const Polyhedron p = round % 3 == 0 ? frustum() : brick(), q = round % 3 == 1 ? skew_pyramid() : brick();
    const auto [a, b] = overlapping(p, q, random, 0.001 + 0.0015 * (round % 5));
    const bool b_first = mass_properties(b).volume > mass_properties(a).volume * (1 + 1e-9);
    const Vec3 centre = mass_properties(b).centroid;
    auto energy = [&, &a = a, &b = b](const Vec3& by, const Vec3& theta) {
      const Quat r = rotation(theta);
      const Polyhedron moved = transformed(b, r, centre - r * centre + by);
      return kn * (b_first ? volume_integral(moved, a) : volume_integral(a, moved));
    };
    const Probe exact = probe(a, b, Vec3::Zero(), Vec3::Zero(), kn);
    CHECK(exact.energy == Approx(energy(Vec3::Zero(), Vec3::Zero())).epsilon(1e-7));
    Vec3 force, moment;
    for (int i = 0; i < 3; ++i) {
      const Vec3 e = h * Vec3::Unit(i);
      force[i] = -(energy(e, Vec3::Zero()) - energy(-e, Vec3::Zero())) / (2 * h);
      moment[i] = -(energy(Vec3::Zero(), e / 0.1) - energy(Vec3::Zero(), -e / 0.1)) / (2 * h / 0.1);
    }
    CHECK((force - exact.force).norm() < 1e-4 * exact.force.norm());
    CHECK((moment - exact.moment).norm() < 1e-4 * exact.force.norm() * 0.1);
  }
}

TEST_CASE("undamped oblique collisions keep energy and momentum", "[contact]") {
  std::mt19937 random(3);
  const double kn = 1e10, dt = 0.2 * step_unit(kn, 1800 * 0.00375, 0.0375);
  std::vector<double> errors;
  for (int round = 0; round < 12; ++round) {
    const Vec3 way = random_vector(random).normalized();
    Body a{{transformed(brick(), rotation(random_vector(random)), Vec3::Zero())}}, b = a;
    b.parts = {transformed(brick(), rotation(random_vector(random)), 0.36 * way)};
    b.v = -3 * way + 0.3 * random_vector(random);
    a.w = random_vector(random);
    b.w = random_vector(random);
    Bodies two({a, b}, {kn, 0, 0, 1}, dt);
    two.settings.settling = two.settings.settling_tangential = 0;
    two.step(true);
    const double before = two.kinetic;
    const Vec3 momentum = two.momentum(), angular = two.angular_momentum();
    two.run(0.2);
    CHECK(two.list.searches < 400);
    errors.push_back(std::abs(two.total() / before - 1));
    CHECK((two.momentum() - momentum).norm() < 1e-12 * momentum.norm());
    CHECK((two.angular_momentum() - angular).norm() < 1e-11 * (angular.norm() + 0.3 * momentum.norm()));
  }
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 1e-6);
  CHECK(errors.back() < 5e-5);
}

TEST_CASE("a brick bounces on a floor in 16 orientations without gaining energy", "[contact]") {
  const double kn = 1e10, dt = 0.2 * step_unit(kn, 1800 * 0.00375, 0.0375);
  std::mt19937 random(11);
  for (int round = 0; round < 16; ++round) {
    Body floor{{box_polyhedron({-5, -5, -1}, {5, 5, 0})}, 0};
    Polyhedron p = transformed(brick(), rotation(random_vector(random)), Vec3::Zero());
    p = translated(p, {0, 0, 0.05 - bounding_box(p).low.z()});
    Bodies two({floor, {{p}}}, {kn, 0, 0, 1}, dt);
    two.settings.settling = two.settings.settling_tangential = 0;
    two.gravity = {0, 0, -9.81};
    two.step(true);
    two.run(0.6);
    const double scale = two.mass[1] * 9.81 * 0.05;
    CHECK(std::abs(two.total()) < 2e-4 * scale);
    CHECK(two.max_depth < 0.01);
  }
}

TEST_CASE("a flat drop stays flat", "[contact]") {
  const double kn = 1e10, dt = 0.2 * step_unit(kn, 1800 * 0.00375, 0.0375);
  Body floor{{box_polyhedron({-5, -5, -1}, {5, 5, 0})}, 0};
  Bodies two({floor, {{translated(brick(), {0, 0, 0.06})}}}, {kn, 0.4 * kn, 0.6, 0.3}, dt);
  two.gravity = {0, 0, -9.81};
  two.run(0.3);
  CHECK(two.block[1].w.norm() < 1e-9);
  CHECK(std::hypot(two.block[1].u.x(), two.block[1].u.y()) < 1e-10);
  CHECK(two.block[1].v.norm() < 1e-3);
}

TEST_CASE("restitution is what was asked for, flat, on an edge and on a corner", "[contact]") {
  const double kn = 1e10, dt = 0.1 * step_unit(kn, 1800 * 0.00375, 0.0375);
  const Polyhedron cube = box_polyhedron({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05});
  for (double e : {1.0, 0.8, 0.5, 0.3}) {
    for (double speed : {0.2, 2.0}) {
      for (int pose = 0; pose < 3; ++pose) {
        // Each cube falls with its centroid above the point of contact.
        const Quat q = pose == 0   ? Quat::Identity()
                       : pose == 1 ? rotation({M_PI / 4, 0, 0})
                                   : Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ());
        Polyhedron p = transformed(cube, q, Vec3::Zero());
        p = translated(p, {0, 0, 1e-4 - bounding_box(p).low.z()});
        Body floor{{box_polyhedron({-5, -5, -1}, {5, 5, 0})}, 0};
        Bodies two({floor, {{p}, 1800, {0, 0, -speed}}}, {kn, 0.4 * kn, 0.6, e}, dt);
        two.run(speed < 1 ? 0.06 : 0.01);
        INFO("e " << e << " speed " << speed << " pose " << pose);
        CHECK(two.block[1].v.z() / speed == Approx(e).margin(0.01));
        // A face meets a face within one step. The work of the half step before it is at most k v^2 dt^2 / 8, (omega dt)^2 / 4 of the
        // energy.
        CHECK(std::abs(two.total() - 0.5 * two.mass[1] * speed * speed) < 0.01 * 0.5 * two.mass[1] * speed * speed);
      }
    }
  }
}

// Hard case 21.
TEST_CASE("a brick at 20 m/s never passes a slab of 20 mm", "[contact][hard]") {
  for (double kn : {1e11, 1e12}) {
    for (int pose = 0; pose < 3; ++pose) {
      const Quat q = pose == 0   ? Quat::Identity()
                     : pose == 1 ? rotation({M_PI / 4, 0, 0})
                                 : Quat::FromTwoVectors(Vec3(0.15, 0.0625, 0.05), Vec3::UnitZ());
      Polyhedron p = transformed(brick(), q, Vec3::Zero());
      p = translated(p, {0.01, 0.02, 0.001 - bounding_box(p).low.z()});
      Body slab{{box_polyhedron({-1, -1, -0.02}, {1, 1, 0})}, 0};
      const double density = 10 / 0.00375, dt = 0.2 * step_unit(kn, 10, 0.0375);
      Bodies two({slab, {{p}, density, {0, 0, -20}}}, {kn, 0.4 * kn, 0, 1}, dt);
      two.settings.settling = two.settings.settling_tangential = 0;
      double lowest = 1;
      while (two.t < 0.02) {
        two.step(two.t == 0);
        lowest = std::min(lowest, two.block[1].rest.z() + two.block[1].u.z());
      }
      CHECK(lowest > 0.03);
      CHECK(two.block[1].v.z() > 0);
      CHECK(std::abs(two.total() / 2000 - 1) < 0.02);
      CHECK(20 * dt < 0.02 / 4);
    }
  }
}

TEST_CASE("contact is the same wherever the scene stands and however it is turned", "[contact]") {
  std::mt19937 random(5);
  const double kn = 1e10, dt = 0.2 * step_unit(kn, 1800 * 0.00375, 0.0375);
  auto travel = [&](const Quat& theta, const Vec3& shift) {
    const Polyhedron lower = transformed(brick(0.4, 0.3, 0.1), theta, shift);
    const Quat lean = theta * rotation({0.1, 0.05, 0.3});
    const Polyhedron upper = transformed(brick(), lean, theta * Vec3(0.05, 0.02, 0.12) + shift);
    Bodies two({{{lower}, 0}, {{upper}, 1800, theta * Vec3(0.5, 0.2, -1)}}, {kn, 0.4 * kn, 0.5, 0.4}, dt);
    two.gravity = theta * Vec3(0, 0, -9.81);
    two.run(0.05);
    CHECK(two.friction > 0);
    return std::make_pair(Vec3(theta.conjugate() * two.block[1].u), Vec3(theta.conjugate() * two.block[1].w));
  };
  const auto [u0, w0] = travel(Quat::Identity(), Vec3::Zero());
  for (int i = 0; i < 3; ++i) {
    const auto [u, w] = travel(rotation(random_vector(random)), Vec3::Zero());
    CHECK((u - u0).norm() < 1e-9 * u0.norm());
    CHECK((w - w0).norm() < 1e-8 * w0.norm());
  }
  const auto [u, w] = travel(Quat::Identity(), {1e4, -1e4, 5e3});
  CHECK((u - u0).norm() < 1e-6 * u0.norm());
  CHECK((w - w0).norm() < 1e-6 * w0.norm());
}

TEST_CASE("a pair that turns as one feels no dashpot", "[contact]") {
  const double kn = 1e9, ks = 4e8, dt = 1e-4, omega = 3;
  Bodies two({{{brick()}}, {{translated(brick(), Vec3(0.02, 0.01, 0.1 - 1e-5))}}}, {kn, ks, 0.6, 0.5}, dt);
  two.forces();
  REQUIRE(two.result.size() == 1);
  REQUIRE(two.result[0].touching);
  // One step about an axis some half a metre away: chords and Cayley's rotation, as in a time step.
  const Vec3 axis = Vec3(1, 2, 3).normalized(), centre(0.5, -0.4, 0.2);
  const Quat theta = rotation(omega * dt * axis);
  for (ContactBlock& b : two.block) {
    b.u = theta * (b.rest - centre) + centre - b.rest;
    b.rotation = theta.toRotationMatrix();
    b.v = b.u / dt;
    b.w = 2 / dt * std::tan(omega * dt / 2) * axis;
  }
  two.t = dt;
  two.forces();
  const double lagging = 0.5 * dt * omega * omega * 0.1;  // m/s: separation speed if computed with the poses at the end of the step
  const double dashpot = 2 * two.settings.settling_tangential * std::sqrt(ks * 0.03 * two.mass[0] / 4);
  CHECK(two.list.pair[0].damping.force.norm() < 1e-6 * dashpot * lagging);
  CHECK(std::abs(two.damping) < 1e-6 * dashpot * lagging * lagging * dt);
}
