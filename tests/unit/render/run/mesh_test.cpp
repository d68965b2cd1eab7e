#include "render/run/mesh.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "engine/base/units.h"
#include "render/draw/visible.h"
#include "render/run/framing.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

Vec3 at(const Mesh& mesh, std::uint32_t i) {
  const float* p = mesh.vertices[i].p;
  return {p[0], p[1], p[2]};
}

// Twice the number of directed edges without a twin, and the enclosed volume.
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
  Surface<std::vector<std::uint32_t>> open, buried;
  add_part(mesh, wedge(), 0, 0.01, std::vector<bool>(5, false), open, buried);
  CHECK((buried.faces.empty() && buried.edges.empty()));
  std::vector<std::uint32_t> all = open.faces;
  all.insert(all.end(), open.edges.begin(), open.edges.end());
  const Shell s = measure(mesh, all);
  CHECK(s.open_edges == 0);
  CHECK(s.volume < 1);  // 2 * 1 * 1 / 2
  CHECK(s.volume > 0.995);
}

TEST_CASE("what lies within an intact wall is not drawn", "[render][mesh]") {
  const MotionScene scene = brick_house({1.525, 1.83, 8, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  MotionFrame rest = brick_house_frame(scene, 0);
  const FrameTexels intact = texels_of(show, rest, Coloring::material, Vec3(5, -5, 3));
  const auto drawn = [](const FrameTexels& t) { return t.index.size() + t.fine_index.size(); };
  CHECK(20 * drawn(intact) < 11 * show.mesh.index.size());
  CHECK(intact.crack_index.empty());
  rest.damage[10] = 255;
  const FrameTexels broken = texels_of(show, rest, Coloring::material, Vec3(5, -5, 3));
  CHECK(drawn(broken) == drawn(intact));      // closed: its inside is not visible
  CHECK(broken.crack_index.size() == 2 * 6);  // of four sides, two look towards the eye
  // A joint that parts without any damage shows its mortar too.
  rest = brick_house_frame(scene, 0);
  rest.poses[7 * 20 + 1] += 0.02F;
  CHECK(drawn(texels_of(show, rest, Coloring::material, Vec3(5, -5, 3))) > drawn(intact));
}

TEST_CASE("the ground is the wide fixed block, and cameras see the building", "[render][stage]") {
  const MotionScene scene = brick_house({});
  const Stage stage = set_stage(scene, {brick_house_frame(scene, 0)});
  CHECK(stage.hidden[0]);
  CHECK(std::count(stage.hidden.begin(), stage.hidden.end(), true) == 1);
  CHECK(stage.ground_z == Approx(-0.005));
  CHECK(stage.building.sizes().x() == Approx(1.525));
  std::vector<Camera> cameras = choose_cameras(stage, 1280.0 / 560);
  for (const Camera& camera : elevations(stage, 1280.0 / 560)) {
    cameras.push_back(camera);
    const Vec3 sight = (camera.target - camera.eye).normalized();  // along an axis
    CHECK(sight.cwiseAbs().maxCoeff() == Approx(1));
  }
  REQUIRE(cameras.size() == 7);
  for (const Camera& camera : cameras) {
    INFO(camera.name);
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

TEST_CASE("cameras see where the blocks have come to lie", "[render][stage]") {
  const MotionScene scene = brick_house({});
  MotionFrame fallen = brick_house_frame(scene, 0);
  for (std::size_t b = 1; b < scene.blocks.size(); ++b) fallen.poses[7 * b] += 2, fallen.poses[7 * b + 2] = 0.1F;
  const Stage stage = set_stage(scene, {fallen});
  CHECK(stage.heap.center().x() == Approx(2).margin(0.1));
  for (const Camera& camera : choose_cameras(stage, 1280.0 / 560)) {
    const View v = look(camera, stage, 1280, 720, 58, 102);
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = stage.heap.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
      const Eigen::Vector4f c = v.projection * v.view * p.cast<float>().homogeneous();
      CHECK(std::abs(c.x() / c.w()) < 1);
      CHECK(std::abs(c.y() / c.w()) < 1);
    }
  }
}

TEST_CASE("cameras see the heap of a building that stood above the ground", "[render][stage]") {
  const double height = GENERATE(0.0, 0.5, 2.0), aspect = GENERATE(0.8, 16.0 / 9);
  MotionScene scene = brick_house({});
  scene.blocks[0].rest.z() -= height;
  MotionFrame fallen = brick_house_frame(scene, 0);
  const auto count = static_cast<float>(scene.blocks.size());
  for (std::size_t b = 1; b < scene.blocks.size(); ++b) {  // in a row along x, up to a length of the building away
    fallen.poses[7 * b] += 1.5F * static_cast<float>(b) / count;
    fallen.poses[7 * b + 2] = static_cast<float>(0.05 - height);
  }
  const Stage stage = set_stage(scene, {brick_house_frame(scene, 0), fallen});
  const int width = static_cast<int>(720 * aspect);
  for (const Camera& camera : choose_cameras(stage, width / 560.0)) {
    const View v = look(camera, stage, width, 720, 58, 102);
    std::size_t seen = 0;
    for (std::size_t b = 1; b < scene.blocks.size(); ++b) {
      const Eigen::Vector3f p = Eigen::Map<const Eigen::Vector3f>(&fallen.poses[7 * b]);
      const Eigen::Vector4f c = v.projection * v.view * p.homogeneous();
      const float row = 360 * (1 - c.y() / c.w());
      seen += std::abs(c.x() / c.w()) < 1 && row > 58 && row < 720 - 102 ? 1 : 0;
    }
    INFO(camera.name << " " << height);
    CHECK(seen == scene.blocks.size() - 1);
  }
}

TEST_CASE("a legend covers no part of what cameras are fitted to", "[render][stage]") {
  // From a tower to a long wall; the picture has 1280 x 720 pixels.
  const auto [length, courses] =
      GENERATE(std::pair(0.6, 40), std::pair(2.4, 30), std::pair(5.0, 25), std::pair(9.0, 40), std::pair(9.0, 12));
  const MotionScene scene = brick_house({length, 0.6, courses, 1, 0.5});
  Stage stage = set_stage(scene, {brick_house_frame(scene, 0)});
  const double aspect = 1280.0 / 546;
  const std::vector<Camera> plain = choose_cameras(stage, aspect);
  stage.legend_width = 214.0 / 1280, stage.legend_height = 100.0 / 546;
  std::vector<Camera> cameras = choose_cameras(stage, aspect);
  const bool moved = (cameras.front().eye - plain.front().eye).norm() > 1e-9;
  for (const Camera& camera : elevations(stage, aspect)) cameras.push_back(camera);
  for (const Camera& camera : cameras) {
    INFO(camera.name << ", " << length << " m, " << courses << " courses" << (moved ? ", moved" : ""));
    const View v = look(camera, stage, 1280, 720, 58, 116);
    int covered = 0, outside = 0;
    for (int i = 0; i <= 20; ++i)  // points of the faces of the building
      for (int j = 0; j <= 20; ++j)
        for (int face = 0; face < 6; ++face) {
          Vec3 share(0.05 * i, 0.05 * j, face % 2);
          std::rotate(share.data(), share.data() + face / 2, share.data() + 3);
          const Vec3 p = stage.building.min() + share.cwiseProduct(stage.building.sizes());
          const Eigen::Vector4f c = v.projection * v.view * p.cast<float>().homogeneous();
          const float x = 640 * (1 + c.x() / c.w()), y = 360 * (1 - c.y() / c.w());
          covered += x > 1280 - 214 && y < 58 + 100 ? 1 : 0;
          outside += x < 0 || x > 1280 || y < 58 || y > 720 - 116 ? 1 : 0;
        }
    CHECK(covered == 0);
    CHECK(outside == 0);
  }
}

TEST_CASE("what throws shadow is a block grown on every side", "[render][mesh]") {
  MotionScene scene;
  scene.blocks = {{"a", "", 0, false, Vec3(1, 2, 3), {share_shape(scene, wedge())}}};
  Mesh mesh;
  add_shades(mesh, scene, {false}, 0.01, 0.05);
  const MotionShape shape = wedge();
  REQUIRE(mesh.shades.size() == shape.vertices.size() / 3);
  for (const std::vector<int>& face : shape.faces) {
    Loop loop;
    for (int i : face) loop.emplace_back(shape.vertices[3 * i], shape.vertices[3 * i + 1], shape.vertices[3 * i + 2]);
    const Vec3 n = area_normal(loop).normalized();
    for (int i : face) {
      const float* p = mesh.shades[static_cast<std::size_t>(i)].p;
      CHECK((Vec3(p[0], p[1], p[2]) - loop.front()).dot(n) == Approx(0.01).epsilon(1e-4));
    }
  }
  add_shades(mesh, scene, {true}, 0.01, 0.05);
  CHECK(mesh.shades.size() == shape.vertices.size() / 3);
}

TEST_CASE("a closed wall casts the shadow of its free faces and of the rims of its beds, an open joint that of whole blocks",
          "[render][mesh]") {
  const MotionScene scene = brick_house({1.525, 1.83, 8, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  const auto area = [&](const std::vector<std::uint32_t>& index) {  // m2
    double sum = 0;
    const auto p = [&](std::uint32_t i) { return Eigen::Map<const Eigen::Vector3f>(show.mesh.shades[i].p); };
    for (std::size_t i = 0; i + 2 < index.size(); i += 3)
      sum += 0.5 * static_cast<double>((p(index[i + 1]) - p(index[i])).cross(p(index[i + 2]) - p(index[i])).norm());
    return sum;
  };
  MotionFrame frame = brick_house_frame(scene, 0);
  const auto shade = [&] { return texels_of(show, frame, Coloring::material, Vec3(5, -5, 3)).shade_index; };
  const double closed = area(shade());
  double whole = 0;
  for (const Span& span : show.mesh.whole_shade)
    whole += area({show.mesh.shade_index.begin() + span.begin, show.mesh.shade_index.begin() + span.end});
  CHECK(closed < 0.75 * whole);
  for (const std::size_t moved : {std::size_t(20), std::size_t(40)}) {
    frame = brick_house_frame(scene, 0);
    frame.poses[7 * moved + 1] += 0.02F;
    CHECK(area(shade()) > closed);
    CHECK(area(shade()) < whole);
  }
}

TEST_CASE("chamfers narrower than a quarter of a pixel are drawn only where no mortar sets blocks apart", "[render][mesh]") {
  const MotionScene scene = brick_house({1.525, 1.83, 8, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  const MotionFrame frame = brick_house_frame(scene, 0);
  const Vec3 eye(5, -5, 3);
  REQUIRE((show.mortared && show.chamfer > 0));
  const auto fine = [&](Coloring coloring, double pixel) { return texels_of(show, frame, coloring, eye, {pixel}).fine_index.size(); };
  const double all = 4 * show.chamfer / 20, none = 4 * show.chamfer / 1;  // of all distances, 20 and 1 m as bounds
  CHECK(fine(Coloring::material, 0) == fine(Coloring::material, all));
  CHECK(fine(Coloring::material, none) < fine(Coloring::material, all) / 2);
  CHECK(fine(Coloring::damage, none) == fine(Coloring::damage, 0));
}

TEST_CASE("mortar behind the band of its crack is left out, beside it and of wide gaps it is not", "[render][mesh]") {
  const MotionScene scene = brick_house({1.525, 1.83, 8, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  MotionFrame frame = brick_house_frame(scene, 0);
  const Vec3 eye(5, -5, 3);
  const auto mortar = [&](double band) {
    const FrameTexels t = texels_of(show, frame, Coloring::material, eye, {0, band});
    return t.fine_index.size();
  };
  const double wide = 10 * scene.joints.front().thickness / 0.3, narrow = 0.1 * scene.joints.front().thickness / 20;
  CHECK(mortar(wide) == mortar(0));  // without a crack there is no band
  std::fill(frame.damage.begin(), frame.damage.end(), std::uint8_t(255));
  CHECK(mortar(narrow) == mortar(0));
  const std::size_t hidden = mortar(0) - mortar(wide);
  CHECK(hidden > 0);
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) frame.poses[7 * b] += 1.5F * static_cast<float>(b);  // debris
  CHECK(mortar(wide) == mortar(0));
}

TEST_CASE("poses are drawn as exactly as a pixel shows, however far blocks have gone and turned", "[render][mesh]") {
  const MotionScene scene = brick_house({1.525, 1.83, 8, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  const MotionFrame rest = brick_house_frame(scene, 0);
  const Vec3 eye(5, -5, 3);
  for (const double pixel : {1e-5, 8e-4, 2e-2})
    for (const double turn : {0.0, 1e-4, 0.3, pi - 1e-3, pi, 2 * pi - 1e-3})
      for (const double far : {0.0, 1e-5, 0.4, 30.0}) {
        MotionFrame frame = rest;
        for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
          const double x = static_cast<double>(b);
          const Quat q = rotation(turn * Vec3(std::sin(x), std::cos(2 * x), std::sin(3 * x + 1)).normalized());
          const double w[4] = {q.w(), q.x(), q.y(), q.z()};
          for (std::size_t k = 0; k < 4; ++k) frame.poses[7 * b + 3 + k] = static_cast<float>(w[k]);
          for (std::size_t k = 0; k < 3; ++k) frame.poses[7 * b + k] += static_cast<float>(far * std::sin(x + static_cast<double>(k)));
        }
        MotionFrame drawn = frame;
        drawn.poses = rounded_poses(show, frame, eye, pixel);
        double worst = 0;  // px
        for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
          const double radius = static_cast<double>(show.radius[b]), near = (place_of(frame, b).cast<double>() - eye).norm() - radius;
          if (radius <= 0 || near <= 0.01) continue;
          const double moved = static_cast<double>((place_of(drawn, b) - place_of(frame, b)).norm());
          const double turned = 2 * static_cast<double>((turn_of(drawn, b).coeffs() - turn_of(frame, b).coeffs()).norm());  // rad
          const double single = 1e-6 * (near + radius + far);  // m, of its precision
          worst = std::max(worst, (moved + turned * radius - single) / (pixel * near));
        }
        INFO(pixel << " m, " << turn << " rad, " << far << " m");
        CHECK(worst < 0.05);  // of a fiftieth in each coordinate, for place and rotation
      }
}

TEST_CASE("a block has the colour of the broken share of its joints", "[render][show]") {
  MotionScene scene = brick_house({1.2, 1.2, 6, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  MotionFrame frame = brick_house_frame(scene, 0);
  std::fill(frame.damage.begin(), frame.damage.end(), 0);
  const auto block = static_cast<std::size_t>(scene.joints[10].a);
  double area = 0;
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    if (scene.joints[j].a == scene.joints[10].a || scene.joints[j].b == scene.joints[10].a) area += static_cast<double>(show.joint_area[j]);
  frame.damage[10] = 255;
  const FrameTexels t = texels_of(show, frame, Coloring::damage, Vec3(5, -5, 3));
  const Vec3 expected = damage_color(static_cast<double>(show.joint_area[10]) / area);
  for (std::size_t k = 0; k < 3; ++k) CHECK(static_cast<double>(t.blocks[12 * block + 8 + k]) == Approx(expected[static_cast<int>(k)]));
}

TEST_CASE("a small base is no ground", "[render][stage]") {
  MotionScene scene = brick_house({});
  for (float& v : scene.shapes[0].vertices) v *= 0.1F;
  const Stage stage = set_stage(scene, {});
  CHECK_FALSE(stage.hidden[0]);
  CHECK(stage.ground_z == Approx(-0.55225));
}
