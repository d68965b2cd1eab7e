// Cracked joints whose cells form a grid are integrated by strips (engine/joints/cracked/strips.h). They answer as the plain kernel does.
#include <catch2/catch.hpp>
#include <random>

#include "engine/joints/cracked/cracked.h"
#include "engine/joints/kinematics.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

const char* const shake_with_weight = "ground_motion{wave=sine{amplitude=0.5*g, frequency=8}} gravity(g) analysis{duration=1}";

// Poses of all blocks along a random path: they drift past their limits and tremble there, by a length that changes. Every third block
// turns about one horizontal axis, and every third about the other; a millionth about both, lest two points are deepest at once.
struct RandomPath {
  std::mt19937 random;
  std::vector<Vec3> u, turn;
  double tremble = 0;
  RandomPath(int blocks, unsigned seed) : random(seed), u(std::size_t(blocks), Vec3::Zero()), turn(u) {}
  Vec3 any(double length) {
    std::uniform_real_distribution<double> in(-length, length);
    return Vec3(in(random), in(random), in(random));
  }
  void step(int n) {
    if (n % 40 == 0) tremble = std::pow(10.0, -11 + 4.0 * double(random()) / double(std::mt19937::max()));
    const bool drifts = n % 40 < 5;
    for (std::size_t b = 1; b < u.size(); ++b) {
      u[b] += any(drifts ? 4e-7 : tremble) - (drifts ? Vec3(0, 0, 1e-8) : Vec3::Zero());
      turn[b] +=
          any(drifts ? 2e-6 : 5 * tremble).cwiseProduct(b % 3 == 0 ? Vec3(1, 1, 1) : Vec3(b % 3 == 1 ? 1 : 1e-6, b % 3 == 2 ? 1 : 1e-6, 0));
    }
  }
  void put(State& s, Cracked& cracked) const {
    for (std::size_t b = 1; b < u.size(); ++b) s.pose.u[b] = u[b], s.pose.q[b] = rotation(turn[b]), cracked.copy_pose(int(b));
  }
};

}  // namespace

TEST_CASE("joints integrated by strips answer as one by one on random paths", "[joints][cracked]") {
  const char* softening = GENERATE("coupling=\"coulomb\"", "coupling=\"linear\"", "fc=300*kPa", "Gf1=0, Gf2=0");
  const char* rule = GENERATE("rule=\"simpson\", points={3,3}", "rule=\"trapezoid\", points={2,2}", "rule=\"midpoint\", points={4,4}",
                              "rule=\"simpson\", points={5,5}", "rule=\"simpson\", points={5,3}", "rule=\"gauss\", points={2,2}",
                              "rule=\"trapezoid\", points={2,2}, pressure=\"points\"", "pressure=\"points\"");
  if (std::string(rule).find("pressure") != std::string::npos && std::string(softening).find("fc") != std::string::npos) return;
  const std::string energies = std::string(softening).find("Gf1") == std::string::npos ? "Gf1=0.3, Gf2=0.5, " : "";
  const std::string law =
      "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, mu_residual=0.5, " + energies + softening + "}, " + rule;
  const Prepared run = prepare(test::small_wall(shake_with_weight, law), false);
  const Model& m = run.model;
  State packs = run.state;
  std::fill(packs.joints.stage.begin(), packs.joints.stage.end(), JointStage::cracked);
  packs.time.last_dt = 1e-5;
  State plain = packs;
  Cracked cracked(m, packs);
  RandomPath path(m.nblock, 5);
  JointSums sums, one;
  double largest = 0, worst = 0;
  for (int n = 0; n < 600; ++n) {
    INFO(law << " step " << n);
    packs.time.step = plain.time.step = n;
    path.step(n);
    path.put(packs, cracked);
    plain.pose = packs.pose;
    cracked.forces(0, cracked.groups(), true, 0.0, sums);
    cracked.store();
    for (int j = 0; j < m.njoint; ++j) {
      double gap[6], resultant[6];
      joint_gap(m, plain, j, gap);
      joint_by_points(m, plain, j, gap, resultant, one);
      for (int i = 0; i < 6; ++i) {
        const double scale = i < 3 ? 1 : 1 / m.joint[std::size_t(j)].type->radius, f = scale * resultant[i];
        largest = std::max(largest, std::fabs(f));
        worst = std::max(worst, std::fabs(f - scale * packs.joints.memory[std::size_t(j)].resultant[i]));
      }
      REQUIRE(packs.joints.memory[std::size_t(j)].elastic ==
              Approx(plain.joints.memory[std::size_t(j)].elastic).epsilon(1e-9).margin(1e-15));
    }
    REQUIRE(worst <= 1e-11 * largest);
    for (int i = 0; i < m.npoint; ++i)
      REQUIRE(packs.joints.history[std::size_t(i)].damage == Approx(plain.joints.history[std::size_t(i)].damage).margin(1e-10));
  }
  CHECK(sums.energy.friction == Approx(one.energy.friction).epsilon(1e-9));
  CHECK(sums.energy.fracture == Approx(one.energy.fracture).epsilon(1e-9));
  CHECK(sums.energy.crushing == Approx(one.energy.crushing).epsilon(1e-9).margin(1e-15));
  CHECK(sums.energy.friction > 0);
  CHECK(sums.energy.fracture > 0);
}
