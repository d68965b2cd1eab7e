// Plain data of joints that are evaluated eight at a time. No Eigen here: files compiled for several instruction sets include it.
#pragma once
#include <cstdint>

namespace erbs {

// Constants of the error estimate of openings and closings, solve/event_bound.h.
inline constexpr double event_share = 1.0 / 8;
inline constexpr double event_steps = 8;  // steps in which the time until an event is divided

inline constexpr int lanes = 8;  // joints or blocks per pack; a multiple of every vector width in use
inline constexpr int most_points_per_joint = 512;

// One number for each of 8 blocks, N times.
template <int N>
struct alignas(64) RowLanes {
  double x[N][lanes];
};

// Gather table of eight lanes. Each lane reads the six numbers of a lane in another RowLanes<6> record; most tables need one or two
// records. Reading lane by lane and permuting whole records give the same numbers.
struct Crossing {
  int at[lanes];                          // source of each lane, in doubles: 48 record + lane, plus 8 in lanes that read the second record
  std::uint8_t first[lanes], who[lanes];  // per record: one lane that reads it, and all such lanes as bits; who[0] includes who[1]
  int records;
};

// Elastic data of a pack of 8 joints, valid since the last update of their reference (joint_geometry.h gives the formulas).
struct alignas(64) JointBatch {
  double frame[9][lanes];  // columns s, t, n (world) at the update; row-major [axis * 3 + component]
  double arm_a[3][lanes];  // m, from the centroids to the joint's material points at the update, world
  double arm_b[3][lanes];
  double gap[3][lanes];        // m, relative displacement at the update, world
  double turn[3][lanes];       // rad, relative rotation at the update, world
  double stiffness[6][lanes];  // zero once the joint is released to contact
  double open_limit[lanes];    // m, opening at which the joint cracks in tension; 0 for dry joints
  double slip_limit[lanes];    // m, c / ks
  double slip_slope[lanes];    // mu kn / ks: limit of slip = slip_limit - slip_slope * largest opening
  double close_limit[lanes];   // m, closing at which the mortar crushes; infinite without a plateau
  double half_s[lanes], half_t[lanes], radius[lanes];
  int a[lanes], b[lanes], row_a[lanes], row_b[lanes];
};

}  // namespace erbs
