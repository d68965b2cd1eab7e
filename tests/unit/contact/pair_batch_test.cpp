#include "engine/contact/law/pair_batch.h"

#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "tests/unit/contact/bodies.h"

using namespace erbs;
using trial::Bodies;
using trial::Body;
using trial::brick;

namespace {

void check_near(const Vec3& x, const Vec3& y, double scale) { CHECK((x - y).norm() <= 1e-8 * scale); }

// Compares a single evaluation of a pair, and its stored history, with one lane of a pack of eight.
void check_same(const ContactPair& p, const PairResult& r, const ContactPair& q, const PairResult& s) {
  const double force = r.wrench.force.norm() + 1, energy = 1e-6;
  check_near(r.wrench.force, s.wrench.force, force);
  check_near(r.wrench.moment_a, s.wrench.moment_a, force);
  check_near(r.wrench.moment_b, s.wrench.moment_b, force);
  CHECK(r.touching == s.touching);
  CHECK(r.tangential == Approx(s.tangential).epsilon(1e-7).margin(energy));
  CHECK(r.friction == Approx(s.friction).epsilon(1e-7).margin(energy));
  CHECK(r.damping == Approx(s.damping).epsilon(1e-7).margin(energy));
  CHECK(r.depth == Approx(s.depth));
  CHECK(r.omega2_a == Approx(s.omega2_a));
  CHECK(r.omega2_b == Approx(s.omega2_b));
  CHECK(r.slip_omega2 == Approx(s.slip_omega2).margin(1e-3));
  CHECK(r.elastic == Approx(s.elastic).epsilon(1e-9).margin(1e-13));  // J: the same integral over other triangles, equal to round-off
  CHECK(p.touching == q.touching);
  CHECK(p.area == Approx(q.area));
  CHECK(p.gyration == Approx(q.gyration).margin(1e-9));
  CHECK(p.peak_closing_speed == Approx(q.peak_closing_speed));
  CHECK(p.tangential == Approx(q.tangential).epsilon(1e-7).margin(energy));
  CHECK(p.psi == Approx(q.psi).epsilon(1e-7).margin(1e-10));
  check_near(p.u, q.u, 1e-3);
  check_near(p.c, q.c, 1);
  check_near(p.n, q.n, 1);
  CHECK((p.rotation - q.rotation).norm() < 1e-14);
  CHECK((p.shift - q.shift).norm() < 1e-14);
  check_near(p.friction.moment_a, q.friction.moment_a, force);
  check_near(p.damping.force, q.damping.force, force);
  CHECK(p.lag == Approx(q.lag).epsilon(1e-7).margin(1e-6));
  CHECK(p.separating_axis == q.separating_axis);
}

}  // namespace

TEST_CASE("eight pairs side by side press as each does alone", "[contact]") {
  std::mt19937 random(7);
  const auto draw = [&](double a) { return a * (2 * std::uniform_real_distribution<double>()(random) - 1); };
  std::vector<Body> bodies{{{box_polyhedron({-3, -3, -0.4}, {3, 3, 0})}, 0}};
  for (int i = 0; i < 14; ++i) {  // of different size: either one of two may be the reference
    const Polyhedron one = brick(0.3, 0.125, i % 3 == 0 ? 0.1 : 0.12);
    Polyhedron turned = one;
    const Mat3 turn = rotation(Vec3(draw(0.3), draw(0.3), draw(1))).toRotationMatrix();
    for (Vec3& v : turned.vertices) v = turn * v + Vec3(0.2 * (i % 2), 0.1 * (i % 3), 0.12 + 0.13 * i);
    bodies.push_back({{turned}, 1800, Vec3(draw(0.5), draw(0.5), -1), Vec3(draw(2), draw(2), draw(2))});
  }
  Bodies pile(bodies, {1e9, 4e8, 0.6, 0.2}, 2e-5);
  pile.gravity = Vec3(0, 0, -9.81);
  pile.settings.falling_mass = 14 * pile.mass[1];
  const auto batch = std::make_unique<PairBatch>();
  int compared = 0, slipping = 0;
  pile.step(true);
  for (int step = 0; step < 12000; ++step) {
    const bool looks = step % 53 == 0;
    const std::vector<ContactPair> before = looks ? pile.list.pair : std::vector<ContactPair>{};
    const std::vector<ContactBlock> blocks = looks ? pile.block : std::vector<ContactBlock>{};
    pile.want_energy = looks && step % 159 == 0;
    pile.step();
    std::vector<ContactPair> pair;
    for (const ContactPair& p : before)
      if (fits_pack(p, bodies_of(p, pile.shapes)) && find_pair(pile.list, p.a, p.part_a, p.b, p.part_b) >= 0) pair.push_back(p);
    for (std::size_t first = 0; first < pair.size(); first += 8) {
      const int count = int(std::min<std::size_t>(8, pair.size() - first));
      PairResult result[8];
      PairTask task[8];
      for (int l = 0; l < count; ++l) {
        ContactPair& p = pair[first + std::size_t(l)];
        task[l] = {&p, bodies_of(p, pile.shapes), &blocks[std::size_t(p.a)], &blocks[std::size_t(p.b)], &result[l]};
      }
      const ContactPair untouched = pair[first];
      const unsigned left_out = pair_forces(task, count, pile.settings, pile.dt, pile.want_energy, *batch);
      for (int l = 0; l < count; ++l) {
        const ContactPair& p = *task[l].pair;
        const int at = find_pair(pile.list, p.a, p.part_a, p.b, p.part_b);
        if ((left_out >> l & 1u) != 0) {
          CHECK_FALSE(pile.result[std::size_t(at)].touching);
          if (l == 0) CHECK((p.u == untouched.u && p.rotation == untouched.rotation && p.touching == untouched.touching));
          continue;
        }
        INFO("step " << step << " pair " << p.a << " " << p.b);
        check_same(pile.list.pair[std::size_t(at)], pile.result[std::size_t(at)], p, result[l]);
        slipping += result[l].friction > 0;
        ++compared;
      }
    }
  }
  CHECK(compared > 500);
  CHECK(slipping > 20);
}

TEST_CASE("a pair's numbers do not depend on its neighbours in the lanes", "[contact]") {
  Body slab{{box_polyhedron({-1, -1, -0.2}, {1, 1, 0})}, 0};
  std::vector<Body> bodies{slab};
  for (int i = 0; i < pairs_per_batch; ++i)
    bodies.push_back({{translated(brick(), {0.4 * (i % 4) - 0.6, 0.3 * (i / 4) - 0.3, 0.05 - 1e-5 * (i + 1)})},
                      1800,
                      Vec3(0.01 * i, 0, -0.1),
                      Vec3(0.1 * i, 0.02, 0)});
  Bodies many(bodies, {1e9, 4e8, 0.6, 0.2}, 2e-5);
  many.step(true);
  many.step();
  std::vector<ContactPair> together = many.list.pair, alone = together;
  REQUIRE(together.size() == std::size_t(pairs_per_batch));
  const auto batch = std::make_unique<PairBatch>();
  PairResult result[pairs_per_batch], one[pairs_per_batch];
  PairTask task[pairs_per_batch];
  const auto task_of = [&](ContactPair& p, PairResult& r) {
    return PairTask{&p, bodies_of(p, many.shapes), &many.block[std::size_t(p.a)], &many.block[std::size_t(p.b)], &r};
  };
  for (std::size_t l = 0; l < std::size_t(pairs_per_batch); ++l) task[l] = task_of(together[l], result[l]);
  CHECK(pair_forces(task, pairs_per_batch, many.settings, many.dt, false, *batch) == 0);
  for (std::size_t l = 0; l < std::size_t(pairs_per_batch); ++l) {
    const PairTask single = task_of(alone[l], one[l]);
    CHECK(pair_forces(&single, 1, many.settings, many.dt, false, *batch) == 0);
    CHECK(one[l].wrench.force == result[l].wrench.force);
    CHECK(one[l].wrench.moment_b == result[l].wrench.moment_b);
    CHECK(one[l].damping == result[l].damping);
    CHECK(alone[l].u == together[l].u);
  }
}
