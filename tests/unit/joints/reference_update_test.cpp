// Joint geometry between reference updates, and at them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/joints/cracked/cracked.h"
#include "engine/joints/intact/intact.h"
#include "engine/joints/kernels.h"
#include "engine/joints/kinematics.h"
#include "engine/model/joint_packs.h"
#include "engine/solve/blocks/integrate.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

const std::string shake_by = "ground_motion{wave=sine{amplitude=0.5*g, frequency=8}, direction={1,0.7,0}} analysis{duration=1, kernel=\"";

// One rigid rotation of 1e-4 rad, the largest before a reference update, plus strains.
void turn_rigidly(const Model& m, State& s, double strain) {
  for (int b = 1; b < m.nblock; ++b) {
    const Vec3 theta = 1e-4 * Vec3(0.6, -0.48, 0.64), arm = m.rest[std::size_t(b)];
    s.pose.q[std::size_t(b)] = rotation(theta + strain * Vec3(std::sin(b), std::cos(b), 1));
    s.pose.u[std::size_t(b)] = rotation(theta) * arm - arm + strain * Vec3(std::cos(3 * b), std::sin(2 * b), 0.3);
    set_pose_row(s, b);
  }
}

}  // namespace

TEST_CASE("carried geometry answers as exact geometry within the tolerance of a refresh", "[solve]") {
  const Scene scene = test::small_wall(shake_by + "fast\"}");
  Prepared run = prepare(scene, false);
  State& s = run.state;
  turn_rigidly(run.model, s, 1e-8);
  ElasticPack o;
  for (int j = 0; j < run.model.njoint; ++j) {
    if (run.model.joint[std::size_t(j)].a == 0) continue;  // the foot does not rotate
    step_kernels().elastic(intact_pack(run.model, s, j / pack_size), s.cache.pose_row.data(), o);
    double q[6];
    joint_gap(run.model, s, j, q);
    for (int i = 0; i < 6; ++i) CHECK(o.gap[i][j % pack_size] == Approx(q[i]).margin(1e-15));
  }
}

TEST_CASE("a rigid turn between refreshes strains no joint", "[solve]") {
  Prepared run = prepare(test::small_wall(shake_by + "fast\"}"), false);
  const Model& m = run.model;
  State& s = run.state;
  turn_rigidly(m, s, 0);
  IntactJoints intact(m, s);
  intact.forces(0, intact.groups(), step_kernels(), nullptr);
  double stiffest = 0;
  for (const auto& type : m.joint_types) stiffest = std::max({stiffest, type->stiffness[0], type->stiffness[2]});
  for (int b = 1; b < m.nblock; ++b) {
    bool on_foot = false;  // which does not rotate
    for (const Joint& joint : m.joint) on_foot = on_foot || (joint.a == 0 && joint.b == b);
    if (!on_foot) CHECK(joint_wrench(m, s, b).lpNorm<Eigen::Infinity>() < 1e-15 * stiffest);
  }
}

TEST_CASE("cracked joints see their blocks exactly, however far these have turned", "[solve][cracked]") {
  Prepared run = prepare(test::small_wall(shake_by + "fast\"}", "dry{kn=1e10, mu=0.5}"), false);
  const Model& m = run.model;
  State& s = run.state;
  const double apart = GENERATE(1e-9, 0.1, 0.13, 0.7);  // rad; beyond .126 a series no longer converges
  for (int j = 0; j < m.njoint; ++j) s.joints.stage[std::size_t(j)] = JointStage::cracked;
  for (int b = 1; b < m.nblock; ++b) {
    const Vec3 theta(0.9, -0.8, 0.4), arm = m.rest[std::size_t(b)];
    s.pose.q[std::size_t(b)] = rotation(theta) * rotation(apart * Vec3(std::sin(b), std::cos(b), 1));
    if (b % 3 == 0) s.pose.q[std::size_t(b)] = Quat(-Quat(s.pose.q[std::size_t(b)]).coeffs());  // the same orientation
    s.pose.u[std::size_t(b)] = rotation(theta) * arm - arm + 1e-6 * Vec3(std::cos(3 * b), std::sin(2 * b), 0.3);
  }
  for (const StepKernels* kernels : {&step_kernels(), &sse2::kernels}) {
    Cracked cracked(m, s);
    JointSums sums;
    cracked.forces(0, cracked.groups(), true, 0.0, sums, *kernels);
    cracked.store();
    for (int j = 0; j < m.njoint; ++j) {
      double q[6];
      joint_gap(m, s, j, q);
      for (int i = 0; i < 6; ++i) CHECK(s.joints.memory[std::size_t(j)].gap[i] == Approx(q[i]).margin(2e-15));
    }
  }
}

TEST_CASE("a refresh by whole batches gives what all joints anew would", "[solve]") {
  Prepared run = prepare(test::small_wall(shake_by + "fast\"}"), false);
  const Model& m = run.model;
  State& s = run.state;
  IntactJoints intact(m, s);
  std::vector<std::uint8_t> outdated(s.pose.u.size(), 0);
  for (int b = 1; b < m.nblock; b += 2) {
    s.pose.q[std::size_t(b)] = rotation(1e-3 * Vec3(std::sin(b), std::cos(b), 1));
    s.pose.u[std::size_t(b)] = 1e-3 * Vec3(std::cos(3 * b), std::sin(2 * b), 0.3);
    set_reference(s, b);
    outdated[std::size_t(b)] = 1;
  }
  State all = s;
  intact.update_reference(outdated);
  update_all_references(m, all);
  IntactJoints anew(m, all);
  intact.forces(0, intact.groups(), step_kernels(), nullptr);
  anew.forces(0, anew.groups(), step_kernels(), nullptr);
  double largest_wrench = 0;
  for (int b = 0; b < m.nblock; ++b) {
    CHECK(joint_wrench(m, s, b) == joint_wrench(m, all, b));
    largest_wrench = std::max(largest_wrench, joint_wrench(m, s, b).lpNorm<Eigen::Infinity>());
  }
  CHECK(largest_wrench > 0);
}

TEST_CASE("sound joints that have been looked at once are passed by only where they hold", "[solve]") {
  Prepared run = prepare(test::small_wall(shake_by + "fast\"} gravity(g)", "dry{kn=1e10, mu=0.5}"), false);
  const Model& m = run.model;  // overhanging corners would fall, so it runs only until its joints are under load
  {
    Solver solver(m, run.state, run.range, 1);
    solver.advance_until([&] { return run.state.time.t >= 4e-4; });
    update_all_references(run.model, run.state);
  }
  const State rest = run.state;
  State s = rest;
  IntactJoints intact(m, s);
  const auto sway = [&](double size, int phase) {
    for (int b = 1; b < m.nblock; ++b)
      for (int i = 0; i < 6; ++i) s.cache.increment[std::size_t(b / pack_size)].x[i][b % pack_size] = size * std::sin(7.0 * b + i + phase);
  };
  std::vector<JointSums> sums(std::size_t(intact.groups()));
  sway(1e-6, 0);
  intact.forces({0, intact.groups()}, false, sums);
  int cracked = 0, before = 0, now = 0;
  for (int phase = 0; phase < 60; ++phase) {
    s = rest;
    sway(std::pow(10.0, -10 + 0.05 * phase), phase);
    State other = s;
    IntactJoints anew(m, other);
    now += intact.forces(0, intact.groups(), step_kernels(), nullptr), before += anew.forces(0, anew.groups(), step_kernels(), nullptr);
    intact.forces({0, intact.groups()}, false, sums), anew.forces({0, anew.groups()}, false, sums);
    REQUIRE(s.joints.stage == other.joints.stage);
    cracked += int(std::count(s.joints.stage.begin(), s.joints.stage.end(), JointStage::cracked));
  }
  CHECK(cracked > 0);
  CHECK(now < before);
}
