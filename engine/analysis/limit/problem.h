// The limit problem of a block structure: equilibrium of every moving block under constant loads and a multiple of the pushing load, with
// forces at contact points that press and rub but do not pull (Livesley 1978, Int. J. Numer. Meth. Engng 12, 1853).
//
//   sum of contact forces + lambda * push + constant = 0         of each block, forces and moments about its centroid
//   n >= -tension,   |s| <= cohesion + mu n                      at each contact point, s in the plane of the joint
//
// The corners of the overlap polygon represent its whole face exactly where there is no bond: a pressure and the friction it admits at any
// point of a convex polygon is equal to pressures and frictions at its corners, with the same resultant. A bond is shared out to the
// contact points of the run with their areas.
#pragma once
#include <string>
#include <vector>

#include "engine/base/sparse.h"
#include "engine/model/model.h"

namespace erbs::analysis {

// Load at the multiplier 1 on one block.
struct BlockLoad {
  int block = 0;
  Vec3 force = Vec3::Zero();   // N
  Vec3 moment = Vec3::Zero();  // N m, about the centroid
};

// What is multiplied: an acceleration of 1 g on every moving block along `direction`, or a pattern of forces.
struct LimitLoad {
  Vec3 direction = Vec3::UnitX();  // unit length
  std::vector<BlockLoad> pattern;  // empty: proportional to mass
  // The acceleration comes of turning gravity by atan(lambda) to the side of `direction`, which is normal to it.
  bool tilt = false;
};

struct ContactPoint {
  int joint = 0;
  Vec3 at = Vec3::Zero();            // m, world
  double tension = 0, cohesion = 0;  // N; cohesion >= mu tension
  double mu = 0;
  int body[2] = {-1, -1};             // blocks a and b of the joint; -1: part of the ground
  Eigen::Matrix<double, 6, 3> on[2];  // force on each, scaled rows, by (n, s, t); only the first rows and columns in a plane problem
};

// All in scaled units: forces over `force` (N), moments over force * `length` (m).
struct LimitProblem {
  int nbody = 0;    // moving blocks
  int rows = 6;     // of each: 6, or 3 in a plane problem (two forces and the moment about `across`)
  int columns = 3;  // of each contact: n, s, t; n, s in a plane problem
  bool plane = false;
  Vec3 axes[3];                        // plane problem: along the push, up, across; else x, y, z
  double force = 1, length = 1;        // N, m
  std::vector<int> block_of, body_of;  // body -> block and back; -1: not a moving block
  std::vector<ContactPoint> contacts;  // in joint order
  VecX constant, push;                 // scaled    [nbody * rows]
};

// Limits of the force at a contact point: n >= -tension, |s| <= cohesion + slope n. Scaled.
struct Strength {
  double tension = 0, cohesion = 0, slope = 0;
};

// Statically admissible forces, a mechanism, and the multipliers that each of them proves.
struct LimitSolution {
  bool converged = false;
  double statical = 0;        // of forces in equilibrium that the joints bear: a lower bound
  double kinematic = 0;       // of the mechanism: an upper bound
  double out_of_balance = 0;  // largest residual of equilibrium, over the mean weight of a block
  int iterations = 0;
  std::vector<Vec3> force;  // n, s, t on block b at each contact point, scaled
  VecX rates;               // of the bodies, scaled; the pushing load has the power 1
};

struct LimitModelling {
  bool no_tension = false;  // drops the bond of mortar
  double factor = 1;        // of all constant loads but gravity, and of the bond
};

// Throws Error for a direction of zero length, for a structure that nothing moves in, and for a part that no joint leads to the ground
// from, by the names of its blocks.
LimitProblem limit_problem(const Model& model, const LimitLoad& load, const LimitModelling& modelling);

// World vectors of a body from the rows of a scaled vector: force (N) and moment (N m), or velocity (m/s) and spin (rad/s).
struct Twist {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};
Twist velocity_of(const LimitProblem& problem, const VecX& rates, int body);

}  // namespace erbs::analysis
