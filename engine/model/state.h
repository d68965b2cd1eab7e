// The State: all data that change. Displacements and rotations are relative to rest; the force path uses no absolute positions. A scene far
// from the origin therefore computes the same forces.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/base/system/memory.h"
#include "engine/laws/crushing.h"
#include "engine/model/block_arrays.h"
#include "engine/model/contact_pair.h"
#include "engine/model/joint_pack.h"
#include "engine/model/model.h"
#include "engine/model/sleep_state.h"

namespace erbs {

enum class JointStage : std::uint8_t { intact, cracked, contact };

struct JointMemory {
  double gap[6] = {};        // at the last step (cracked joints only)
  double resultant[6] = {};  // N, N m
  double elastic = 0;        // J
  double own[5] = {};        // history that only the joint's law knows (laws/face.h)
};

// All energy terms, in J; names as in metrics.json. Terms of the present state are filled at a sample, the others accumulate.
struct Energy {
  double base_work = 0, external_work = 0, tilt_work = 0;
  double kinetic = 0, gravity = 0, elastic = 0;
  double friction = 0, fracture = 0, crushing = 0, damping = 0, contact_damping = 0, reset = 0;
  double sleep = 0;                                                              // kinetic energy removed from blocks that fell asleep
  double base_next = 0, external_next = 0, damping_next = 0, absolute_next = 0;  // of the half drift after the sample
  double friction_next = 0, fracture_next = 0, crushing_next = 0;  // losses of laws that a sequential sweep has already advanced
  double start = 0;                                                // kinetic + gravity + elastic at the first sample
  double elastic_at_start = 0;
  double absolute_work = 0;   // Int |power| of base, external and tilt
  double largest_moving = 0;  // largest kinetic + |elastic change| so far
  double height_flux = 0;     // Int |d gravity|
  // J, reference energy of event errors, and the residual (event_bound.h). The reference is the largest sum of energy in motion and losses.
  // It is at least the work of lifting all blocks by a thousandth of the structure's height. Both are updated at the ledger's own steps,
  // which do not depend on the output of a run.
  double reference = 0, event_residual = 0;
  double residual = 0;           // J, now
  double residual_relative = 0;  // now
  double residual_worst = 0;     // largest residual_relative so far
  double largest_jump = 0;       // J, largest change of the residual between two samples
  double largest_jump_time = 0;
  int largest_jump_joint = -1;  // the joint with the worst balance of its own in that interval
  bool started = false;
};

// Time, and the length of the step.
struct TimeStep {
  long step = 0;
  long start_step = 0;  // since the last change of dt: t = start_t + (step - start_step) dt, without a sum of roundings
  double start_t = 0;
  double t = 0;                 // s, of the positions; velocities lag half a step until the kick
  double dt = 0;                // s, of the next drift
  double last_dt = 0;           // s, of the drift that led here; 0 at the start
  double dt_target = 0;         // s, target step of the run; dt may be shorter while contacts change
  int steps_since_limited = 0;  // steps since contacts last limited dt
  double event_dt = 0;          // s, step allowed by the next openings and closings (event_bound.h); 0: any
  long bonds_due = 0;           // step at which bonds are next asked whether they are about to break
  // Levels (model/levels.h): all interactions act at the start of a macro step of `substeps` steps, of which `substep` is the next.
  long macro = 0;  // macro steps before this one
  int substep = 0, substeps = 1, last_substeps = 1, next_substeps = 1;
  double next_dt = 0;                 // s, of the steps of the next macro step
  double fast_dt = 0, slow_dt = 0;    // s, that fast and loose blocks bear; 0: the blocks are not divided
  double slow_event_dt = 0;           // s, step of loose blocks allowed by the next openings and closings of slow pairs; 0: any
  int macro_steps_since_limited = 0;  // macro steps since slow pairs last limited them; below 0: to wait
};

// Arrays of blocks are [nblock + 1]; the last is a block at rest, for unused lanes.
struct BlockPoses {
  BlockVec3 u;  // m, displacement of the centroid from rest, relative to the ground
  BlockQuat q;  // rotation from rest
};

struct MotionState {
  BlockVec3 v;              // m/s, at the half step
  BlockVec3 spin_momentum;  // kg m2/s, about the centroid, world axes
  BlockVec3 w;              // rad/s, world axes, of the last drift
};

// Which blocks are joined to each other.
struct Topology {
  std::vector<int> island;             // group of blocks joined to each other, named by its lowest block
  std::vector<std::uint8_t> grounded;  // the island has a joint to a fixed block, or a driven block
  std::vector<std::uint8_t> joined;    // the block has a joint that is not released
  int unjoined = 0;                    // number of moving blocks without such a joint
  std::vector<std::uint8_t> loose;     // the block may meet new neighbours
};

// Stiffness of a joint now over that of the intact joint, across its faces and along them.
struct StiffnessShare {
  double n = 1, s = 1;
};

struct JointState {
  std::vector<JointPack> pack;  // batches of cracked joints (joint_packs.h)
  // lane of each joint: batch * lanes + lane, counting the batches of intact joints first; -1 once released to contact [njoint]
  std::vector<int> slot;
  std::vector<JointStage> stage;      // [njoint]
  LazyArray<JointMemory> memory;      // [njoint]
  LazyArray<PointHistory> history;    // [npoint]
  LazyArray<CrushedFace> crushed;     // [njoint]; empty if no law yields in compression
  std::vector<StiffnessShare> share;  // of the intact stiffness that is left (joints/cracked/fading.h) [njoint]; empty where no law fades
  std::vector<double> viscous;        // N, N m, dashpot resultants of the last step [6 njoint]; empty without dashpots
};

struct ContactState {
  PairList list;               // contact pairs of loose blocks
  SeparationState separation;  // those of them that are separated
};

// Poses and forces in the layouts of the joint kernels.
struct KernelCache {
  BlockVec3 ref_u;  // reference pose: the pose at its last update
  BlockQuat ref_q;
  double lazy_rotation = 0;              // rad, of a block until it is updated again; 0: as the model says (Solver::refine_references)
  std::vector<VectorPack<6>> increment;  // m, rad, increment of displacement and rotation since that update (kinematics.h)
  Rows pose_row;                         // the same as one cache line of 8 doubles per block, for kernels that read rows
  Rows wrench;  // rows of 8 doubles: force, moment on a block from one joint end (Model::wrench_row_a, wrench_row_b)
  // Intact joints write no rows, except with dashpots and in the other kernels. `owner_sum`: force, moment on each block from all joints
  // that it owns. `neighbour_force`: force, moment on the other block of each joint of a batch (OwnerSchedule), then one record of zeros.
  std::vector<VectorPack<6>> owner_sum, neighbour_force;
};

// Gravity turned by a tilt, in the last step; the change since gives the work of tilting.
struct TiltedGravity {
  Vec3 gravity_before = Vec3::Zero();  // m/s2
  Vec3 moment_before = Vec3::Zero();   // kg m, sum of m u
};

// Results observed during the run; no force depends on them.
struct Observed {
  int joints_broken = 0;
  double max_penetration_relative = 0;
  double momentum_residual = 0;
};

struct State {
  TimeStep time;
  BlockPoses pose;
  MotionState motion;
  Topology topology;
  JointState joints;
  ContactState contacts;
  SleepState sleep;
  KernelCache cache;
  Energy energy;
  TiltedGravity tilt;
  Observed observed;
};

inline StiffnessShare stiffness_share(const State& state, int joint) {
  return state.joints.share.empty() ? StiffnessShare{} : state.joints.share[std::size_t(joint)];
}

}  // namespace erbs
