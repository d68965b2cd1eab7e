#include "render/mesh.h"

#include <catch2/catch.hpp>
#include <map>

#include "engine/base/units.h"
#include "render/draw.h"
#include "render/stage.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

Vec3 at(const Mesh& mesh, std::uint32_t i) {
  const float* p = mesh.vertices[i].p;
  return {p[0], p[1], p[2]};
}

// Twice the number of directed edges without a twin, and the volume inside.
struct Shell {
  int open_edges = 0;
  double volume = 0;
};
Shell measure(const Mesh& mesh, const std::vector<std::uint32_t>& index) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  Shell s;
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    s.volume += at(mesh, index[i]).dot(at(mesh, index[i + 1]).cross(at(mesh, index[i + 2]))) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = index[i + k], b = index[i + (k + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 10 : -10;
    }
  }
  for (const auto& [edge, uses] : edges) s.open_edges += uses == 2 ? 0 : 1;
  return s;
}

MotionShape wedge() {
  return {{0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1}, {{0, 3, 2, 1}, {0, 1, 4}, {3, 5, 2}, {0, 4, 5, 3}, {1, 2, 5, 4}}};
}

}  // namespace

TEST_CASE("a chamfered part is closed, faces outwards and loses little", "[render][mesh]") {
  Mesh mesh;
  std::vector<std::uint32_t> open, buried;
  add_part(mesh, wedge(), 0, 0.01, std::vector<bool>(5, false), open, buried);
  CHECK(buried.empty());
  const Shell s = measure(mesh, open);
  CHECK(s.open_edges == 0);
  CHECK(s.volume < 1);  // 2 * 1 * 1 / 2
  CHECK(s.volume > 0.995);
}

TEST_CASE("what lies within an intact wall is not drawn", "[render][mesh]") {
  const MotionScene scene = brick_house({1.525, 1.83, 8, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  MotionFrame rest = brick_house_frame(scene, 0);
  const FrameTexels intact = texels_of(show, rest, Coloring::material);
  CHECK(20 * intact.index.size() < 11 * show.mesh.index.size());
  CHECK(intact.crack_index.empty());
  rest.damage[10] = 255;
  const FrameTexels broken = texels_of(show, rest, Coloring::material);
  CHECK(broken.index.size() > intact.index.size());
  CHECK(broken.crack_index.size() == 4 * 6);
  // A joint that parts without a word of damage shows its mortar too.
  rest = brick_house_frame(scene, 0);
  rest.poses[7 * 20 + 1] += 0.02F;
  CHECK(texels_of(show, rest, Coloring::material).index.size() > intact.index.size());
}

TEST_CASE("the ground is the wide fixed block, and cameras see the building", "[render][stage]") {
  const MotionScene scene = brick_house({});
  const Stage stage = set_stage(scene, {brick_house_frame(scene, 0)});
  CHECK(stage.hidden[0]);
  CHECK(std::count(stage.hidden.begin(), stage.hidden.end(), true) == 1);
  CHECK(stage.ground_z == Approx(-0.005));
  CHECK(stage.building.sizes().x() == Approx(1.525));
  for (const Camera& camera : choose_cameras(stage, 1280.0 / 560)) {
    const View v = look(camera, stage, 1280, 720, 58, 102);
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = stage.building.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
      const Eigen::Vector4f c = v.projection * v.view * p.cast<float>().homogeneous();
      const float row = 360 * (1 - c.y() / c.w());
      CHECK(std::abs(c.x() / c.w()) < 1);
      CHECK(row > 58);
      CHECK(row < 720 - 102);
    }
    // The target is in the middle of the part that the overlay leaves free.
    const Eigen::Vector4f c = v.projection * v.view * camera.target.cast<float>().homogeneous();
    CHECK(360 * (1 - c.y() / c.w()) == Approx(0.5 * (58 + 720 - 102)).margin(0.1));
  }
}

TEST_CASE("a small base is no ground", "[render][stage]") {
  MotionScene scene = brick_house({});
  for (float& v : scene.shapes[0].vertices) v *= 0.1F;
  const Stage stage = set_stage(scene, {});
  CHECK_FALSE(stage.hidden[0]);
  CHECK(stage.ground_z == Approx(-0.55225));
}
