// Blocks at rest start no search of their own, and are found by others.
#include <catch2/catch.hpp>

#include "tests/unit/contact/bodies.h"

using namespace erbs;
using namespace erbs::trial;

TEST_CASE("a search that leaves out what lies still lists what a whole one lists", "[contact]") {
  std::vector<Body> row;
  for (int i = 0; i < 6; ++i) row.push_back({{translated(brick(), Vec3(0.305 * i, 0, 0))}});
  Bodies one(row, {1e9, 4e8, 0.5, 0.2}, 1e-5), other(row, {1e9, 4e8, 0.5, 0.2}, 1e-5);
  const std::vector<std::uint8_t> loose(6, 1), still = {0, 1, 1, 1, 0, 0};
  const auto law = [&](int, int) { return one.law; };
  for (Bodies* b : {&one, &other}) {
    search(b->list, b->shapes, b->block, loose, {}, law);
    REQUIRE(b->list.pair.size() == 5);
    for (ContactPair& p : b->list.pair) p.tangential = 1 + p.a;  // contact history
    b->block[4].u = Vec3(0, 0, 1);                               // leaves its neighbours
    b->block[5].u = Vec3(-0.305 * 3, 0, 0.105);                  // comes to rest on a block that has not moved
  }
  CHECK(needs_search(one.list, one.shapes, one.block, still));
  const double dropped = search(one.list, one.shapes, one.block, loose, {}, law, 0, still);
  std::vector<int> fresh;
  CHECK(dropped == search(other.list, other.shapes, other.block, loose, {}, law, 0, {}, &fresh));
  REQUIRE(!fresh.empty());
  for (const int i : fresh) {  // remaining pairs are not new: they keep their history
    CHECK(other.list.pair[std::size_t(i)].b == 5);
    CHECK(other.list.pair[std::size_t(i)].tangential == 0);
  }
  CHECK(dropped == 4 + 5);
  REQUIRE(one.list.pair.size() == other.list.pair.size());
  for (std::size_t i = 0; i < one.list.pair.size(); ++i) {
    CHECK(one.list.pair[i].a == other.list.pair[i].a);
    CHECK(one.list.pair[i].b == other.list.pair[i].b);
    CHECK(one.list.pair[i].tangential == other.list.pair[i].tangential);
  }
  CHECK(find_pair(one.list, 2, 0, 5, 0) >= 0);
  CHECK_FALSE(needs_search(one.list, one.shapes, one.block, still));
}

// Bricks that fly at random through a box. In each step every pair whose bodies overlap must be in the list that the rule of searches
// keeps, whichever blocks search.
static void fly(double ahead, bool some_search_alone, long& searches) {
  unsigned state = 7;
  const auto draw = [&state](double low, double high) {  // Park and Miller 1988
    state = unsigned(16807ull * state % 2147483647ull);
    return low + (high - low) * state / 2147483647.0;
  };
  const auto vector = [&](double size) { return Vec3(draw(-size, size), draw(-size, size), draw(-size, size)); };
  std::vector<Body> bricks;
  for (int i = 0; i < 40; ++i) {
    const bool flies = i % 4 == 0;  // the others hardly move
    bricks.push_back({{translated(brick(), vector(0.6))}, 1800, vector(flies ? 10 : 0.05), vector(flies ? 20 : 0.1)});
  }
  Bodies all(bricks, {1e9, 4e8, 0.5, 0.2}, 1e-5);
  const std::vector<std::uint8_t> loose(all.block.size(), 1);
  const double dt = 1e-4;
  int met = 0;
  for (int step = 0; step < 800; ++step) {
    std::vector<std::uint8_t> others;
    if (some_search_alone && step % 5 == 2) {  // as where a joint has been released
      others.assign(all.block.size(), 1);
      others[std::size_t(step) % others.size()] = 0;
    }
    if (needs_search(all.list, all.shapes, all.block)) others.clear();
    if (!others.empty() || needs_search(all.list, all.shapes, all.block))
      search(
          all.list, all.shapes, all.block, loose, {}, [&](int, int) { return all.law; }, ahead, others);
    searches += others.empty() ? 0 : -1;
    OverlapRoom room;
    for (int a = 0; a < int(all.block.size()); ++a)
      for (int b = a + 1; b < int(all.block.size()); ++b) {
        ContactPair pair = new_pair(a, 0, b, 0, all.law, 0, all.shapes);
        PairResult result;
        const bool overlaps =
            pair_force(pair, all.shapes, all.block[std::size_t(a)], all.block[std::size_t(b)], {}, 0.0, false, room, result);
        met += overlaps && result.touching;
        if (overlaps && result.touching && find_pair(all.list, a, 0, b, 0) < 0)
          FAIL("not listed: " << a << ' ' << b << " in step " << step);
      }
    for (ContactBlock& b : all.block) {
      b.u += dt * b.v;
      b.rotation = rotation(dt * b.w).toRotationMatrix() * b.rotation;
    }
  }
  searches += all.list.searches;
  CHECK(met > 1000);
}

TEST_CASE("all that overlaps is listed, with fewer searches where the list looks ahead", "[contact]") {
  long plain = 0, ahead = 0, alone = 0;
  fly(0, false, plain);
  fly(20e-4, false, ahead);
  fly(20e-4, true, alone);
  CHECK(ahead < plain / 3);
  CHECK(alone < 2 * ahead);
}

TEST_CASE("blocks that are equal but for where and how they lie share a shape", "[contact]") {
  const auto turned = [](Polyhedron p, const Quat& q) {
    for (Vec3& v : p.vertices) v = q * v;
    return p;
  };
  const Polyhedron frustum = hull({{-.2, -.1, 0}, {.2, -.1, 0}, {.2, .1, 0}, {-.2, .1, 0}, {-.1, -.1, .2}, {.1, -.1, .2}, {.1, .05, .2}});
  std::vector<std::vector<Polyhedron>> parts;
  for (const Polyhedron& p : {brick(), frustum}) {
    for (int i = 0; i < 5; ++i) {
      const Polyhedron lies = turned(p, Quat(Eigen::AngleAxisd(0.3 * i, Vec3(1, -2, i).normalized())));
      const Vec3 far(3.1 * i, -7, 0.3);
      parts.push_back({translated(translated(lies, far), -far)});  // with the round-off of a distant place
      const Mat3 axes = contact_axes(parts.back());
      CHECK((axes * axes.transpose() - Mat3::Identity()).norm() < 1e-14);
      for (Vec3& v : parts.back()[0].vertices) v = axes.transpose() * v;
    }
  }
  const ContactShapes shapes = contact_shapes(parts);
  REQUIRE(shapes.of.size() == 10);
  for (std::size_t i = 2; i < 5; ++i) CHECK(shapes.of[i] == shapes.of[1]);  // the first lies along the world axes
  CHECK(shapes.shape.size() <= 4);
  // The box along these axes is the brick itself.
  const ContactShape& s = shapes.part(3);
  CHECK(8 * s.half.prod() == Approx(s.volume));
  CHECK(contact_axes({brick()}) == Mat3::Identity());
}
