// The run as a recorder sees it: all quantities at the same time t. The analysis fills it, since only the analysis knows how to bring the
// half steps of the scheme to one time.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Optional data of a snapshot. A run computes them only if a recorder asks for them.
struct Needs {
  bool block_wrench = false, load_wrench = false, joint_force = false;
};

// Motion of one block at t, relative to the ground, world axes.
struct MovingBlock {
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();      // m/s, rad/s
  Vec3 a = Vec3::Zero(), alpha = Vec3::Zero();  // m/s2, rad/s2
  Vec3 spin_momentum = Vec3::Zero();            // kg m2/s, about its centroid
};

struct Snapshot {
  const Model& model;
  const BlockPoses& pose;
  const JointState& joints;
  const Energy& energy;
  double t = 0;                                                                    // s
  std::function<MovingBlock(std::size_t block)> motion = {};                       // computed on request of a recorder
  Vec3 ground_a = Vec3::Zero(), ground_v = Vec3::Zero(), ground_u = Vec3::Zero();  // m/s2, m/s, m, of the ground
  Vec3 gravity = Vec3::Zero();                                                     // m/s2
  int joints_broken = 0;
  int contact_points = 0;  // of joints, and touching ones of contacts
  // Filled only if a recorder needs them.
  std::span<const Vec6> block_wrench = {};  // N, N m about the centroid: joints and contacts on each block [nblock]
  std::span<const Vec6> load_wrench = {};   // N, N m about the centroid: force, moment and motion loads [nblock]
  // Resultant on block a of each joint, in the joint's rotated frame: s, t, n in N, then N m about the joint's centre. Tension is positive.
  // Zero after release to contact. [njoint]
  std::vector<std::array<double, 6>> joint_force = {};
};

}  // namespace erbs
