// The State: all that changes. Displacements and rotations are counted from rest, never as absolute positions in the force path,
// so that a scene far from the origin computes the same forces.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/base/cold.h"
#include "engine/laws/crushing.h"
#include "engine/model/block_field.h"
#include "engine/model/joint_batch.h"
#include "engine/model/model.h"
#include "engine/model/pair.h"
#include "engine/model/rest.h"

namespace erbs {

enum class Tier : std::uint8_t { intact, cracked, open };

struct JointMemory {
  double q[6] = {};   // at the last step (cracked joints only)
  double f[6] = {};   // N, N m
  double elastic = 0; // J
};

// Every energy term, in J; names as in metrics.json. State terms are filled when sampled, the others accumulate.
struct Energy {
  double base_work = 0, external_work = 0, tilt_work = 0;
  double kinetic = 0, gravity = 0, elastic = 0;
  double friction = 0, fracture = 0, crushing = 0, damping = 0, contact_damping = 0, reset = 0;
  double sleep = 0;             // kinetic, taken from blocks that fell asleep
  double base_next = 0, external_next = 0, damping_next = 0, absolute_next = 0;  // of the half drift after the sample
  double friction_next = 0, fracture_next = 0, crushing_next = 0;  // lost by laws that a sequential sweep has already moved on
  double start = 0;             // kinetic + gravity + elastic at the first sample
  double elastic_at_start = 0;
  double absolute_work = 0;     // Int |power| of base, external and tilt
  double largest_moving = 0;    // largest kinetic + |elastic change| so far
  double height_flux = 0;       // Int |d gravity|
  // J, what events are measured by: what moved and was lost, and what could have; and the residual: at the ledger's own steps, which the
  // output of a run does not move (event_bound.h)
  double reference = 0, event_residual = 0;
  double residual = 0;          // J, now
  double residual_relative = 0; // now
  double residual_worst = 0;    // largest residual_relative so far
  double largest_jump = 0;      // J, largest change of the residual between two samples
  double largest_jump_time = 0;
  int largest_jump_joint = -1;  // the joint whose own balance was worst in that interval
  bool started = false;
};

struct State {
  long step = 0;
  long start_step = 0;          // since the last change of dt, t = start_t + (step - start_step) dt: no sum of roundings
  double start_t = 0;
  double t = 0;                 // s, of the positions; velocities are half a step behind until the kick
  double dt = 0;                // s, of the next drift
  double last_dt = 0;           // s, of the drift that led here; 0 at the start
  // blocks [nblock + 1]: the last is a block at rest for unused lanes
  BlockVec3 u;                  // m, of the centroid from rest, relative to the ground
  BlockQuat q;                  // rotation from rest
  BlockVec3 v;                  // m/s, at the half step
  BlockVec3 spin_momentum;      // kg m2/s, about the centroid, world axes
  BlockVec3 w;                  // rad/s, world axes, of the last drift
  BlockVec3 base_u;             // pose at the last refresh of the block's island
  BlockQuat base_q;
  std::vector<RowLanes<6>> shift;      // displacement and rotation (joint_geometry.h) since the refresh (m, rad)
  Rows row;                     // the same, 8 doubles a block: one cache line; where some joint is not sound, or reads rows even so
  std::vector<int> island;      // blocks joined to each other, named by their lowest block
  std::vector<std::uint8_t> grounded;  // the island holds a fixed or driven block
  std::vector<std::uint8_t> joined;    // has a joint that is not open
  int unjoined = 0;                    // moving blocks that have none
  std::vector<std::uint8_t> loose;     // may meet new neighbours
  // joints
  std::vector<JointBatch> batch;       // of joints that have cracked (batches.h)
  // lane of each joint: batch * lanes + lane, the batches of sound joints counted first; -1 once it is open [njoint]
  std::vector<int> place;
  std::vector<Tier> tier;              // [njoint]
  Cold<JointMemory> memory;            // [njoint]
  Cold<PointHistory> history;          // [npoint]
  Cold<CrushedFace> crushed;           // empty where no law has a plateau in compression [njoint]
  Rows wrench;                         // rows of 8 doubles: force, moment on a block from one joint end; which: Model::row_a, row_b
  // Sound joints write no rows (joints with dashpots and the other kernels do): force, moment on a block from all those that it keeps, and
  // on the other blocks of those in a batch (KeptLanes), behind which is one of nothing
  std::vector<RowLanes<6>> kept, given;
  std::vector<double> viscous;         // N, N m, resultants of the dashpots of the last step; empty without [6 njoint]
  PairList debris;                     // contacts of loose blocks
  Parting parting;                     // those of their pairs that are apart
  Rest rest;                           // those of them that sleep
  double dt_goal = 0;                  // s, the step the run asks for; dt may be shorter while contacts change
  int calm = 0;                        // steps since contacts last held dt down
  double event_dt = 0;                 // s, the step that what opens and closes next allows (event_bound.h); 0: any
  int joints_broken = 0;
  Energy energy;
  Vec3 gravity_before = Vec3::Zero();  // m/s2, of the last step, and sum of m u then: for the work of tilting
  Vec3 moment_before = Vec3::Zero();   // kg m
  double max_penetration_relative = 0;
  double momentum_residual = 0;
};

}  // namespace erbs
