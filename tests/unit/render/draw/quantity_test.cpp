// Colours by quantities that follow from poses, densities and joints.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/vec.h"
#include "render/movie/movie.h"
#include "render/run/framing.h"
#include "render/vector/drawing.h"
#include "tests/support/folder.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// A fixed base and a loose box of 0.2 x 0.1 x 0.1 m; in 0.1 s the box moves by 0.03 m along y and turns by 0.2 rad about z.
MotionScene box_on_base() {
  MotionShape box{{}, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (int i = 0; i < 8; ++i)
    for (const float v : {i & 1 ? 0.1F : -0.1F, i & 2 ? 0.05F : -0.05F, i & 4 ? 0.05F : -0.05F}) box.vertices.push_back(v);
  MotionScene scene;
  const int shape = share_shape(scene, box);
  scene.blocks = {{"base", "", 0, true, Vec3::Zero(), {shape}}, {"box", "", 0, false, Vec3(0, 0, 0.1), {shape}}};
  return scene;
}

}  // namespace

TEST_CASE("kinetic energy is that of translation and rotation", "[render][quantity]") {
  const test::Folder dir;
  const MotionScene scene = box_on_base();
  MotionWriter writer(dir.path.string(), scene);
  MotionFrame f{0, {0, 0, 0, 1, 0, 0, 0, 0, 0, 0.1F, 1, 0, 0, 0}, {}, {}, {}};
  writer.write(f);
  f.t = 0.1;
  f.poses[8] = 0.03F;
  f.poses[10] = std::cos(0.1F), f.poses[13] = std::sin(0.1F);
  writer.write(f);
  writer.close();
  const MotionReader reader(dir.path.string());
  Run run;
  CHECK_THROWS_WITH(bodies_of(reader.scene(), run), Catch::Contains("density of block box"));
  run.materials = {{"brick", Vec3::Ones(), 2000}};
  const std::vector<Body> bodies = bodies_of(reader.scene(), run);
  CHECK(bodies[0].mass == 0);
  CHECK(bodies[1].mass == Approx(4));  // 2000 kg/m3 x 0.002 m3
  MotionFrame frame = reader.read(1);
  derive_energies(reader, bodies, frame);
  const double inertia = 4 * (0.2 * 0.2 + 0.1 * 0.1) / 12;  // kg m2, about z
  CHECK(static_cast<double>(frame.derived[1]) == Approx(0.5 * 4 * 0.3 * 0.3 + 0.5 * inertia * 2 * 2).epsilon(1e-4));
  CHECK(frame.derived[0] == 0);
  CHECK(block_values(scene, frame, Coloring::energy)[1] == Approx(static_cast<double>(frame.derived[1])));
  CHECK(map_share(10, 10, Coloring::energy) == Approx(1));
  CHECK(map_share(10e-3, 10, Coloring::energy) == Approx(0.5));  // six decades
  CHECK(map_share(0, 10, Coloring::energy) < 0);
  CHECK(map_share(5, 10, Coloring::speed) == 0.5);
}

TEST_CASE("speeds of a fall and of a spin that grows are those of their instant", "[render][quantity]") {
  const test::Folder dir;
  MotionWriter writer(dir.path.string(), box_on_base());
  for (const double t : {0.0, 0.0401, 0.08, 0.1202}) {
    MotionFrame f{t, {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, {}, {}, {}};
    f.poses[9] = static_cast<float>(-0.5 * 9.81 * t * t);
    f.poses[10] = static_cast<float>(std::cos(5 * t * t)), f.poses[13] = static_cast<float>(std::sin(5 * t * t));  // 20 rad/s2 about z
    writer.write(f);
  }
  writer.close();
  const MotionReader reader(dir.path.string());
  for (const double t : {0.0, 0.02, 0.0401, 0.07, 0.08, 0.1, 0.1202}) {
    const Rates rates = rates_at(reader, nullptr, t);
    CHECK(rates.velocity[1].z() == Approx(-9.81 * t).margin(1e-5));
    CHECK(rates.spin[1].z() == Approx(20 * t).margin(1e-4));
  }
}

TEST_CASE("a block has the colour of its most stressed joint", "[render][quantity]") {
  MotionScene scene;
  const int part = share_shape(scene, {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  for (int i = 0; i < 4; ++i) scene.blocks.push_back({"b", "wall", 0, i == 0, {0, 0, 1.0 * i}, {part}});
  for (int i = 0; i < 3; ++i) scene.joints.push_back({i, i + 1, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {0, 0, 1}, 0});
  const bool kept = GENERATE(true, false);
  const test::Folder dir;
  MotionWriter writer(dir.path.string(), scene, kept);
  MotionFrame f{0, std::vector<float>(28), {0, 0, 0}, {0, 0, 0}};
  if (kept) f.normal_stress = {-3e5F, -2e5F, 1e5F}, f.shear_stress = {0, 5e4F, 1e4F}, f.force.resize(9), f.force_at.resize(9);
  writer.write(f);
  writer.close();
  const MotionReader reader(dir.path.string());
  MotionFrame frame = reader.read(0);
  if (!kept) {
    CHECK_THROWS_WITH(derive_stresses(reader, false, frame), Catch::Contains("frame_stress = true"));
    return;
  }
  derive_stresses(reader, false, frame);
  CHECK(block_values(scene, frame, Coloring::normal_stress) == std::vector<double>{3e5, 3e5, 2e5, 0});  // tension is no compression
  CHECK(color_scale(scene, {frame}, Coloring::normal_stress) == Approx(5e5));
  derive_stresses(reader, true, frame);
  CHECK(block_values(scene, frame, Coloring::shear_stress)[1] == Approx(5e4));
  CHECK(is_quantity(Coloring::shear_stress));
  CHECK_FALSE(is_quantity(Coloring::joint_state));
}

TEST_CASE("joints have the state of their damage and opening", "[render][quantity]") {
  const MotionScene scene = brick_house({1.2, 1.2, 6, 1, 0.5});
  const Show show = prepare_show(scene, {}, {});
  MotionFrame frame = brick_house_frame(scene, 0);
  std::fill(frame.damage.begin(), frame.damage.end(), 0);
  std::fill(frame.opening.begin(), frame.opening.end(), 0);
  frame.damage[3] = frame.damage[4] = 255;
  frame.opening[4] = frame.opening[5] = static_cast<float>(1.01 * show.open_crack);
  frame.opening[6] = static_cast<float>(0.9 * show.open_crack);
  const FrameTexels t = texels_of(show, frame, Coloring::joint_state, Vec3(5, -5, 3));
  const auto state = [&](std::size_t j) { return static_cast<render::JointState>(static_cast<int>(t.joints[4 * j + 2])); };
  CHECK(state(2) == render::JointState::intact);
  CHECK(state(3) == render::JointState::cracked);
  CHECK(state(4) == render::JointState::open);
  CHECK(state(5) == render::JointState::open);
  CHECK(state(6) == render::JointState::intact);
  CHECK(5 * t.crack_index.size() > 2 * show.mesh.crack_index.size());  // intact joints are lines as well, where they look towards the eye
  CHECK(texels_of(show, frame, Coloring::material, Vec3(5, -5, 3)).crack_index.size() < t.crack_index.size());
}

TEST_CASE("a joint without bond is drawn as one that opened while it is open, in pictures and drawings", "[render][quantity]") {
  const MotionScene scene = brick_house({1.2, 1.2, 6, 1, 0.5});
  Run run;
  run.dry = GENERATE(true, false);
  const Show show = prepare_show(scene, run, {});
  MotionFrame frame = brick_house_frame(scene, 0);
  std::fill(frame.damage.begin(), frame.damage.end(), 0);  // a push releases no joint to contact
  std::fill(frame.opening.begin(), frame.opening.end(), 1e-6F);
  frame.opening[3] = 1e-4F;
  const FrameTexels t = texels_of(show, frame, Coloring::material, Vec3(5, -5, 3));
  CHECK(t.joints[4 * 2] == 0);
  CHECK(t.joints[4 * 3] == (run.dry ? 1 : 0));
  CHECK(t.joints[4 * 3 + 2] == static_cast<float>(run.dry ? render::JointState::cracked : render::JointState::intact));
  CHECK(t.crack_index.empty() == !run.dry);
  std::fill(frame.opening.begin(), frame.opening.end(), 1e-4F);  // some face the camera
  const Camera camera = choose_cameras(show.stage, 1).front();
  std::size_t cracks = 0;
  for (const LineGroup& group : lines_of({run, show, scene, Look{}, camera, false, frame, std::nullopt, {}}))
    cracks += group.name == "cracked joints" ? group.pieces.size() : 0;
  CHECK((cracks > 0) == run.dry);
}

TEST_CASE("the slip of a joint is its motion along its face, while the faces are near", "[render][quantity]") {
  MotionScene scene;
  const int part = share_shape(scene, {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  for (int i = 0; i < 3; ++i) scene.blocks.push_back({"b", "wall", 0, i == 0, {0, 0, 1.0 * i}, {part}});
  const std::vector<Vec3> square{{0, 0, 0.5}, {0.4, 0, 0.5}, {0.4, 0.4, 0.5}, {0, 0.4, 0.5}};
  for (int i = 0; i < 2; ++i) scene.joints.push_back({i, i + 1, square, {0, 0, 1}, 0});
  const double along = GENERATE(0.0, 0.003, 0.2), apart = GENERATE(0.0, 0.001, 0.2), turn = GENERATE(0.0, 0.3);
  MotionFrame f{0, {}, {0, 0}, {0, 0}};
  for (int i = 0; i < 3; ++i) {
    const double x = i == 2 ? along : 0, z = i + (i == 2 ? apart : 0);
    // All turn together about the x axis: that is no slip.
    const Vec3 at = rotation(Vec3(turn, 0, 0)) * Vec3(x, 0, z);
    for (const double v : {at.x(), at.y(), at.z(), std::cos(0.5 * turn), std::sin(0.5 * turn), 0.0, 0.0})
      f.poses.push_back(static_cast<float>(v));
  }
  derive_slips(scene, f);
  const double slip = apart < 0.1 ? along : 0;  // a quarter of the width
  CHECK(f.derived[0] == Approx(0).margin(1e-6));
  CHECK(f.derived[1] == Approx(slip).margin(1e-6));
  CHECK(f.derived[2] == Approx(slip).margin(1e-6));
}
