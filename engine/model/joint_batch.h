// Plain data of joints computed side by side. No Eigen here: files compiled for several instruction sets read it.
#pragma once
#include <cstdint>

namespace erbs {

// solve/event_bound.h
inline constexpr double event_share = 1.0 / 8;
inline constexpr double event_steps = 8;  // an event is met with as many steps to go

inline constexpr int lanes = 8;  // joints or blocks side by side; a multiple of every vector width in use
inline constexpr int most_points_per_joint = 512;

// One number for each of 8 blocks, N times.
template <int N>
struct alignas(64) RowLanes {
  double x[N][lanes];
};

// Eight lanes that take their numbers from lanes of other RowLanes<6>, mostly of one or two. The same numbers whichever way they are read:
// lane by lane, or by permutations of whole records.
struct Crossing {
  int at[lanes];  // where they begin, in doubles: 48 record + lane, and 8 more in the lanes that read the second record
  std::uint8_t first[lanes], who[lanes];  // of each record read: a lane that does, and all of them as bits; who[0] has those of who[1], too
  int records;
};

// Elastic data of 8 joints side by side, valid since the last refresh of their geometry (joint_geometry.h says how).
struct alignas(64) JointBatch {
  double frame[9][lanes];      // columns s, t, n (world) at the refresh; row-major [axis * 3 + component]
  double arm_a[3][lanes];      // m, from the centroids to the joint's material points at the refresh, world
  double arm_b[3][lanes];
  double gap[3][lanes];        // m, relative displacement at the refresh, world
  double turn[3][lanes];       // rad, relative rotation at the refresh, world
  double stiffness[6][lanes];  // zero once the joint is handed over to contact
  double open_limit[lanes];    // m, opening at which tension cracks; 0 for dry joints
  double slip_limit[lanes];    // m, c / ks
  double slip_slope[lanes];    // mu kn / ks: limit of slip = slip_limit - slip_slope * largest opening
  double close_limit[lanes];   // m, closing at which mortar crushes; infinite where it does not
  double half_s[lanes], half_t[lanes], radius[lanes];
  int a[lanes], b[lanes], row_a[lanes], row_b[lanes];
};

}  // namespace erbs
