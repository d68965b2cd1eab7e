// What a recorder sees: the run at one instant, everything at the same time t. Filled by the analysis, which alone knows how the
// half steps of the scheme meet.
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// What a snapshot must hold beyond the motion of the blocks; a run pays only for what some recorder asks for.
struct Needs {
  bool block_wrench = false, load_wrench = false, joint_force = false;
};

// Of one block at t, relative to the ground, world axes.
struct MovingBlock {
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();      // m/s, rad/s
  Vec3 a = Vec3::Zero(), alpha = Vec3::Zero();  // m/s2, rad/s2
  Vec3 spin_momentum = Vec3::Zero();            // kg m2/s, about its centroid
};

struct Snapshot {
  const Model& model;
  const State& state;
  double t = 0;                                                                    // s
  std::function<MovingBlock(std::size_t block)> motion = {};                       // worked out where a recorder asks
  Vec3 ground_a = Vec3::Zero(), ground_v = Vec3::Zero(), ground_u = Vec3::Zero();  // m/s2, m/s, m, of the ground
  int contact_points = 0;                                                          // that touch: of joints and of contacts
  // only where needed
  std::vector<Vec6> block_wrench = {};  // N, N m about the centroid: of joints and contacts on each block    [nblock]
  std::vector<Vec6> load_wrench = {};   // N, N m about the centroid: of force, moment and motion loads       [nblock]
  // Resultant (s, t, n: N, then N m about the joint's centre, in the joint's turned frame) on block a of each joint,
  // tension positive; zero once the joint is handed over to contact.                           [njoint]
  std::vector<std::array<double, 6>> joint_force = {};
};

}  // namespace erbs
