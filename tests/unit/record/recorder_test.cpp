#include "engine/record/recorders/recorder.h"

#include <catch2/catch.hpp>

#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

Recorder recorder(const std::string& name, const std::string& quantity, std::vector<std::string> blocks, const std::string& axis = "x") {
  Recorder r;
  r.name = name, r.quantity = quantity, r.blocks = std::move(blocks), r.axis = axis;
  return r;
}

std::vector<MovingBlock> moving;  // motion of the blocks in a snapshot

Snapshot snapshot_of(const test::TwoBricks& t) {
  Snapshot s{.model = t.model, .pose = t.state.pose, .joints = t.state.joints, .energy = t.state.energy};
  s.t = 0.5;
  moving.assign(3, {});
  s.motion = [](std::size_t b) { return moving[b]; };
  return s;
}

// One row of the only recorder, without its time.
std::vector<double> row(test::TwoBricks& t, const Snapshot& s, const Recorder& r) {
  t.scene.recorders = {r};
  Recorders recorders(t.scene, t.model);
  auto values = recorders.sample(s);
  CHECK(values.size() == recorders.columns().size());
  values.erase(values.begin());
  return values;
}

}  // namespace

TEST_CASE("columns carry name, axis, frame and unit; the ground is written where it moves", "[record][recorder]") {
  auto t = test::two_bricks();
  t.model.grounds.resize(1);
  t.scene.recorders = {recorder("floor3", "displacement", {"top"}, "xz"), recorder("floor3", "acceleration", {"top"}),
                       recorder("floor3", "rotation", {"top"}, "y"), recorder("base", "reaction", {}), recorder("bed", "opening", {"top"})};
  t.scene.recorders[1].frame = "abs";
  Recorders recorders(t.scene, t.model);
  CHECK(recorders.columns() == std::vector<std::string>{"time_s", "ground_ax_m_s2", "ground_ay_m_s2", "ground_az_m_s2", "floor3_ux_rel_m",
                                                        "floor3_uz_rel_m", "floor3_ax_abs_m_s2", "floor3_ry_rad", "base_fx_N",
                                                        "bed_opening_m"});
  CHECK(recorders.needs().block_wrench);
  CHECK_FALSE(recorders.needs().joint_force);
  CHECK_FALSE(recorders.needs().load_wrench);
}

TEST_CASE("gravity is written where it tilts", "[record][recorder]") {
  auto t = test::two_bricks();
  CHECK(Recorders(t.scene, t.model).columns() == std::vector<std::string>{"time_s"});
  t.model.tilts.resize(1);
  Recorders recorders(t.scene, t.model);
  CHECK(recorders.columns() == std::vector<std::string>{"time_s", "gravity_ax_m_s2", "gravity_ay_m_s2", "gravity_az_m_s2"});
  Snapshot s = snapshot_of(t);
  s.gravity = Vec3(1, 2, -9);
  CHECK(recorders.sample(s) == std::vector<double>{0.5, 1, 2, -9});
}

TEST_CASE("displacement is averaged, of a material point, relative or absolute", "[record][recorder]") {
  auto t = test::two_bricks();
  t.state.pose.u[1] = Vec3(1, 0, 0);
  t.state.pose.u[2] = Vec3(2, 0, 0);
  Snapshot s = snapshot_of(t);
  s.ground_u = Vec3(10, 0, 0);
  CHECK(row(t, s, recorder("a", "displacement", {"top", "stray"})) == std::vector<double>{1.5});
  Recorder r = recorder("a", "displacement", {"top"}, "xyz");
  r.frame = "abs";
  CHECK(row(t, s, r) == std::vector<double>{11, 0, 0});
  r.frame = "rel";
  r.has_point = true;
  r.point = Vec3(0.1, 0, 0.1);  // 0.1 m beside the centroid
  t.state.pose.q[1] = rotation(Vec3(0, 0, pi / 2));
  const auto at = row(t, s, r);
  CHECK(at[0] == Approx(0.9));
  CHECK(at[1] == Approx(0.1));
}

TEST_CASE("a turning point has the velocity and acceleration of its circle", "[record][recorder]") {
  auto t = test::two_bricks();
  Snapshot s = snapshot_of(t);
  moving[1].w = Vec3(0, 0, 3);
  moving[1].alpha = Vec3(0, 0, 5);
  s.ground_a = Vec3(1, 0, 0);
  Recorder r = recorder("a", "velocity", {"top"}, "xy");
  r.has_point = true;
  r.point = Vec3(0.1, 0, 0.1);
  auto v = row(t, s, r);
  CHECK(v[0] == Approx(0).margin(1e-15));
  CHECK(v[1] == Approx(0.3));
  r.quantity = "acceleration", r.frame = "abs";
  v = row(t, s, r);
  CHECK(v[0] == Approx(1 - 0.9));  // centripetal acceleration w^2 r, plus the ground
  CHECK(v[1] == Approx(0.5));
}

TEST_CASE("the reaction without blocks is that of all supports; its moment is about the point", "[record][recorder]") {
  auto t = test::two_bricks();
  Snapshot s = snapshot_of(t);
  std::vector<Vec6> on_blocks(3, Vec6::Zero()), of_loads(3, Vec6::Zero());
  on_blocks[0] << 0, 0, -9.81, 0.5, 0, 0;
  on_blocks[1] << 0, 0, 9.81, 0, 0, 0;
  s.block_wrench = on_blocks;
  CHECK(row(t, s, recorder("base", "reaction", {}, "z")) == std::vector<double>{-9.81});
  Recorder r = recorder("base", "reaction_moment", {}, "xy");
  r.has_point = true;
  r.point = Vec3(-1, 0, 0);
  const auto m = row(t, s, r);
  CHECK(m[0] == Approx(0.5));
  CHECK(m[1] == Approx(9.81));  // (1,0,0) x (0,0,-9.81)
  of_loads[2] << 7, 0, 0, 0, 0, 0;
  s.load_wrench = of_loads;
  CHECK(row(t, s, recorder("push", "load", {})) == std::vector<double>{7});
}

TEST_CASE("a joint shows its largest opening and slip at any rotation", "[record][recorder]") {
  auto t = test::two_bricks();
  // The top brick rocks about its edge x = 0.1, z = 0.05 by 0.1 rad. The far edge opens by 0.2 sin(0.1) along the normal of the lower
  // brick, and by 2 (0.2) sin(0.05) cos(0) along the mean normal.
  const Vec3 edge(0.1, 0, 0.05), arm = t.model.rest[1] - edge;
  t.state.pose.q[1] = rotation(Vec3(0, 0.1, 0));
  t.state.pose.u[1] = t.state.pose.q[1] * arm - arm;
  Snapshot s = snapshot_of(t);
  CHECK(row(t, s, recorder("bed", "opening", {"top"}))[0] == Approx(2 * 0.2 * std::sin(0.05)).epsilon(1e-12));
  CHECK(row(t, s, recorder("bed", "slip", {"top"}))[0] == Approx(0).margin(1e-15));
  // Both blocks rotate together as one rigid body: no opening.
  t.state.pose.q[0] = t.state.pose.q[1];
  t.state.pose.u[0] = Vec3::Zero();
  t.state.pose.u[1] = t.state.pose.q[0] * t.model.rest[1] - t.model.rest[1];
  CHECK(row(t, s, recorder("bed", "opening", {"top"}))[0] == Approx(0).margin(1e-15));
}

TEST_CASE("joint forces are summed with the side asked for", "[record][recorder]") {
  auto t = test::two_bricks();
  Snapshot s = snapshot_of(t);
  s.joint_force = {{3, 4, -20, 0, 0, 0}};
  CHECK(row(t, s, recorder("bed", "normal_force", {"top"}))[0] == -20);
  CHECK(row(t, s, recorder("bed", "shear_force", {"top"}))[0] == Approx(5));
  s.joint_force = {{0, 0, 0, 1, 2, 3}};
  Recorder r = recorder("bed", "joint_moment", {"base"}, "xyz");
  CHECK(row(t, s, r) == std::vector<double>{1, 2, 3});
  r.blocks = {"top"};
  CHECK(row(t, s, r) == std::vector<double>{-1, -2, -3});
}

TEST_CASE("damage is the share of area that has any", "[record][recorder]") {
  auto t = test::two_bricks();
  t.state.joints.stage[0] = JointStage::cracked;
  t.state.joints.history[0].damage = 1;
  const Snapshot s = snapshot_of(t);
  CHECK(row(t, s, recorder("bed", "damage", {"top"}))[0] == Approx(0.25));
  CHECK(row(t, s, recorder("bed", "broken", {"top"}))[0] == 0);
  for (auto& h : t.state.joints.history) h.damage = 1;
  CHECK(row(t, s, recorder("bed", "broken", {"top"}))[0] == 1);
}

TEST_CASE("every mistake in the recorders is told at once", "[record][recorder]") {
  auto t = test::two_bricks();
  t.scene.recorders = {recorder("a", "displacment", {"top"}), recorder("b", "velocity", {"tip"}), recorder("c", "velocity", {}),
                       recorder("d", "velocity", {"top"}, "xw"), recorder("e, f", "velocity", {"top"})};
  t.scene.recorders[0].place = {"wall.lua", 12};
  const auto mistakes = check_recorders(t.scene);
  REQUIRE(mistakes.size() == 5);
  CHECK_THAT(mistakes[0],
             Catch::Contains("wall.lua:12") && Catch::Contains("did you mean \"displacement\"") && Catch::Contains("reaction"));
  CHECK_THAT(mistakes[1], Catch::Contains("did you mean \"top\""));
  CHECK_THAT(mistakes[2], Catch::Contains("of which block"));
  CHECK_THROWS_AS(Recorders(t.scene, t.model), Errors);
  t.scene.recorders = {recorder("a", "velocity", {"top"}), recorder("a", "velocity", {"stray"}), recorder("j", "slip", {"stray"})};
  try {
    Recorders recorders(t.scene, t.model);
    FAIL("two columns of one name, and a joint that is not there");
  } catch (const Errors& errors) {
    REQUIRE(errors.messages.size() == 2);
    CHECK_THAT(errors.messages[0], Catch::Contains("a_vx_rel_m_s"));
    CHECK_THAT(errors.messages[1], Catch::Contains("no joint"));
  }
}

TEST_CASE("momentum is summed over the blocks that move, about a point", "[record][recorder]") {
  auto t = test::two_bricks();
  Snapshot s = snapshot_of(t);
  moving[1].v = Vec3(2, 0, 0), moving[2].v = Vec3(0, 1, 0);  // 1 kg at (0, 0, 0.1), 3 kg at (1, 0, 0)
  moving[1].spin_momentum = Vec3(0, 0, 5), moving[2].spin_momentum = Vec3(7, 0, 0);
  CHECK(row(t, s, recorder("all", "momentum", {}, "xyz")) == std::vector<double>{2, 3, 0});
  CHECK(row(t, s, recorder("all", "angular_momentum", {}, "xyz")) == std::vector<double>{7, 0.2, 5 + 3});
  Recorder r = recorder("one", "angular_momentum", {"stray"}, "z");
  r.has_point = true, r.point = Vec3(3, 0, 0);
  t.state.pose.u[2] = Vec3(-1, 0, 0);
  CHECK(row(t, s, r) == std::vector<double>{3 * -3});
}
