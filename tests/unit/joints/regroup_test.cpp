// Lanes of cracked joints, ordered anew while joints leave (engine/joints/cracked/regroup.cpp).
#include <catch2/catch.hpp>

#include "engine/joints/cracked/cracked.h"
#include "engine/joints/kinematics.h"
#include "engine/model/joint_packs.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

const char* const oblique_shake = "ground_motion{wave=sine{amplitude=0.5*g, frequency=8}, direction={1,0.7,0}} analysis{duration=1}";

// All joints of a small wall, cracked. Its blocks are moved by hand.
struct CrackedWall {
  Prepared run;
  State state;
  Cracked cracked;
  JointSums sums;

  static State all_cracked(State s) {
    std::fill(s.joints.stage.begin(), s.joints.stage.end(), JointStage::cracked);
    return s;
  }
  explicit CrackedWall(const std::string& law)
      : run(prepare(test::small_wall(oblique_shake, law), false)), state(all_cracked(run.state)), cracked(run.model, state) {}

  void step(int n) {
    state.time.step = n;
    for (int b = 1; b < run.model.nblock; ++b) {
      const auto moved = [&](int i) { return std::sin(0.2 * n + 1.7 * b + i) + (i == 2 ? -0.3 : 0) + 0.02 * n * std::cos(b + i); };
      state.pose.u[std::size_t(b)] = 2e-6 * Vec3(moved(0), moved(1), moved(2));
      state.pose.q[std::size_t(b)] = rotation(6e-6 * Vec3(moved(3), moved(4), moved(5)));
      cracked.copy_pose(b);
    }
    cracked.forces(0, cracked.groups(), true, 0.0, sums);
  }
  void drop(int every, int from) {
    for (int j = from; j < run.model.njoint; j += every) state.joints.stage[std::size_t(j)] = JointStage::contact, cracked.drop(j);
  }
  int used_packs() const {
    std::vector<int> packs;
    for (const int slot : state.joints.slot)
      if (slot >= 0) packs.push_back(slot / pack_size);
    std::sort(packs.begin(), packs.end());
    return int(std::unique(packs.begin(), packs.end()) - packs.begin());
  }
};

// Of the wrenches of all joints, in N and N m.
double difference(const CrackedWall& a, const CrackedWall& b, double& largest) {
  double worst = 0;
  for (std::size_t k = 0; k < 16 * std::size_t(a.run.model.njoint); ++k) {
    if (k % 8 > 5) continue;
    largest = std::max(largest, std::fabs(a.state.cache.wrench[k]));
    worst = std::max(worst, std::fabs(a.state.cache.wrench[k] - b.state.cache.wrench[k]));
  }
  return worst;
}

}  // namespace

TEST_CASE("joints that change their lanes answer as before, to the bit, in fewer packs", "[joints][cracked]") {
  const char* law = GENERATE("mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, Gf1=1e3, Gf2=1e3}", "dry{kn=1e10, mu=0.5}");
  CrackedWall stays(law), moves(law);
  for (int n = 0; n < 60; ++n) {
    stays.step(n), moves.step(n);
    double largest = 0;
    REQUIRE(difference(stays, moves, largest) == 0);
    REQUIRE(largest > 0);
    if (n != 20 && n != 40) continue;
    for (CrackedWall* wall : {&stays, &moves}) wall->drop(n == 20 ? 2 : 4, n == 20 ? 0 : 1);
    moves.cracked.regroup();
    CHECK(moves.used_packs() < stays.used_packs());
    CHECK(moves.cracked.groups() == int(moves.state.joints.pack.size()));
    const std::vector<int> slots = moves.state.joints.slot;
    moves.cracked.regroup();
    CHECK(slots == moves.state.joints.slot);  // nothing is left to do
    moves.cracked.store();
    Cracked resumed(moves.run.model, moves.state);
    CHECK(slots == moves.state.joints.slot);
  }
  CHECK(moves.sums.energy.friction == Approx(stays.sums.energy.friction).epsilon(1e-12));
  CHECK(moves.sums.energy.elastic == Approx(stays.sums.energy.elastic).epsilon(1e-12));
}

TEST_CASE("joints without a bond leave the packs of those with one", "[joints][cracked]") {
  const char* law = "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, Gf1=0.15, Gf2=0.2}";
  CrackedWall stays(law), moves(law);
  double largest = 0;
  for (int n = 0; n < 60; ++n) {
    stays.step(n), moves.step(n);
    REQUIRE(difference(stays, moves, largest) <= 1e-12 * largest);
    if (n % 5 == 0) moves.cracked.regroup();
  }
  moves.cracked.regroup();
  int bonded = 0, debonded = 0;
  for (int p = 0; p < int(moves.state.joints.pack.size()); ++p) {
    int here = 0, without = 0;
    for (int j = 0; j < moves.run.model.njoint; ++j) {
      if (moves.state.joints.slot[std::size_t(j)] / pack_size != intact_packs(moves.run.model) + p) continue;
      ++here, without += moves.cracked.debonded(j);
    }
    CHECK((without == 0 || without == here));
    debonded += without, bonded += here - without;
  }
  CHECK(bonded > 0);
  CHECK(debonded > 0);
}
