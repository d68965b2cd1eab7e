// Lines laid over pictures: forces and thrust of a pier on paper, mechanisms, and cameras that move.
#include "render/run/marks.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/base/vec.h"
#include "render/movie/scenery.h"
#include "render/run/framing.h"
#include "tests/support/folder.h"
#include "tests/unit/lua/bench.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;

namespace {

// A dry pier of `count` bricks of 0.3 x 0.2 x 0.1 m and 1,800 kg/m3 on a fixed foot, whose gravity leans by `lean` (rad) towards x.
std::string pier(int count, double lean) {
  return fmt::format(
      "material{{name='brick', density=1800}} joint{{law=dry{{kn=1e10, mu=.9}}}}\n"
      "gravity{{ {}, 0, {} }}\n"
      "box{{name='foot', size={{.3,.2,.1}}, at={{0,0,-.1}}, material='brick', fixed=true}}\n"
      "for i = 0, {} do box{{name='b'..i, size={{.3,.2,.1}}, at={{0,0,.1*i}}, material='brick'}} end\n"
      "analysis{{duration=.002, frame_dt=.001, frame_stress=true}}",
      standard_g * std::sin(lean), -standard_g * std::cos(lean), count - 1);
}

}  // namespace

TEST_CASE("forces of a pier are the weights above, and its thrust leans with gravity", "[render][marks]") {
  const int count = GENERATE(2, 5);
  const double lean = GENERATE(0.0, 0.06);
  erbs::lua::Bench bench;
  REQUIRE(bench.run(pier(count, lean)) == 0);
  const MotionReader reader(bench.out());
  const MotionScene& scene = reader.scene();
  REQUIRE(reader.has_forces());
  const MotionFrame frame = reader.read(0);
  const double weight = 1800 * 0.3 * 0.2 * 0.1 * standard_g;
  const Stage stage = set_stage(scene, {frame});
  const MarkChoice choice{true, true, ""};
  CHECK(largest_force(scene, frame) == Approx(count * weight * std::cos(lean)).epsilon(1e-4));
  const Marks marks = marks_of(choice, scene, stage, frame, frame, {}, {count * weight, 1});
  REQUIRE(marks.legend.size() == 3);
  CHECK(marks.legend[0].name ==
        fmt::format("normal force {:.3g} {}", count * weight / (count * weight >= 1e3 ? 1e3 : 1), count * weight >= 1e3 ? "kN" : "N"));
  std::size_t forces = 0;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const double above = count - std::round(10 * static_cast<double>(frame.force_at[3 * j + 2]));  // bricks on this bed
    const Vec3 at = Eigen::Map<const Eigen::Vector3f>(&frame.force_at[3 * j]).cast<double>();
    CHECK(at.x() == Approx(0.15 + 0.05 * above * std::tan(lean)).margin(2e-5));
    CHECK(at.y() == Approx(0.1).margin(2e-5));
    for (const Stroke& s : marks.strokes)
      if (s.color.z() > s.color.x() && std::fabs(0.5 * (s.from + s.to).z() - at.z()) < 0.01) {
        ++forces;
        CHECK(s.width == Approx(9 * above / count * std::cos(lean)).epsilon(1e-3));
        CHECK((s.to - s.from).norm() == Approx(0.1).epsilon(1e-3));  // from the middle of one brick to that of the next
      }
  }
  CHECK(forces == std::size_t(count));
  CHECK(marks.strokes.size() == std::size_t(2 * count - 1));  // the line of thrust: each brick with two beds
  CHECK(marks.legend[2].name.find("line of thrust") == 0);
  const Marks later = marks_of(choice, scene, stage, frame, frame, {}, {count * weight, 1, true});
  REQUIRE(later.legend.size() == 4);
  CHECK(later.legend[3].name == "none at released joints");
}

TEST_CASE("the thrust of a wall branches to the joints that bear it, and carries all of its weight", "[render][marks]") {
  // Bricks in running bond: each rests on two others, so that no brick lies between two joints alone.
  const int courses = GENERATE(2, 5);
  erbs::lua::Bench bench;
  REQUIRE(bench.run(fmt::format("material{{name='brick', density=1800}} joint{{law=dry{{kn=1e10, mu=.9}}}} gravity(g)\n"
                                "box{{name='foot', size={{1.2,.2,.1}}, at={{0,0,-.1}}, material='brick', fixed=true}}\n"
                                "for i = 0, {} do local odd = i % 2; for k = 0, 4 + odd do\n"
                                "local half = odd == 1 and (k == 0 or k == 5)\n"
                                "local x = half and (k == 0 and .1 or 1) or .1 + .2*k - .1*odd\n"
                                "box{{size={{half and .1 or .2,.2,.1}}, at={{x,0,.1*i}}, material='brick'}} end end\n"
                                "analysis{{duration=.002, frame_dt=.001, frame_stress=true}}",
                                courses - 1)) == 0);
  const MotionReader reader(bench.out());
  const MotionScene& scene = reader.scene();
  const MotionFrame frame = reader.read(0);
  const Stage stage = set_stage(scene, {frame});
  const double scale = largest_force(scene, frame);
  const Marks marks = marks_of({false, true, ""}, scene, stage, frame, frame, {}, {scale, 1});
  REQUIRE_FALSE(marks.strokes.empty());
  // Strokes that cross the level just above the foot carry the weight of the wall.
  double carried = 0;
  for (const Stroke& s : marks.strokes) {
    const double low = std::min(s.from.z(), s.to.z()), high = std::max(s.from.z(), s.to.z());
    CHECK(s.width <= 8 + 1e-9);
    CHECK(low > -0.001);
    CHECK(high < 0.1 * courses + 0.001);
    if (low < 0.005 && high > 0.005) carried += s.width / 8 * scale;
    // Each stroke stays within the width of a brick: it does not jump from one to the next.
    CHECK(std::fabs(s.from.x() - s.to.x()) < 0.2);
  }
  CHECK(carried == Approx(5 * courses * 1800 * 0.2 * 0.2 * 0.1 * standard_g).epsilon(0.03));  // thin strokes are drawn wider
}

TEST_CASE("marks follow magnified blocks, and refuse runs without forces", "[render][marks]") {
  erbs::lua::Bench bench;
  REQUIRE(bench.run(pier(3, 0)) == 0);
  const MotionReader reader(bench.out());
  const MotionScene& scene = reader.scene();
  const MotionFrame frame = reader.read(0);
  MotionFrame drawn = frame;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) drawn.poses[7 * b] += 2;  // all blocks 2 m aside
  const Stage stage = set_stage(scene, {frame});
  const Marks here = marks_of({true, true, ""}, scene, stage, frame, frame, {}, {1e3, 1}),
              there = marks_of({true, true, ""}, scene, stage, frame, drawn, {}, {1e3, 1});
  REQUIRE(here.strokes.size() == there.strokes.size());
  for (std::size_t i = 0; i < here.strokes.size(); ++i) CHECK((there.strokes[i].from - here.strokes[i].from - Vec3(2, 0, 0)).norm() < 1e-6);
  MotionFrame without = frame;
  without.force.clear();
  CHECK_THROWS_WITH(marks_of({true, false, ""}, scene, stage, without, without, {}, {}), Catch::Contains("frame_stress = true"));
}

TEST_CASE("velocities and spins of a mechanism come from two frames, or from a limit analysis", "[render][marks]") {
  const MotionScene scene = brick_house({1.2, 1.2, 4, 1, 0.5});
  MotionFrame before = brick_house_frame(scene, 0), after = before;
  before.t = 1, after.t = 1.5;
  const Vec3 v(0.3, -0.2, 0.1), w = GENERATE(Vec3(0.4, 0, 0), Vec3(-0.2, 0.5, 0.3));
  const Quat turn = rotation(0.5 * w);
  const std::size_t b = scene.blocks.size() - 1;
  for (std::size_t i = 0; i < 3; ++i) after.poses[7 * b + i] += static_cast<float>(0.5 * v[static_cast<int>(i)]);
  after.poses[7 * b + 3] = static_cast<float>(turn.w()), after.poses[7 * b + 4] = static_cast<float>(turn.x());
  after.poses[7 * b + 5] = static_cast<float>(turn.y()), after.poses[7 * b + 6] = static_cast<float>(turn.z());
  const Rates rates = rates_between(before, after);
  CHECK((rates.velocity[b] - v).norm() < 1e-5);
  CHECK((rates.spin[b] - w).norm() < 1e-5);
  CHECK(largest_speed(scene, rates) == Approx(v.norm()).epsilon(1e-4));
  const Marks marks = marks_of({false, false, "motion"}, scene, set_stage(scene, {before}), before, before, rates, {1, v.norm()});
  REQUIRE_FALSE(marks.strokes.empty());
  CHECK((marks.strokes[0].to - marks.strokes[0].from).normalized().dot(v.normalized()) > 0.9999);
  CHECK(marks.legend[0].name.find("m/s") != std::string::npos);

  const test::Folder dir;
  std::ofstream(dir.file("mechanism.csv")) << "block,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s\n"
                                           << scene.blocks[b].name << ",0,0,0,1,2,3,4,5,6\n";
  const Rates read = rates_of_mechanism(dir.path.string(), scene);  // the folder or its file
  CHECK(read.velocity[b] == Vec3(1, 2, 3));
  CHECK(read.spin[b] == Vec3(4, 5, 6));
  std::ofstream(dir.file("mechanism.csv")) << "block,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s\nmoon,0,0,0,1,2,3,4,5,6\n";
  CHECK_THROWS_WITH(rates_of_mechanism(dir.file("mechanism.csv"), scene), Catch::Contains("another scene"));
  std::filesystem::remove(dir.file("mechanism.csv"));
  CHECK_THROWS_WITH(rates_of_mechanism(dir.path.string(), scene),
                    Catch::Contains("mechanism.csv") && Catch::Contains("erbs limit SCENE.lua -o FOLDER"));
}

TEST_CASE("a camera path passes its keyframes and rests at its ends", "[render][camera]") {
  const std::vector<CameraKey> keys = camera_path("0:6,-7,4:0,0,1; 2: 4,-6,1 : .5,0,1;3.5:-4,-6,2:0,.9,.6;");
  REQUIRE(keys.size() == 3);
  for (const CameraKey& key : keys) {
    const Camera camera = along_path({}, keys, key.t);
    CHECK((camera.eye - key.eye).norm() < 1e-12);
    CHECK((camera.target - key.target).norm() < 1e-12);
  }
  CHECK(along_path({}, keys, -1).eye == keys.front().eye);
  CHECK(along_path({}, keys, 9).eye == keys.back().eye);
  double fastest = 0;
  for (double t = 0; t < 3.5; t += 0.01)
    fastest = std::max(fastest, (along_path({}, keys, t + 0.01).eye - along_path({}, keys, t).eye).norm());
  CHECK(fastest < 0.1);  // no jump: 8 m of way in 1.5 s
  CHECK((along_path({}, keys, 0.01).eye - keys.front().eye).norm() < 1e-3);
}

TEST_CASE("a camera follows the blocks it should, and keeps its direction", "[render][camera]") {
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.2, 1.2, 8, 4, 0.1});
  const MotionReader reader(dir.path.string());
  const Excerpt excerpt = without_groups(reader.scene(), {});
  const Run run = read_run(dir.path.string());
  const Stage stage = stage_of(run, reader, excerpt, {});
  const Camera camera = choose_cameras(stage, 16.0 / 9).front();
  const std::string top = reader.scene().blocks.back().name;
  const Shot shot = follow(camera, top, false, reader, excerpt, stage, 1);
  const Vec3 back = camera.eye - camera.target;
  for (const double t : {0.0, 1.0, 3.0}) {
    const Camera now = shot.at(t);
    const MotionFrame frame = frame_at(reader, t);
    const Vec3 at = Eigen::Map<const Eigen::Vector3f>(&frame.poses[frame.poses.size() - 7]).cast<double>();
    CHECK((now.target - at).norm() < 0.35);  // smoothed over a quarter of a second
    CHECK((now.eye - now.target - back).norm() < 1e-9);
  }
  CHECK((follow(camera, top, true, reader, excerpt, stage, 1).camera.eye - shot.camera.target).norm() < back.norm());
  CHECK_THROWS_WITH(follow(camera, "nobody", false, reader, excerpt, stage, 1), Catch::Contains("no group and no block"));
}
