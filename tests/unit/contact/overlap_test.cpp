#include "engine/contact/overlap.h"

#include "engine/contact/ramp.h"

#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "tests/unit/contact/bodies.h"

using namespace erbs;

namespace {

Polyhedron wedge() {
  return hull({{-0.2, -0.1, -0.05}, {0.2, -0.1, -0.05}, {0.2, 0.1, -0.05}, {-0.2, 0.1, -0.05}, {0.1, -0.1, 0.08}, {0.1, 0.1, 0.08}});
}
Polyhedron frustum(int n) {  // more faces than a small body has where n > 6
  std::vector<Vec3> v;
  for (int i = 0; i < n; ++i)
    for (const double z : {-0.06, 0.07})
      v.push_back(Vec3((z < 0 ? 0.16 : 0.1) * std::cos(2 * pi * i / n), (z < 0 ? 0.14 : 0.1) * std::sin(2 * pi * i / n), z));
  return hull(v);
}

struct Scatter {
  std::mt19937 random{20};
  double operator()(double a) { return a * (2 * std::uniform_real_distribution<double>()(random) - 1); }
};

void check_same(const ContactShape& a, const ContactShape& b, const PairPose& pose, OverlapRoom& fast, OverlapRoom& general) {
  int one = -1, two = -1;
  Patch p = find_overlap(a, b, pose, one, fast), q = find_overlap(a, b, pose, two, general);
  REQUIRE((p.total > 0) == (q.total > 0));
  REQUIRE((one < 0) == (two < 0));
  if (!(p.total > 0)) return;
  const double near = 1e-9;
  CHECK(p.total == Approx(q.total).epsilon(near));
  CHECK(p.area == Approx(q.area).epsilon(near));
  CHECK(p.gyration == Approx(q.gyration).epsilon(1e-6).margin(1e-9));
  CHECK((p.second - q.second).norm() < near * q.second.norm());
  CHECK(p.deepest == Approx(q.deepest).epsilon(near));
  CHECK((p.force - q.force).norm() < near * q.force.norm());
  CHECK((p.moment - q.moment).norm() < near * 0.3 * q.force.norm());
  CHECK((p.centroid - q.centroid).norm() < near);
  CHECK((p.pressure_centre - q.pressure_centre).norm() < near);
  const Vec3 linear(0.3, -0.2, 0.5), angular(1, 2, -3);
  closing_speeds(fast, linear, angular, p);
  closing_speeds(general, linear, angular, q);
  CHECK(p.closing == Approx(q.closing));
  Vec3 f0, m0, f1, m1;
  for (const double chi : {0.1, 1.5}) {  // within the clamp; past it here and there, however the polygons are cut into triangles
    damping_wrench(fast, p.normal, chi, 2, f0, m0);
    damping_wrench(general, q.normal, chi, 2, f1, m1);
    CHECK((f0 - f1).norm() < near * q.force.norm());
    CHECK((m0 - m1).norm() < near * 0.3 * q.force.norm());
  }
  CHECK(overlap_energy(a, b, pose, fast) == Approx(overlap_energy(a, b, pose, general)).epsilon(1e-6));
}

}  // namespace

TEST_CASE("small bodies overlap the fast way as the general way", "[contact]") {
  const std::vector<ContactShape> shapes{contact_shape(trial::brick()), contact_shape(wedge()), contact_shape(frustum(3)),
                                         contact_shape(frustum(4)), contact_shape(frustum(7))};
  CHECK(shapes[0].is_small);
  CHECK(shapes[1].is_small);
  CHECK_FALSE(shapes[4].is_small);
  const auto fast = std::make_unique<OverlapRoom>(), general = std::make_unique<OverlapRoom>();
  general->only_general = true;
  Scatter scatter;
  int met = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const ContactShape &a = shapes[std::size_t(trial) % 5], &b = shapes[std::size_t(trial / 5) % 5];
    PairPose pose;
    const bool resting = trial % 3 == 0;  // face on face to a micrometre
    const Vec3 turn(scatter(resting ? 1e-6 : 2), scatter(resting ? 1e-6 : 2), scatter(2));
    pose.turn = rotation(turn).toRotationMatrix();
    pose.shift = resting ? Vec3(scatter(0.1), scatter(0.05), a.centre.z() + a.half.z() - b.centre.z() + b.half.z() - 1e-6)
                         : Vec3(scatter(0.2), scatter(0.1), scatter(0.15));
    INFO("trial " << trial);
    check_same(a, b, pose, *fast, *general);
    met += fast->fast && fast->triangles.count > 0;
  }
  CHECK(met > 800);
}

TEST_CASE("instruction sets clip to the same bits, and a pair to the same whatever is clipped beside it", "[contact]") {
  const std::vector<ContactShape> shapes{contact_shape(trial::brick()), contact_shape(wedge()), contact_shape(frustum(4))};
  const auto narrow = std::make_unique<Triangles[]>(8), wide = std::make_unique<Triangles[]>(8);
  const auto alone = std::make_unique<Triangles>();
  Scatter scatter;
  int met = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ClipJob job[8];
    for (std::size_t l = 0; l < 8; ++l) {
      const bool resting = (trial + int(l)) % 3 == 0;
      const Mat3 turn = rotation(Vec3(scatter(resting ? 1e-6 : 2), scatter(resting ? 1e-6 : 2), scatter(2))).toRotationMatrix();
      job[l] = {&shapes[l % 3].small, &shapes[(l / 3) % 3].small, {}, &wide[l]};
      for (int i = 0; i < 9; ++i) job[l].pose.turn[i] = turn(i / 3, i % 3);
      for (double& x : job[l].pose.shift) x = scatter(0.1);
      if (resting) job[l].pose.shift[2] = 0.0999;
    }
    clip_kernels().clip_all(job, 8);
    for (std::size_t l = 0; l < 8; ++l) job[l].out = &narrow[l];
    sse2::clip_kernels.clip_all(job, 8);
    for (std::size_t l = 0; l < 8; ++l) {
      clip_kernels().clip(*job[l].a, *job[l].b, job[l].pose, *alone);
      REQUIRE(narrow[l].count == wide[l].count);
      REQUIRE(narrow[l].count == alone->count);
      REQUIRE(narrow[l].separating == wide[l].separating);
      if (narrow[l].count == 0) continue;
      ++met;
      OverlapSums sums[3];
      double damped[3][4], closing[3];
      int k = 0;
      for (Triangles* t : {&narrow[l], &wide[l], alone.get()}) {
        const ClipKernels& kernels = k == 0 ? sse2::clip_kernels : clip_kernels();
        const double turning[3] = {0.3, -2, 1};
        kernels.sum(*t, sums[k]);
        closing[k] = kernels.approach(*t, 0.2, turning);
        const double n[3] = {0.6, 0, -0.8};
        kernels.damp(*t, n, 1.5, 1.6, damped[k][0], &damped[k][1]);
        ++k;
      }
      for (k = 1; k < 3; ++k) {
        CHECK(std::equal(&sums[0].total, &sums[0].unused[0], &sums[k].total));
        CHECK(closing[0] == closing[k]);
        CHECK(std::equal(damped[0], damped[0] + 4, damped[k]));
      }
    }
  }
  CHECK(met > 1000);
}

TEST_CASE("the share of a clamp in a triangle is exact", "[contact]") {
  // f = 1 and g = x over the triangle (-1, 0) (2, 0) (-1, 3): Int x+ = Int_0^2 x (2 - x) dx = 4/3, Int x+ x = Int_0^2 x^2 (2 - x) dx = 4/3
  const double f[3] = {1, 1, 1}, g[3] = {-1, 2, -1}, x[3][3] = {{-1, 0, 0}, {2, 0, 0}, {-1, 3, 0}};
  double i0 = 0, i1[3] = {};
  add_ramp(f, g, x, 4.5, i0, i1);
  CHECK(i0 == Approx(4.0 / 3));
  CHECK(i1[0] == Approx(4.0 / 3));
  // its complement, two corners above zero: Int (-x)+ = Int x+ - Int x with Int x = 0, Int (-x)+ x = Int x+ x - Int x^2, Int x^2 = 9/4
  const double h[3] = {1, -2, 1};
  double j0 = 0, j1[3] = {};
  add_ramp(f, h, x, 4.5, j0, j1);
  CHECK(j0 == Approx(4.0 / 3));
  CHECK(j1[0] == Approx(4.0 / 3 - 9.0 / 4));
}

TEST_CASE("strips that a face has sunk by are left out at an error of a millionth", "[contact]") {
  const ContactShape brick = contact_shape(trial::brick());
  const auto room = std::make_unique<OverlapRoom>();
  for (const bool general : {false, true}) {
    room->only_general = general;
    const double edge = 0.1, just = sliver * edge;
    double force[2], across[2];
    int i = 0;
    for (const double depth : {just * (1 - 1e-9), just * (1 + 1e-9)}) {  // without the strips, and with them
      int none = -1;
      // a corner on a corner: the strips do not cancel, and are short
      const Patch p = find_overlap(brick, brick, {Mat3::Identity(), Vec3(0.25, 0.1, 0.1 - depth)}, none, *room);
      force[i] = p.force.z();
      across[i++] = p.force.head<2>().norm();
    }
    CHECK(across[0] < 1e-12 * force[0]);
    CHECK(across[1] > 0);
    CHECK(across[1] < 1e-5 * force[1]);
    CHECK(force[0] == Approx(force[1]).epsilon(1e-8));
  }
}
