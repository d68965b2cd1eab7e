#include "engine/model/build/interface.h"

#include <catch2/catch.hpp>
#include <chrono>

#include "engine/geometry/separation.h"

using namespace erbs;

namespace {
Polyhedron brick(double x, double y, double z) { return translated(box_polyhedron({0, 0, 0}, {0.3, 0.125, 0.1}), {x, y, z}); }
JointRule rule(double thickness = 0) {
  JointRule r;
  r.thickness = thickness;
  return r;
}
std::vector<InterfaceBlock> blocks_of(const std::vector<Polyhedron>& shapes) {
  std::vector<InterfaceBlock> blocks;
  for (const Polyhedron& p : shapes) blocks.push_back({{&p, 1}, "", false});
  return blocks;
}
}  // namespace

TEST_CASE("a brick on two bricks has two half-brick interfaces midway in the mortar", "[interface]") {
  const std::vector<Polyhedron> shapes{brick(0, 0, 0), brick(0.31, 0, 0), brick(0.155, 0, 0.11)};
  const std::vector<JointRule> rules{rule(0.01)};
  const Interfaces found = find_interfaces(blocks_of(shapes), rules);
  CHECK(found.overlaps.empty());
  REQUIRE(found.all.size() == 3);
  CHECK((found.all[0].normal - Vec3::UnitX()).norm() < 1e-14);  // head joint
  CHECK(found.all[0].area == Approx(0.125 * 0.1));
  for (std::size_t i : {1U, 2U}) {
    CHECK((found.all[i].normal - Vec3::UnitZ()).norm() < 1e-14);
    CHECK(found.all[i].b == 2);
    CHECK(found.all[i].area == Approx(0.145 * 0.125));
    CHECK(found.all[i].gap == Approx(0.01));
    for (const Vec3& x : found.all[i].polygon) CHECK(x.z() == Approx(0.105));
    Vec3 around = Vec3::Zero();
    const auto& p = found.all[i].polygon;
    for (std::size_t k = 0; k < p.size(); ++k) around += (p[k] - p[0]).cross(p[(k + 1) % p.size()] - p[0]) / 2;
    CHECK(around.dot(found.all[i].normal) == Approx(found.all[i].area));
  }
}

TEST_CASE("the last rule that matches wins, and none means none", "[interface]") {
  const std::vector<Polyhedron> shapes{brick(0, 0, 0), brick(0, 0, 0.1), brick(0, 0, 0.2)};
  std::vector<InterfaceBlock> blocks = blocks_of(shapes);
  blocks[0].group = "base";
  blocks[1].group = blocks[2].group = "wall";
  std::vector<JointRule> rules{rule(), rule(), rule()};
  rules[1].group_a = rules[1].group_b = "wall";
  rules[2].group_a = "wall";
  rules[2].group_b = "base";
  rules[2].none = true;
  const Interfaces found = find_interfaces(blocks, rules);
  REQUIRE(found.all.size() == 1);
  CHECK(found.all[0].a == 1);
  CHECK(found.all[0].rule == 1);
  CHECK(find_interfaces(blocks, {}).all.empty());
  blocks[1].fixed = blocks[2].fixed = true;
  CHECK(find_interfaces(blocks, std::span(rules).first(1)).all.size() == 1);
}

TEST_CASE("overlap is reported with its depth, touching corners are no interface", "[interface]") {
  const std::vector<Polyhedron> shapes{brick(0, 0, 0), brick(0.1, 0, 0.099), brick(0.4, 0.125, 0)};
  const Interfaces found = find_interfaces(blocks_of(shapes), std::vector<JointRule>{rule()});
  REQUIRE(found.overlaps.size() == 1);
  CHECK(found.overlaps[0].depth == Approx(1e-3));
  CHECK(found.overlaps[0].relative == Approx(1e-2));
  REQUIRE(found.all.size() == 1);
  CHECK(found.all[0].gap == Approx(-1e-3));
}

TEST_CASE("an L-shaped block of two parts meets its neighbour in two interfaces; wedges meet on turned faces", "[interface]") {
  const std::vector<Polyhedron> ell{box_polyhedron({0, 0, 0}, {0.2, 1, 0.2}), box_polyhedron({0.2, 0, 0}, {1, 0.2, 0.2})};
  const std::vector<Polyhedron> other{box_polyhedron({0.2, 0.2, 0}, {0.5, 0.5, 0.2})};
  std::vector<InterfaceBlock> blocks{{ell, "", false}, {other, "", false}};
  const Interfaces found = find_interfaces(blocks, std::vector<JointRule>{rule()});
  CHECK(found.overlaps.empty());
  REQUIRE(found.all.size() == 2);
  CHECK(found.all[0].area == Approx(0.3 * 0.2));

  const Quat q = rotation({0.4, 0.2, -0.9});
  const Vec3 far(9e3, -4e3, 1e3);
  const std::vector<Polyhedron> shapes{transformed(brick(0, 0, 0), q, far), transformed(brick(0.1, 0.05, 0.1), q, far)};
  const Interfaces turned = find_interfaces(blocks_of(shapes), std::vector<JointRule>{rule()});
  REQUIRE(turned.all.size() == 1);
  CHECK(turned.overlaps.empty());
  CHECK((turned.all[0].normal - q * Vec3::UnitZ()).norm() < 1e-10);
  CHECK(turned.all[0].area == Approx(0.2 * 0.075).epsilon(1e-8));
}

TEST_CASE("a running bond wall of thousands of bricks on one slab", "[interface]") {
  std::vector<Polyhedron> shapes{box_polyhedron({-5, -5, -1}, {100, 5, 0})};
  const int courses = 40, per = 100;
  for (int c = 0; c < courses; ++c)
    for (int i = 0; i < per; ++i) shapes.push_back(brick(0.3 * i + (c % 2) * 0.15, 0, 0.1 * c));
  std::vector<InterfaceBlock> blocks = blocks_of(shapes);
  blocks[0].fixed = true;
  const Interfaces found = find_interfaces(blocks, std::vector<JointRule>{rule()});
  CHECK(found.overlaps.empty());
  CHECK(static_cast<int>(found.all.size()) == per + courses * (per - 1) + (courses - 1) * (2 * per - 1));
}
