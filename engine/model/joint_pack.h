// Plain data of joints that are evaluated eight at a time. No Eigen here: files compiled for several instruction sets include it.
#pragma once
#include <cstdint>

namespace erbs {

// Constants of the error estimate of openings and closings, joints/event_bound.h.
inline constexpr double event_share = 1.0 / 8;
inline constexpr double event_steps = 8;  // steps in which the time until an event is divided

inline constexpr int pack_size = 8;  // joints or blocks per pack; a multiple of every vector width in use
inline constexpr int most_points_per_joint = 512;

// One number for each of 8 blocks, N times.
template <int N>
struct alignas(64) VectorPack {
  double x[N][pack_size];
};

// Gather table of eight lanes. Each lane reads the six numbers of a lane in another VectorPack<6> record; most tables need one or two
// records. Reading lane by lane and permuting whole records give the same numbers.
struct GatherTable {
  int at[pack_size];  // source of each lane, in doubles: 48 record + lane, plus 8 in lanes that read the second record
  std::uint8_t first[pack_size], who[pack_size];  // per record: one lane that reads it, and all such lanes as bits; who[0] includes who[1]
  int records;
};

// Elastic data of a pack of 8 joints, valid since the last update of their reference (kinematics.h gives the formulas).
struct alignas(64) JointPack {
  double frame[9][pack_size];  // columns s, t, n (world) at the update; row-major [axis * 3 + component]
  double arm_a[3][pack_size];  // m, from the centroids to the joint's material points at the update, world
  double arm_b[3][pack_size];
  double gap[3][pack_size];        // m, relative displacement at the update, world
  double rotation[3][pack_size];   // rad, relative rotation at the update, world
  double stiffness[6][pack_size];  // zero once the joint is released to contact
  double open_limit[pack_size];    // m, opening at which the joint cracks in tension; 0 for dry joints
  double slip_limit[pack_size];    // m, c / ks
  double slip_slope[pack_size];    // mu kn / ks: limit of slip = slip_limit - slip_slope * largest opening
  double close_limit[pack_size];   // m, closing at which the mortar crushes; infinite without a plateau
  double half_s[pack_size], half_t[pack_size], radius[pack_size];
  int a[pack_size], b[pack_size], wrench_row_a[pack_size], wrench_row_b[pack_size];
};

}  // namespace erbs
