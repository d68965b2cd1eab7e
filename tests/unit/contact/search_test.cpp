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
