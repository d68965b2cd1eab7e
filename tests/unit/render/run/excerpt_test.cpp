// What of a run is drawn: groups left out or translucent, and sections with closed cut faces.
#include "render/run/excerpt.h"

#include <catch2/catch.hpp>
#include <map>

#include "engine/base/error.h"
#include "render/draw/draw.h"
#include "render/run/framing.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// The house with its blocks in three groups by height, and the ground.
MotionScene house_in_groups() {
  MotionScene scene = brick_house({1.2, 1.2, 6, 1, 0.5});
  double top = 0;
  for (const MotionBlock& b : scene.blocks) top = std::max(top, b.rest.z());
  for (MotionBlock& b : scene.blocks)
    b.group = b.fixed ? "ground" : b.rest.z() < top / 3 ? "low" : b.rest.z() < 2 * top / 3 ? "middle" : "high";
  return scene;
}

Vec3 corner(const MotionShape& s, int i) {
  const auto k = 3 * static_cast<std::size_t>(i);
  return {s.vertices[k], s.vertices[k + 1], s.vertices[k + 2]};
}

// Volume (m3), and the number of directed edges without a twin.
struct Solid {
  double volume = 0;
  int open_edges = 0;
};
Solid measure(const MotionShape& s) {
  Solid solid;
  std::map<std::pair<int, int>, int> edges;
  for (const std::vector<int>& f : s.faces)
    for (std::size_t k = 0; k < f.size(); ++k) {
      ++edges[{f[k], f[(k + 1) % f.size()]}];
      if (k >= 2) solid.volume += corner(s, f[0]).dot(corner(s, f[k - 1]).cross(corner(s, f[k]))) / 6;
    }
  for (const auto& [edge, uses] : edges) {
    const auto twin = edges.find({edge.second, edge.first});
    if (uses != 1 || twin == edges.end() || twin->second != 1) ++solid.open_edges;
  }
  return solid;
}

MotionShape turned_box(const Vec3& half, const Mat3& turn) {
  MotionShape s{{}, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = turn * half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    for (int k = 0; k < 3; ++k) s.vertices.push_back(static_cast<float>(p[k]));
  }
  return s;
}

}  // namespace

TEST_CASE("hidden groups leave with their joints, and frames follow", "[render][excerpt]") {
  const MotionScene scene = house_in_groups();
  const MotionFrame frame = brick_house_frame(scene, 0.4);
  for (const std::vector<std::string>& hide : {std::vector<std::string>{"low"}, {"middle", "ground"}, {"high", "low", "ground"}}) {
    const std::vector<bool> gone = in_groups(scene, hide, "--hide");
    const Excerpt excerpt = without_groups(scene, hide);
    const MotionFrame part = excerpt_of(excerpt, frame);
    CHECK(excerpt.scene.blocks.size() + static_cast<std::size_t>(std::count(gone.begin(), gone.end(), true)) == scene.blocks.size());
    REQUIRE(part.poses.size() == 7 * excerpt.scene.blocks.size());
    REQUIRE(part.damage.size() == excerpt.scene.joints.size());
    REQUIRE(part.opening.size() == excerpt.scene.joints.size());
    for (std::size_t b = 0; b < excerpt.blocks.size(); ++b) {
      CHECK(excerpt.scene.blocks[b].name == scene.blocks[excerpt.blocks[b]].name);
      CHECK(part.poses[7 * b] == frame.poses[7 * excerpt.blocks[b]]);
    }
    for (std::size_t j = 0; j < excerpt.joints.size(); ++j) {
      const MotionJoint &joint = excerpt.scene.joints[j], &from = scene.joints[excerpt.joints[j]];
      CHECK(excerpt.blocks[static_cast<std::size_t>(joint.a)] == static_cast<std::size_t>(from.a));
      CHECK(excerpt.blocks[static_cast<std::size_t>(joint.b)] == static_cast<std::size_t>(from.b));
      CHECK(part.damage[j] == frame.damage[excerpt.joints[j]]);
    }
    CHECK_NOTHROW(texels_of(prepare_show(excerpt.scene, {}, {part}), part, Coloring::material, Vec3(5, -5, 3)));
  }
  CHECK(without_groups(scene, {}).whole);
  CHECK_THROWS_WITH(without_groups(scene, {"low", "middle", "high"}), Catch::Contains("leaves no block"));
  CHECK_THROWS_WITH(without_groups(scene, {"hihg"}),
                    Catch::Contains("did you mean \"high\"") && Catch::Contains("ground, high, low, middle"));
  CHECK_THROWS_WITH(in_groups(scene, {"roof of slate"}, "--ghost"), Catch::Contains("--ghost") && Catch::Contains("its groups: ground"));
  MotionScene nameless = scene;
  for (MotionBlock& b : nameless.blocks) b.group.clear();
  CHECK_THROWS_WITH(in_groups(nameless, {"wall"}, "--ghost"), Catch::Contains("in no group"));
}

TEST_CASE("a section cuts convex blocks in two closed halves", "[render][section]") {
  const Vec3 half(0.15, 0.06, 0.03);
  for (const double angle : {0.0, 0.3, 1.1})
    for (const double at : {-0.04, 0.0, 0.0171})
      for (int axis = 0; axis < 3; ++axis) {
        INFO("angle " << angle << ", at " << at << ", axis " << axis);
        const MotionShape box = turned_box(half, Eigen::AngleAxisd(angle, Vec3(1, 2, -1).normalized()).toRotationMatrix());
        REQUIRE(measure(box).open_edges == 0);
        REQUIRE(measure(box).volume == Approx(8 * half.prod()).epsilon(1e-5));
        const MotionShape above = cut_shape(box, Vec3::Unit(axis), at), below = cut_shape(box, -Vec3::Unit(axis), -at);
        CHECK(measure(above).open_edges == 0);
        CHECK(measure(below).open_edges == 0);
        CHECK(measure(above).volume + measure(below).volume == Approx(8 * half.prod()).epsilon(1e-4));
        for (int i = 0; 3 * static_cast<std::size_t>(i) < above.vertices.size(); ++i) CHECK(corner(above, i)[axis] > at - 1e-5);
      }
  const MotionShape box = turned_box(half, Mat3::Identity());
  CHECK(cut_shape(box, Vec3::UnitX(), -0.15) == box);  // touched, not cut
  CHECK(cut_shape(box, Vec3::UnitX(), 0.15).faces.empty());
}

TEST_CASE("behind a section lies half of the scene, with the joints of its blocks", "[render][section]") {
  const MotionScene scene = house_in_groups();
  std::vector<bool> ground;
  for (const MotionBlock& b : scene.blocks) ground.push_back(b.fixed);
  for (int axis = 0; axis < 3; ++axis)
    for (const double keep : {-1.0, 1.0}) {
      const double at = axis == 2 ? 0.31 : 0.37;
      const MotionScene cut = cut_scene(scene, {axis, at, keep}, ground);
      REQUIRE(cut.blocks.size() == scene.blocks.size());
      std::size_t gone = 0;
      for (std::size_t b = 0; b < cut.blocks.size(); ++b) {
        gone += cut.blocks[b].parts.empty() ? 1 : 0;
        for (int part : cut.blocks[b].parts) {
          const MotionShape& shape = cut.shapes[static_cast<std::size_t>(part)];
          for (int i = 0; !ground[b] && 3 * static_cast<std::size_t>(i) < shape.vertices.size(); ++i)
            CHECK(keep * (cut.blocks[b].rest[axis] + corner(shape, i)[axis] - at) > -1e-5);
        }
      }
      CHECK(gone > 0);
      for (const MotionJoint& joint : cut.joints) {
        const bool lost =
            cut.blocks[static_cast<std::size_t>(joint.a)].parts.empty() || cut.blocks[static_cast<std::size_t>(joint.b)].parts.empty();
        if (lost) CHECK(joint.polygon.empty());
        for (const Vec3& p : joint.polygon) CHECK(keep * (p[axis] + cut.blocks[static_cast<std::size_t>(joint.a)].rest[axis] - at) > -1e-5);
      }
    }
  CHECK_THROWS_WITH(cut_scene(scene, {0, 9, 1}, ground), Catch::Contains("does not meet") && Catch::Contains("choose x between"));
}

TEST_CASE("a section is read", "[render][section]") {
  CHECK(read_section("x=1.2").axis == 0);
  CHECK(read_section("x=1.2").keep == 0);
  CHECK(read_section("y<-0.5").at == -0.5);
  CHECK(read_section("y<-0.5").keep == -1);
  CHECK(read_section("z>2").keep == 1);
  for (const char* bad : {"", "x", "x=", "w=1", "x:1", "x=1m", "x=nan", "x=inf", "xx=1", "x<=1"})
    CHECK_THROWS_WITH(read_section(bad), Catch::Contains("--section") && Catch::Contains("try x=1.2"));
}

TEST_CASE("ghosts are translucent: what stands behind is seen, and they throw no shadow", "[render][ghost]") {
  const MotionScene scene = house_in_groups();
  const MotionFrame frame = brick_house_frame(scene, 0);
  const Stage stage = set_stage(scene, {frame});
  const Show solid = prepare_show(scene, {}, stage, {}, std::nullopt);
  const Show ghost = prepare_show(scene, {}, stage, in_groups(scene, {"high"}, "--ghost"), std::nullopt);
  const Show both = prepare_show(scene, {}, stage, in_groups(scene, {"high"}, "--ghost"), Section{1, 0.4, 1});
  CHECK(ghost.mesh.shade_index.size() < solid.mesh.shade_index.size());
  CHECK(texels_of(solid, frame, Coloring::material, Vec3(5, -5, 3)).ghost_index.empty());
  CHECK_FALSE(texels_of(ghost, frame, Coloring::material, Vec3(5, -5, 3)).ghost_index.empty());
  prepare_contexts();
  Look look;
  look.width = 320, look.height = 180;
  const Camera camera = choose_cameras(stage, 16.0 / 9).front();
  const Image full = Painter(solid, look, "auto").draw(frame, camera);
  const Image thin = Painter(ghost, look, "auto").draw(frame, camera);
  const Image half = Painter(both, look, "auto").draw(frame, camera);
  CHECK(full.rgb != thin.rgb);
  CHECK(thin.rgb != half.rgb);
  const Excerpt without = without_groups(scene, {"high"});
  const Show none = prepare_show(without.scene, {}, {excerpt_of(without, frame)});
  const Image absent = Painter(none, look, "auto").draw(excerpt_of(without, frame), camera);
  // A ghost lies between the block and nothing, nearer to nothing.
  double to_full = 0, to_absent = 0;
  for (std::size_t i = 0; i < full.rgb.size(); ++i) {
    to_full += std::abs(thin.rgb[i] - full.rgb[i]);
    to_absent += std::abs(thin.rgb[i] - absent.rgb[i]);
  }
  CHECK(to_absent > 0);
  CHECK(to_absent < to_full);
}
