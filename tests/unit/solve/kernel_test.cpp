#include <catch2/catch.hpp>
#include <set>

#include "engine/joints/cracked/cracked.h"
#include "engine/joints/intact/intact.h"
#include "engine/joints/kernels.h"
#include "engine/joints/kinematics.h"
#include "engine/model/joint_packs.h"
#include "engine/record/folder/checkpoint.h"
#include "engine/solve/blocks/integrate.h"
#include "engine/solve/energy.h"
#include "tests/support/small_wall.h"

using namespace erbs;
using namespace erbs::analysis;
using namespace erbs::lua;

namespace {

const std::string shake = "ground_motion{wave=sine{amplitude=0.5*g, frequency=8}, direction={1,0.7,0}} analysis{duration=1, kernel=\"";

double largest_difference(const State& a, const State& b) {
  double out = 0;
  for (std::size_t i = 0; i < a.pose.u.size(); ++i) out = std::max(out, (a.pose.u[i] - b.pose.u[i]).norm());
  return out;
}

double largest(const State& a) {
  double out = 0;
  for (std::size_t i = 0; i < a.pose.u.size(); ++i) out = std::max(out, a.pose.u[i].norm());
  return out;
}

}  // namespace

TEST_CASE("the fast kernel moves an intact wall as the reference does", "[solve]") {
  const std::string strong = "mortar{E=1e9, thickness=10*mm, ft=5*MPa, c=8*MPa, mu=0.6}";
  Prepared fast, finer, plain;
  test::run_to(test::small_wall(shake + "fast\"}", strong), 1, 0.05, fast);
  test::run_to(test::small_wall(shake + "fast\", lazy_rotation=1e-9}", strong), 1, 0.05, finer);
  test::run_to(test::small_wall(shake + "reference\"}", strong), 1, 0.05, plain);
  REQUIRE(fast.state.time.step == plain.state.time.step);
  CHECK(largest(fast.state) > 1e-8);
  INFO("carried " << largest_difference(fast.state, plain.state) / largest(plain.state) << " fresh "
                  << largest_difference(finer.state, plain.state) / largest(plain.state));
  // The increment since the last reference update causes an error of (1e-5)^2 of a static force, relative to small motions.
  CHECK(largest_difference(fast.state, plain.state) / largest(plain.state) < 1e-9);
  CHECK(largest_difference(finer.state, plain.state) / largest(plain.state) < 1e-13);
}

TEST_CASE("a state may go from one kernel to the other", "[solve]") {
  const Scene scene = test::small_wall(shake + "fast\"}", "mortar{E=1e9, thickness=10*mm, ft=5*MPa, c=8*MPa, mu=0.6}");
  Prepared fast, changed;
  test::run_to(scene, 1, 1e-9, fast);
  test::run_to(scene, 1, 1e-9, changed);
  const auto go = [](Prepared& run, const char* kernel, long steps) {
    run.model.analysis.kernel = kernel;
    Solver solver(run.model, run.state, run.range, 1);
    const long end = run.state.time.step + steps;
    solver.advance_until([&] { return run.state.time.step >= end; });
  };
  go(fast, "fast", 960);
  for (const char* kernel : {"fast", "reference", "fast"}) go(changed, kernel, 320);
  REQUIRE(changed.state.time.step == fast.state.time.step);
  CHECK(largest(fast.state) > 1e-8);
  CHECK(largest_difference(fast.state, changed.state) / largest(fast.state) < 1e-8);
}

TEST_CASE("threads do not change a bit, cracks and contacts included", "[solve]") {
  const Scene scene = test::small_wall("ground_motion{wave=sine{amplitude=3*g, frequency=6}, direction=\"y\"} analysis{duration=1}");
  Prepared one, two, three;
  test::run_to(scene, 1, 0.25, one);
  test::run_to(scene, 2, 0.25, two);
  test::run_to(scene, 3, 0.25, three);
  const auto cracked =
      std::count_if(one.state.joints.stage.begin(), one.state.joints.stage.end(), [](JointStage t) { return t != JointStage::intact; });
  const auto opened = std::count(one.state.joints.stage.begin(), one.state.joints.stage.end(), JointStage::contact);
  CHECK(cracked > 10);
  CHECK(opened > 0);
  CHECK(state_hash(one.state) == state_hash(two.state));
  CHECK(state_hash(one.state) == state_hash(three.state));
}

// Block displacements set by hand: some 1e-6 m and rad.
void sway(const Model& m, State& s) {
  for (std::size_t b = 0; b < std::size_t(m.nblock); ++b)
    for (std::size_t i = 0; i < 6; ++i)
      s.cache.increment[b / pack_size].x[i][b % pack_size] = s.cache.pose_row[8 * b + i] = 1e-6 * std::sin(double(8 * b + i));
}

void add_lanes(const std::vector<VectorPack<6>>& sums, std::vector<double>& out) {
  for (const VectorPack<6>& one : sums)
    for (const auto& row : one.x) out.insert(out.end(), std::begin(row), std::end(row));
}

TEST_CASE("instruction sets give the same bits", "[solve]") {
  const Scene scene = test::small_wall(shake + "fast\"} damping{mass=3}");
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  sway(run.model, run.state);
  const auto answer = [&](const StepKernels& kernels) {
    State s = run.state;
    // Swaying blocks beside others with high angular velocity, each with its own number of iterations.
    for (std::size_t b = 0; b < s.pose.u.size(); ++b) s.motion.spin_momentum[b] = std::pow(30.0, double(b % 4)) * Vec3(1e-3, -2e-3, 3e-3);
    ElasticPack o{};
    kernels.elastic(intact_pack(run.model, s, 0), s.cache.pose_row.data(), o);
    std::vector<double> out(&o.gap[0][0], &o.gap[0][0] + 6 * pack_size);
    alignas(64) double stored[pack_size] = {};
    IntactJoints intact(run.model, s);
    intact.forces(0, intact.groups(), kernels, stored);
    out.insert(out.end(), stored, stored + pack_size);
    BlockWork work{};
    const std::vector<BlockConstants> constants = block_constants(run.model, s);
    Rows poses;
    poses.assign(s.cache.pose_row.size(), 0.0);
    const BlockArrays arrays{constants.data(),
                             s.pose.u.data(),
                             s.motion.v.data(),
                             s.motion.spin_momentum.data(),
                             s.motion.w.data(),
                             s.pose.q.data(),
                             s.cache.ref_u.data(),
                             s.cache.ref_q.data(),
                             s.cache.pose_row.data(),
                             poses.data(),
                             s.cache.increment.data(),
                             s.cache.owner_sum.data(),
                             s.cache.neighbour_force.data(),
                             run.model.owner_schedule.gather_in.data(),
                             s.cache.wrench.data(),
                             nullptr,
                             nullptr};
    const KickDrift step{1e-5, 1e-5, 5e-6, 5e-6, 0, 0, 3, -3e-5, -1.5e-5, 0.3, {0.1, 0, 0}, {0, 0, -9.81}, false, false, true, true, true};
    for (const bool sample : {false, true}) kernels.advance(step, arrays, 0, int(constants.size()), sample, work);
    for (std::size_t i = 0; i < s.cache.wrench.size(); ++i)
      if (i % 8 < 6) out.push_back(s.cache.wrench[i]);
    for (std::size_t i = 0; i < s.cache.pose_row.size(); ++i) {
      if (i % 8 < 6) out.push_back(s.cache.pose_row[i]);
      if (i % 8 < 7) out.push_back(poses[i]);
    }
    for (const auto* sums : {&s.cache.increment, &s.cache.owner_sum, &s.cache.neighbour_force}) add_lanes(*sums, out);
    for (std::size_t b = 0; b < s.pose.u.size(); ++b)
      for (int i = 0; i < 3; ++i) out.insert(out.end(), {s.motion.v[b][i], s.motion.w[b][i], s.motion.spin_momentum[b][i]});
    for (const auto* sum :
         {work.base, work.damping, work.absolute, work.base_after, work.damping_after, work.absolute_after, work.kinetic, work.height})
      out.insert(out.end(), sum, sum + pack_size);
    return out;
  };
  CHECK(answer(sse2::kernels) == answer(step_kernels()));
}

TEST_CASE("every end of a joint has a row of its own, and blocks share out the joints they keep", "[solve]") {
  const Prepared run = prepare(test::small_wall(shake + "fast\"}"), false);
  const Model& m = run.model;
  std::vector<int> ends(std::size_t(m.spare_wrench_row()), 0), owned(std::size_t(m.nblock), 0);
  for (int j = 0; j < m.njoint; ++j) {
    ++ends[std::size_t(m.wrench_row_a[std::size_t(j)])], ++ends[std::size_t(m.wrench_row_b[std::size_t(j)])];
    ++owned[std::size_t(m.owner(j))];
  }
  CHECK(*std::max_element(ends.begin(), ends.end()) == 1);
  std::vector<int> of_block(ends.size(), 0);
  for (int b = 0; b < m.nblock; ++b) m.each_wrench_row(b, [&](int row) { ++of_block[std::size_t(row)]; });
  CHECK(*std::max_element(of_block.begin(), of_block.end()) == 1);
  for (int j = 0; j < m.njoint; ++j) {
    bool found = false;
    m.each_wrench_row(m.joint[std::size_t(j)].a, [&](int row) { found = found || row == m.wrench_row_a[std::size_t(j)]; });
    CHECK(found);
  }
  // Rounds of eight joints each, with one spare round for every block group.
  int rounds = 0;
  for (std::size_t g = 0; g + 1 < m.first_wrench_slot.size(); ++g) {
    int most = 0;
    for (int b = int(g) * pack_size; b < std::min(int(g + 1) * pack_size, m.nblock); ++b) most = std::max(most, owned[std::size_t(b)]);
    rounds += most;
  }
  CHECK(rounds <= m.njoint / pack_size + int(m.first_wrench_slot.size()));
}

TEST_CASE("what crosses over between lanes comes from the joint's other block and goes there", "[solve]") {
  const Prepared run = prepare(test::small_wall(shake + "fast\"}"), false);
  const Model& m = run.model;
  const OwnerSchedule& schedule = m.owner_schedule;
  const auto place = [](int lane) { return lane / pack_size * 6 * pack_size + lane % pack_size; };
  std::vector<std::multiset<int>> gathered(std::size_t(m.nblock)), ends(std::size_t(m.nblock));
  for (int j = 0; j < m.njoint; ++j) {
    const Joint& joint = m.joint[std::size_t(j)];
    const int lane = schedule.lane[std::size_t(j)], k = lane / pack_size, g = m.owner(j) / pack_size,
              other = joint.owned_by_b ? joint.a : joint.b;
    CHECK(schedule.joint[std::size_t(lane)] == j);
    CHECK(lane % pack_size == m.owner(j) % pack_size);
    CHECK((schedule.first_pack[std::size_t(g)] <= k && k < schedule.first_pack[std::size_t(g) + 1]));
    CHECK((schedule.other[std::size_t(k)].at[lane % pack_size] & ~pack_size) == place(other));
    ends[std::size_t(other)].insert(place(lane));
  }
  const int none = place(int(schedule.joint.size()));
  for (int b = 0; b < m.nblock; ++b) {
    const std::size_t g = std::size_t(b / pack_size);
    for (int k = schedule.first_gather[g]; k < schedule.first_gather[g + 1]; ++k)
      if (const int at = schedule.gather_in[std::size_t(k)].at[b % pack_size] & ~pack_size; at != none) gathered[std::size_t(b)].insert(at);
    if (m.kind[std::size_t(b)] == Kind::moving) CHECK(gathered[std::size_t(b)] == ends[std::size_t(b)]);
    const int *first = &schedule.end[std::size_t(schedule.first_end[std::size_t(b)])], *last = first + int(ends[std::size_t(b)].size());
    CHECK(std::multiset<int>(first, last) == ends[std::size_t(b)]);
  }
}

TEST_CASE("sound joints in one pass answer as step by step", "[solve]") {
  const Scene scene = test::small_wall(shake + "fast\"}");
  Prepared run = prepare(scene, false);
  start_at_rest(scene, run, 1);
  State& s = run.state;
  sway(run.model, s);
  State one_by_one = s;
  IntactJoints intact(run.model, s);
  intact.forces(0, intact.groups(), step_kernels(), nullptr);
  for (int k = 0; k < intact_packs(run.model); ++k) {
    ElasticPack o;
    const JointPack pack = intact_pack(run.model, s, k);
    step_kernels().elastic(pack, s.cache.pose_row.data(), o);
    step_kernels().wrenches(pack, o, one_by_one.cache.wrench.data());
  }
  double largest_wrench = 0, worst = 0;
  for (int b = 0; b < run.model.nblock; ++b) {
    const Vec6 of_rows = joint_wrench(run.model, one_by_one, b);
    largest_wrench = std::max(largest_wrench, of_rows.lpNorm<Eigen::Infinity>());
    worst = std::max(worst, (of_rows - joint_wrench(run.model, s, b)).lpNorm<Eigen::Infinity>());
  }
  CHECK(largest_wrench > 0);
  CHECK(worst < 1e-11 * largest_wrench);  // both are accurate to second order at rotations of 1e-6
}

TEST_CASE("a joint that leaves its lane leaves the others as they are", "[solve]") {
  Prepared run = prepare(test::small_wall(shake + "fast\"}"), false);
  State& s = run.state;
  sway(run.model, s);
  const auto answer = [&](IntactJoints& intact) {
    intact.forces(0, intact.groups(), step_kernels(), nullptr);
    std::vector<double> out;
    add_lanes(s.cache.owner_sum, out), add_lanes(s.cache.neighbour_force, out);
    return out;
  };
  IntactJoints intact(run.model, s);
  const std::vector<double> whole = answer(intact);
  for (const int j : {3, 9}) s.joints.slot[std::size_t(j)] = -1, intact.leave(j);
  IntactJoints fresh(run.model, s);
  const std::vector<double> left = answer(intact);
  CHECK(left == answer(fresh));
  CHECK(left != whole);
}

TEST_CASE("cracked joints side by side answer as one by one, with the same bits however many", "[solve]") {
  // Laws of every kind, with points driven through softening, slip, closing and reopening.
  const std::string law =
      GENERATE("mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6}", "dry{kn=1e10, mu=0.5}",
               "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, mu_residual=0.4, Gf1=1, Gf2=5}",
               "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, Gf1=1, coupling=\"ellipse\"}",
               "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, Gf2=5, coupling=\"linear\"}",
               "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, Gf1=1, Gf2=2, fc=200*kPa}",
               "mortar{E=1e9, thickness=10*mm, ft=50*kPa, c=80*kPa, mu=0.6, Gf1=1, Gf2=2, fc=100*kPa, uc_ultimate=4e-6}");
  Prepared run = prepare(test::small_wall(shake + "fast\"} damping{stiffness=2e-6}", law), false);
  const Model& m = run.model;
  run.state.time.last_dt = 1e-5;  // for the dashpots
  for (int j = 0; j < m.njoint; ++j) run.state.joints.stage[std::size_t(j)] = JointStage::cracked;
  State plain = run.state, narrow = run.state;
  Cracked cracked(m, run.state), in_pairs(m, narrow);
  JointSums all, lone, pairs;
  for (int step = 0; step < 60; ++step) {
    for (int b = 1; b < m.nblock; ++b) {  // blocks are moved by hand with amplitudes beyond every limit
      const auto moved = [&](int i) { return std::sin(0.2 * step + 1.7 * b + i) + (i == 2 ? -0.3 : 0) + 0.02 * step * std::cos(b + i); };
      const Vec3 u = 2e-6 * Vec3(moved(0), moved(1), moved(2)), theta = 6e-6 * Vec3(moved(3), moved(4), moved(5));
      for (State* s : {&run.state, &narrow, &plain}) s->pose.u[std::size_t(b)] = u, s->pose.q[std::size_t(b)] = rotation(theta);
      cracked.copy_pose(b), in_pairs.copy_pose(b);
    }
    cracked.forces(0, cracked.groups(), true, 0.0, all);
    in_pairs.forces(0, in_pairs.groups(), true, 0.0, pairs, sse2::kernels);
    bool same = true;
    for (std::size_t i = 0; i < 16 * std::size_t(m.njoint); ++i)
      same = same && (i % 8 > 5 || run.state.cache.wrench[i] == narrow.cache.wrench[i]);
    REQUIRE(same);
    for (int j = 0; j < m.njoint; ++j) {
      double q[6], f[6];
      joint_gap(m, plain, j, q);
      joint_by_points(m, plain, j, q, f, lone);
    }
    cracked.store();
    double largest_force = 0, worst = 0, largest_drag = 0, worst_drag = 0;
    for (int j = 0; j < m.njoint; ++j)
      for (int i = 0; i < 6; ++i) {
        const double scale = i < 3 ? 1 : 1 / m.joint[std::size_t(j)].type->radius, f = plain.joints.memory[std::size_t(j)].resultant[i];
        largest_force = std::max(largest_force, scale * std::fabs(f));
        worst = std::max(worst, scale * std::fabs(f - run.state.joints.memory[std::size_t(j)].resultant[i]));
        const double drag = plain.joints.viscous[std::size_t(6 * j + i)];
        largest_drag = std::max(largest_drag, scale * std::fabs(drag));
        worst_drag = std::max(worst_drag, scale * std::fabs(drag - run.state.joints.viscous[std::size_t(6 * j + i)]));
      }
    INFO(law << " step " << step);
    REQUIRE(worst <= 1e-11 * largest_force);
    REQUIRE(worst_drag <= 1e-10 * largest_drag);  // differences of two responses
    for (int i = 0; i < m.npoint; ++i)
      REQUIRE(run.state.joints.history[std::size_t(i)].damage == Approx(plain.joints.history[std::size_t(i)].damage).margin(1e-10));
  }
  CHECK(all.energy.friction > 0);
  CHECK(all.energy.friction == pairs.energy.friction);
  CHECK(all.energy.fracture == pairs.energy.fracture);
  CHECK(all.energy.damping == pairs.energy.damping);
  CHECK(all.energy.friction == Approx(lone.energy.friction).epsilon(1e-10));
  CHECK(all.energy.fracture == Approx(lone.energy.fracture).epsilon(1e-9).margin(1e-12));
  CHECK(all.energy.crushing == Approx(lone.energy.crushing).epsilon(1e-10));
  CHECK(all.energy.damping > 0);
  CHECK(all.energy.damping == Approx(lone.energy.damping).epsilon(1e-9));
}

TEST_CASE("the ledger closes, and a spoiled term opens it", "[solve][energy]") {
  Prepared run;
  test::run_to(test::small_wall("ground_motion{wave=sine{amplitude=1.5*g, frequency=6}, direction=\"y\"} analysis{duration=1}"), 2, 0.2,
               run);
  Energy e = run.state.energy;
  CHECK(e.fracture > 0);
  CHECK(e.friction >= 0);
  CHECK(e.residual_worst < 1e-3);
  Energy spoiled = e;
  spoiled.base_work *= 0.9;
  settle(spoiled, 0, run.state.time.t, -1);
  CHECK(spoiled.residual_relative > 1e-3);
}

TEST_CASE("round-off of a stressed structure at rest without gravity is no residual", "[solve]") {
  Energy e;
  e.elastic = 1;
  settle(e, 1e-300, 0, -1);
  e.elastic = 1 + 2.2e-16;
  settle(e, 1e-300, 1e-3, -1);
  CHECK(e.residual_relative < 1e-6);
  e.elastic = 1 + 1e-6;  // a real error is still found
  settle(e, 1e-300, 2e-3, -1);
  CHECK(e.residual_relative > 0.5);
}

TEST_CASE("what a joint bears in the step in which it cracks acts on both its blocks", "[solve]") {
  Prepared run;
  test::run_to(test::small_wall(shake + "fast\"}", "mortar{E=1e9, thickness=10*mm, ft=5*MPa, c=8*MPa, mu=0.6}"), 1, 0.02, run);
  State& s = run.state;
  const auto gathers = [&] {
    int out = 0;
    for (const BlockConstants& c : block_constants(run.model, s)) out += c.gathers;
    return out;
  };
  const int intact = gathers();
  REQUIRE(intact > 0);
  // Constants may be rebuilt between crack and drift, if neighbouring joints are released to contact.
  std::fill(s.joints.stage.begin(), s.joints.stage.end(), JointStage::cracked);
  CHECK(gathers() == intact);
  for (auto& neighbour_force : s.cache.neighbour_force) neighbour_force = {};
  CHECK(gathers() == 0);
}
