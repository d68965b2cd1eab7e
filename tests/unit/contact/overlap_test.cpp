#include "engine/contact/overlap/overlap.h"

#include "engine/contact/overlap/ramp.h"

#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "tests/unit/contact/bodies.h"

using namespace erbs;

namespace {

Polyhedron wedge() {
  return hull({{-0.2, -0.1, -0.05}, {0.2, -0.1, -0.05}, {0.2, 0.1, -0.05}, {-0.2, 0.1, -0.05}, {0.1, -0.1, 0.08}, {0.1, 0.1, 0.08}});
}
// For n > 6 it has more faces than a small body. Its sides are not plane, and thus two faces each, unless `top` is .0875.
Polyhedron frustum(int n, double top = 0.1) {
  std::vector<Vec3> v;
  for (int i = 0; i < n; ++i)
    for (const double z : {-0.06, 0.07})
      v.push_back(Vec3((z < 0 ? 0.16 : 0.1) * std::cos(2 * pi * i / n), (z < 0 ? 0.14 : top) * std::sin(2 * pi * i / n), z));
  return hull(v);
}

struct RandomNumbers {
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
  CHECK(p.max_depth == Approx(q.max_depth).epsilon(near));
  CHECK((p.force - q.force).norm() < near * q.force.norm());
  CHECK((p.moment - q.moment).norm() < near * 0.3 * q.force.norm());
  CHECK((p.centroid - q.centroid).norm() < near);
  CHECK((p.pressure_centre - q.pressure_centre).norm() < near);
  const Vec3 linear(0.3, -0.2, 0.5), angular(1, 2, -3);
  closing_speeds(fast, linear, angular, p);
  closing_speeds(general, linear, angular, q);
  CHECK(p.closing_speed == Approx(q.closing_speed));
  Vec3 f0, f1;
  for (const double chi : {0.1, 1.5}) {  // within the clamp; in part beyond it, for any triangulation of the polygons
    CHECK(std::abs(damping(fast, p.normal, chi, 2, f0) - damping(general, q.normal, chi, 2, f1)) < near * q.force.norm());
    CHECK((f0 - f1).norm() < near * 0.3 * q.force.norm());
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
  RandomNumbers scatter;
  int met = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const ContactShape &a = shapes[std::size_t(trial) % 5], &b = shapes[std::size_t(trial / 5) % 5];
    PairPose pose;
    const bool resting = trial % 3 == 0;  // face on face within a micrometre
    const Vec3 theta(scatter(resting ? 1e-6 : 2), scatter(resting ? 1e-6 : 2), scatter(2));
    pose.rotation = rotation(theta).toRotationMatrix();
    pose.shift = resting ? Vec3(scatter(0.1), scatter(0.05), a.centre.z() + a.half.z() - b.centre.z() + b.half.z() - 1e-6)
                         : Vec3(scatter(0.2), scatter(0.1), scatter(0.15));
    INFO("trial " << trial);
    check_same(a, b, pose, *fast, *general);
    met += fast->fast && fast->triangles.count > 0;
  }
  CHECK(met > 800);
}

TEST_CASE("instruction sets clip to the same bits, and a pair to the same whatever is clipped beside it", "[contact]") {
  const std::vector<ContactShape> shapes{contact_shape(trial::brick()), contact_shape(wedge()), contact_shape(frustum(4, 0.0875))};
  for (const ContactShape& shape : shapes) REQUIRE(shape.is_small);
  const auto narrow = std::make_unique<Triangles[]>(8), wide = std::make_unique<Triangles[]>(8);
  const auto alone = std::make_unique<Triangles>();
  RandomNumbers scatter;
  int met = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ClipTask task[8];
    for (std::size_t l = 0; l < 8; ++l) {
      const bool resting = (trial + int(l)) % 3 == 0;
      const Mat3 turn = rotation(Vec3(scatter(resting ? 1e-6 : 2), scatter(resting ? 1e-6 : 2), scatter(2))).toRotationMatrix();
      task[l] = {&shapes[l % 3].small, &shapes[(l / 3) % 3].small, {}, &wide[l]};
      for (int i = 0; i < 9; ++i) task[l].pose.rotation[i] = turn(i / 3, i % 3);
      for (double& x : task[l].pose.shift) x = scatter(0.1);
      if (resting) task[l].pose.shift[2] = 0.0999;
    }
    clip_kernels().clip_all(task, 8);
    for (std::size_t l = 0; l < 8; ++l) task[l].out = &narrow[l];
    sse2::clip_kernels.clip_all(task, 8);
    for (std::size_t l = 0; l < 8; ++l) {
      clip_kernels().clip(*task[l].a, *task[l].b, task[l].pose, *alone);
      REQUIRE(narrow[l].count == wide[l].count);
      REQUIRE(narrow[l].count == alone->count);
      REQUIRE(narrow[l].separating_axis == wide[l].separating_axis);
      if (narrow[l].count == 0) continue;
      ++met;
      OverlapSums sums[3];
      double damped[3][4], closing_speed[3];
      int k = 0;
      for (Triangles* t : {&narrow[l], &wide[l], alone.get()}) {
        const ClipKernels& kernels = k == 0 ? sse2::clip_kernels : clip_kernels();
        const double angular_part[3] = {0.3, -2, 1};
        kernels.sum(*t, sums[k]);
        closing_speed[k] = kernels.closing_speeds(*t, 0.2, angular_part);
        const double n[3] = {0.6, 0, -0.8};
        kernels.damp(*t, n, 1.5, 1.6, damped[k][0], &damped[k][1]);
        ++k;
      }
      for (k = 1; k < 3; ++k) {
        CHECK(std::equal(&sums[0].total, &sums[0].unused[0], &sums[k].total));
        CHECK(closing_speed[0] == closing_speed[k]);
        CHECK(std::equal(damped[0], damped[0] + 4, damped[k]));
      }
    }
  }
  CHECK(met > 1000);
}

TEST_CASE("the share of a clamp in a triangle is exact", "[contact]") {
  // f = 1 and g = x over the triangle (-1, 0) (2, 0) (-1, 3): Int x+ = Int_0^2 x (2 - x) dx = 4/3, Int x+ x = Int_0^2 x^2 (2 - x) dx = 4/3.
  const double f[3] = {1, 1, 1}, g[3] = {-1, 2, -1}, x[3][3] = {{-1, 0, 0}, {2, 0, 0}, {-1, 3, 0}};
  double i0 = 0, i1[3] = {};
  scalar::add_ramp<double>(f, g, x, 4.5, true, i0, i1);
  CHECK(i0 == Approx(4.0 / 3));
  CHECK(i1[0] == Approx(4.0 / 3));
  // The complement, two corners above zero: Int (-x)+ = Int x+ - Int x with Int x = 0. Int (-x)+ x = Int x+ x - Int x^2 with Int x^2 = 9/4.
  const double h[3] = {1, -2, 1};
  double j0 = 0, j1[3] = {};
  scalar::add_ramp<double>(f, h, x, 4.5, true, j0, j1);
  CHECK(j0 == Approx(4.0 / 3));
  CHECK(j1[0] == Approx(4.0 / 3 - 9.0 / 4));
}

namespace {

// Two bodies that rest on each other, cross at edges or meet at a corner, and then move.
struct Walk {
  explicit Walk(const ContactShape& a, const ContactShape& b, RandomNumbers& scatter, int kind)
      : spin(scatter(1), scatter(1), scatter(1)), speed(scatter(1), scatter(1), scatter(1)) {
    const bool resting = kind % 3 == 0;
    turn = rotation(Vec3(scatter(resting ? 1e-6 : 2), scatter(resting ? 1e-6 : 2), scatter(2))).toRotationMatrix();
    shift = resting ? Vec3(scatter(0.1), scatter(0.05), a.centre.z() + a.half.z() - b.centre.z() + b.half.z() - 1e-6)
                    : Vec3(scatter(0.2), scatter(0.1), scatter(0.15));
    step = resting ? 1e-7 : std::pow(10.0, -3 - kind % 4);
    const auto room = std::make_unique<OverlapRoom>();
    for (int i = 0; i < 20; ++i) {  // limits the depth to some millimetres
      int none = -1;
      const Patch patch = find_overlap(a, b, {turn, shift}, none, *room);
      if (!(patch.total > 0) || patch.max_depth < 0.005) break;
      shift += 0.7 * patch.max_depth * patch.normal;
    }
  }
  void go() {
    turn = rotation(Vec3(step * spin)).toRotationMatrix() * turn;
    shift += 0.1 * step * speed;
  }
  SmallPose pose() const {
    SmallPose out;
    for (int i = 0; i < 9; ++i) out.rotation[i] = turn(i / 3, i % 3);
    for (int i = 0; i < 3; ++i) out.shift[i] = shift[i];
    return out;
  }
  Vec3 spin, speed, shift;
  Mat3 turn;
  double step;
};

bool same(const Triangles& p, const Triangles& q) {
  if (p.count != q.count || p.separating_axis != q.separating_axis) return false;
  bool is_same = std::equal(p.faces, p.faces + p.count, q.faces);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) is_same = is_same && std::equal(p.corner[k][i], p.corner[k][i] + p.count, q.corner[k][i]);
  return is_same;
}

}  // namespace

TEST_CASE("an overlap known by its corners is the one that clipping finds, and the same bits whenever they were found", "[contact]") {
  const std::vector<ContactShape> shapes{contact_shape(trial::brick()), contact_shape(wedge()), contact_shape(frustum(3)),
                                         contact_shape(frustum(4, 0.0875))};
  for (const ContactShape& shape : shapes) REQUIRE(shape.is_small);
  const auto kept = std::make_unique<Triangles>(), anew = std::make_unique<Triangles>(), clipped = std::make_unique<Triangles>(),
             narrow = std::make_unique<Triangles>();
  RandomNumbers scatter;
  int met = 0, known_before = 0, without = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const ContactShape &a = shapes[std::size_t(trial) % 4], &b = shapes[std::size_t(trial / 4) % 4];
    Walk walk(a, b, scatter, trial);
    Corners corners, corners_narrow;
    for (int step = 0; step < 40; ++step, walk.go()) {
      INFO("trial " << trial << " step " << step);
      Corners none;
      const ClipTask task{&a.small, &b.small, walk.pose(), kept.get(), &corners};
      ClipTask fresh = task, plain = task, other = task;
      fresh.out = anew.get(), fresh.known = &none;
      plain.out = clipped.get(), plain.known = nullptr;
      other.out = narrow.get(), other.known = &corners_narrow;
      known_before += corners.count > 0;
      clip_kernels().clip_all(&task, 1);
      clip_kernels().clip_all(&fresh, 1);
      clip_kernels().clip_all(&plain, 1);
      sse2::clip_kernels.clip_all(&other, 1);
      REQUIRE(same(*kept, *anew));
      REQUIRE(same(*kept, *narrow));
      REQUIRE(corners.count == none.count);
      REQUIRE((kept->count > 0) == (clipped->count > 0));
      if (kept->count == 0) continue;
      ++met;
      without += corners.count == 0;
      OverlapSums p, q;
      clip_kernels().sum(*kept, p);
      clip_kernels().sum(*clipped, q);
      const double near = 1e-9, deep = kept->max_depth;  // sums, with corners off by round-off over the sine of two planes
      CHECK(p.total == Approx(q.total).epsilon(near).margin(1e-16 * deep));
      CHECK(p.area == Approx(q.area).epsilon(1e-7).margin(1e-10));
      for (int i = 0; i < 3; ++i) {
        CHECK(p.force[i] == Approx(q.force[i]).epsilon(near).margin(near * std::abs(q.total)));
        CHECK(p.moment[i] == Approx(q.moment[i]).epsilon(near).margin(near * 0.3 * std::abs(q.total)));
        CHECK(p.pressure[i] == Approx(q.pressure[i]).epsilon(near).margin(near * 0.3 * std::abs(q.total)));
      }
      CHECK(kept->max_depth == Approx(clipped->max_depth).epsilon(near));
    }
  }
  CHECK(met > 5000);
  CHECK(known_before > met * 8 / 10);
  CHECK(without < met / 30);  // too many corners, or four planes through one
}

TEST_CASE("bodies whose edges cross are as far apart as the edges", "[contact]") {
  const double s = 0.1, gap = 3e-4;
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(Vec3(i & 1 ? s : -s, i & 2 ? s : -s, i & 4 ? s : -s) / 2);
  const ContactShape cube = contact_shape(hull(corners));
  CHECK(cube.edge.size() == 3);
  const Mat3 a = rotation(Vec3(pi / 4, 0, 0)).toRotationMatrix(), b = rotation(Vec3(0, pi / 4, 0)).toRotationMatrix();
  const auto room = std::make_unique<OverlapRoom>();
  for (const bool general : {false, true}) {
    room->only_general = general;
    // The edges cross at right angles, each s / sqrt 2 from its centre.
    const PairPose pose{a.transpose() * b, a.transpose() * Vec3(0.01, -0.02, std::sqrt(2.0) * s + gap)};
    int separating_axis = -1;
    CHECK(find_overlap(cube, cube, pose, separating_axis, *room).total == 0);
    CHECK(separating_axis >= 12);
    CHECK(room->apart == Approx(gap).epsilon(1e-9));
    CHECK(distance(cube, cube, pose, separating_axis) == Approx(gap).epsilon(1e-9));
    const PairPose closer{pose.rotation, a.transpose() * Vec3(0.01, -0.02, std::sqrt(2.0) * s - gap)};
    CHECK(find_overlap(cube, cube, closer, separating_axis, *room).total > 0);
  }
}

TEST_CASE("stones of many edges that meet at a ridge each are as far apart as the ridges", "[contact]") {
  const double gap = 3e-3, high = 0.06;
  std::vector<Vec3> corners{{-0.05, 0, high}, {0.05, 0, high}};
  for (int i = 0; i < 7; ++i) corners.emplace_back(0.1 * std::cos(0.9 * i), 0.1 * std::sin(0.9 * i), -0.004 * (i * i % 5));
  const ContactShape stone = contact_shape(hull(corners));
  CHECK(stone.edge.size() * stone.edge.size() > 256);
  const auto room = std::make_unique<OverlapRoom>();
  const Mat3 over = rotation(Vec3(0, 0, pi / 2)).toRotationMatrix() * rotation(Vec3(pi, 0, 0)).toRotationMatrix();
  int separating_axis = -1;
  CHECK(find_overlap(stone, stone, {over, Vec3(0.01, 0.02, 2 * high + gap)}, separating_axis, *room).total == 0);
  CHECK(room->apart == Approx(gap).epsilon(1e-9));
}
