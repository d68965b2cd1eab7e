#include "engine/study/timing.h"

#include <algorithm>
#include <vector>

#include "engine/base/count.h"
#include "engine/base/hash.h"
#include "engine/joints/kinematics.h"
#include "engine/model/joint_packs.h"
#include "engine/solve/step.h"
#include "engine/study/machine.h"

namespace erbs::study {
namespace {

constexpr int stretches = 7;
constexpr long hash_steps = 128;

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

std::uint64_t hash_of(const State& s) {
  std::uint64_t value = fnv1a("");
  for (std::size_t b = 0; b < s.pose.u.size(); ++b) {
    const Vec3 u = s.pose.u[b], v = s.motion.v[b];
    value = fnv1a({reinterpret_cast<const char*>(u.data()), sizeof u}, value);
    value = fnv1a({reinterpret_cast<const char*>(v.data()), sizeof v}, value);
  }
  return value;
}

}  // namespace

void run_in(const Model& m, State& state, const StepRange& range, int threads) {
  Solver solver(m, state, range, threads);
  const long end = state.time.step + hash_steps;
  solver.advance_until([&] { return state.time.step >= end; });
}

Timing time_steps(const Model& model, State state, const StepRange& range, const std::string& kernel, int threads, double seconds) {
  Model m = model;
  m.analysis.kernel = kernel;
  Timing out;
  Solver solver(m, state, range, threads);
  long next = hash_steps;
  const auto run_to = [&](long step) {
    next = step;
    solver.advance_until([&] { return state.time.step >= next; });
  };
  // Every 32nd step (128th with contacts) settles the ledger and calls stop(). The timed stretches are whole multiples of that.
  const double first = processor_seconds(), first_wall = wall_seconds();
  run_to(state.time.step + hash_steps);
  out.hash = hash_of(state);
  const double each = std::max({1e-7, processor_seconds() - first, wall_seconds() - first_wall}) / hash_steps;
  const long length = std::max(128L, long(seconds / stretches / each) / 128 * 128);
  std::vector<double> user, wall;
  const double t0 = state.time.t;
  const long touched = solver.contacts().sums().touched();
  for (int i = 0; i < stretches; ++i) {
    const double user0 = processor_seconds(), wall0 = wall_seconds();
    const long before = state.time.step;
    run_to(before + length);
    const double steps = double(state.time.step - before);
    user.push_back((processor_seconds() - user0) / steps);
    wall.push_back((wall_seconds() - wall0) / steps);
    out.steps += state.time.step - before;
  }
  out.user = median(user);
  out.wall = median(wall);
  out.touching = double(solver.contacts().sums().touched() - touched) / double(out.steps);
  out.dt = (state.time.t - t0) / double(out.steps);
  return out;
}

Timing time_course(const Model& model, State state, const StepRange& range, int threads, double until) {
  Timing out;
  Solver solver(model, state, range, threads);
  const double t0 = state.time.t, user = processor_seconds(), wall = wall_seconds();
  const long first = state.time.step;
  const auto run_while = [&](const auto& more) { solver.advance_until([&] { return !more(); }); };
  run_while([&] { return state.time.step < first + hash_steps; });
  out.hash = hash_of(state);
  run_while([&] { return state.time.t < until; });
  out.steps = state.time.step - first;
  out.user = (processor_seconds() - user) / double(out.steps);
  out.wall = (wall_seconds() - wall) / double(out.steps);
  out.touching = double(solver.contacts().sums().touched()) / double(out.steps);
  out.dt = (state.time.t - t0) / double(out.steps);
  return out;
}

double instructions_over_bare(const Model& model, const State& state, const StepRange& range) {
  const InstructionCounter counter;
  if (!counter.works()) return 0;
  Model m = model;
  m.analysis.kernel = "fast";
  m.analysis.ledger = m.analysis.debris = false;
  m.grounds.clear();
  m.force_loads.clear();
  m.prescribed_motions.clear();
  m.tilts.clear();
  m.damping.mass = 0;
  constexpr long steps = 2000;
  State stepped = state, bare = state;
  Solver solver(m, stepped, range, 1);
  const double before = counter.read();
  solver.advance_until([&] { return stepped.time.step >= state.time.step + steps; });
  const double between = counter.read();
  const double each = (between - before) / double(stepped.time.step - state.time.step);
  IntactJoints intact(m, bare);
  const std::vector<BlockConstants> constants = block_constants(m, bare);
  std::vector<BlockSums> sums(1);
  const Excitation e{Vec3::Zero(), m.gravity, bare.time.dt};
  bare.time.last_dt = bare.time.dt;
  const double start = counter.read();
  for (long k = 0; k < steps; ++k) {
    intact.forces(0, intact.groups(), step_kernels(), nullptr);
    advance(m, bare, constants, e, {}, {0, int(constants.size())}, false, sums);
  }
  return each / ((counter.read() - start) / double(steps));
}

State all_broken(const Model& m, State s) {
  for (int j = 0; j < m.njoint; ++j) {
    s.joints.stage[z(j)] = JointStage::cracked;
    JointMemory& memory = s.joints.memory[z(j)];
    joint_gap(m, s, j, memory.gap);
    memory.elastic = 0;
    for (int i = 0; i < 6; ++i) {
      memory.resultant[i] = m.joint[z(j)].type->stiffness[i] * memory.gap[i];
      memory.elastic += 0.5 * memory.resultant[i] * memory.gap[i];
    }
  }
  for (PointHistory& h : s.joints.history) h.damage = 1;
  return s;
}

Demand demand(const Model& m) {
  // Multiplications and additions of intact_kernel.h and lanes_blocks.inc, counted line by line. A cross product has 9, a dot product 5, a
  // symmetric matrix times a vector 15; a subtraction counts as an addition. Signs, roots, comparisons and selections are left out.
  // A joint: `intact_forces` 177, `limits_bound` 22, adding the forces on both blocks 12. An undamped block with one round of
  // `middle_spin`: `kick` 175, `rotate_by` 93.
  constexpr double joint_flop = 177 + 22 + 12, block_flop = 175 + 93, six = 48;
  const double joints = m.njoint, blocks = m.nblock;
  Demand out;
  out.flop = joint_flop * joints + block_flop * blocks;
  const double pack = double(sizeof(IntactPack) + sizeof(GatherTable)) / pack_size, constants = double(sizeof(BlockConstants)) / pack_size;
  // Joint: its data; the increment of its other block read; the force on that block written and read again.
  // Block: constants and motion; its increment written and read; the force on it written and read.
  out.bytes = joints * (pack + 3 * six) + blocks * (constants + 8.0 * (7 + 2 * 16) + 2 * six + 2 * six);
  return out;
}

}  // namespace erbs::study
