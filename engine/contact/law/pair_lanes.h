// Touching pairs side by side, in packs of eight or alone. Plain data, compiled once per instruction set (`pair_law.h`). All operations are
// elementwise, so that a pair's numbers do not depend on its neighbours.
#pragma once
#include "engine/contact/overlap/clip.h"
#include "engine/laws/interlock.h"

namespace erbs {

// One number per lane; vectors by component, matrices row by row; in pair axes unless stated otherwise.
using PackArray = double[8];

// Rows of eight numbers, in the layout of `ContactPair`, `ContactBlock` and `PairResult`.
inline constexpr int pair_rows = 7, block_rows = 4, result_rows = 2;

template <int n>
struct alignas(64) PairPackOf {
  using Row = double[n];
  const double *pair[n], *reference[n], *other[n];  // addresses of the input
  Row p[8 * pair_rows], r[8 * block_rows], o[8 * block_rows];
  Row swapped;        // 1 if block b is the reference, else 0
  Row contact_count;  // as in `pair_force()`
  Row rotation[9], shift[3];
  OverlapSums sums[n];
  Row max_depth;  // m
  Row total, area, force[3], moment[3], normal[3], size, pressure_centre[3], centroid[3], second[6], gyration;
  Row linear[3], angular[3];                     // m/s, rad/s, motion of the other body
  Row along, angular_part[3];                    // for `ClipKernels::closing_speeds`
  Row closing_speed;                             // m/s
  Row inverse_mass, chi, limit;                  // of the dashpot
  Row lag, lag_stiffness, lag_keeps, lag_takes;  // N, as in ContactPair; over kn A; shares of the last lag and of the capped dashpot
  Row blow_age;                                  // s, as in ContactPair
  Row damping[4];                                // total and first moment from `ClipKernels::damp`, kn = 1
  // Friction: springs with their slip, dashpots, and the part within the limit.
  Row u0[3], psi0, u1[3], psi1, kt, kr, springs[3], torsion, dashpots[3], dashpot_torsion, lever[3], held, most, radius, share;
  Row holds;  // 1: springs and dashpots are surely within the limit
  Row slips;
  Row result[8 * result_rows];
};
using PairPack = PairPackOf<8>;
using OnePair = PairPackOf<1>;

struct PairSettings {
  double dt, drift;  // s, since the last evaluation; of the last drift, by half of which velocities lag behind poses
  double booked;     // 1: the work of the last wrenches after their kick is booked already, else 0
  double lag_from;   // strength of a blow, over what the step bears, from which a part of it lags
  double falling_mass, memory, reference_speed, settling, settling_tangential;  // as in ContactSettings
  InterlockStep interlock;
  double flat_face, slender;  // `pair.h`
};

// Eight blocks side by side as in State, and their rows as pairs read them.
struct BlockPosePack {
  const PackArray *u, *q, *v, *w;  // m, x y z w, m/s, rad/s, as in State
  PackArray *last_u, *last_q;      // their pose in the last call of `track`
  const double* reach;             // m, distance of each block's farthest point from its centroid
  double *rotation_travel, *spin;  // m, travel of that point by rotation, upper bound; m/s, its speed by rotation
  double *travel, *travel_ahead;   // m, travel with that of the centroid; the same after the next steps
  double* row[8];                  // `ContactBlock`
  const PackArray* axes;           // of the shapes at rest, row by row; null: the world axes
};

// Input of a search: balls side by side, padded by seven; an oriented box as two rows of eight.
struct Balls {
  const double *x, *y, *z, *radius;  // m
};
struct alignas(64) OrientedBox {
  double centre[3], rotation[9], half[3], radius;  // m, by column, m, m: of the enclosing ball
};

struct PairKernels {
  // Pose, motion and travel of the selected blocks; `soon` (s): length of the next steps. `fastest` (m/s): greatest speed so far, by lane.
  void (*track)(const BlockPosePack&, unsigned which, double soon, PackArray& fastest);
  void (*gather_pairs)(PairPack&);                  // reads the rows; sets `rotation` and `shift`
  void (*patch)(PairPack&, const PairSettings&);    // from `sums` to `angular_part`; `total` = 0 for a degenerate patch
  void (*dashpot)(PairPack&, const PairSettings&);  // starts from `closing_speed`
  void (*lagging)(PairPack&);                       // starts from `damping`
  void (*springs)(PairPack&, const PairSettings&);  // as far as `holds`
  // Return map of two packs; sets `holds` to 0 for a pair that it leaves to the caller.
  void (*return_map)(PairPack&, PairPack&);
  void (*finish)(PairPack&, const PairSettings&);  // writes the rows of pairs and results
  void (*write)(const PackArray* rows, int count, double* const to[8]);
  int (*close_balls)(const Balls&, int from, int to, const double one[4], double margin, int* found);
  unsigned (*close_boxes)(const OrientedBox& one, const OrientedBox* const other[8], double margin);
};

const PairKernels& pair_kernels();

namespace sse2 {
extern const PairKernels pair_kernels;
}
namespace avx2 {
extern const PairKernels pair_kernels;
}
namespace avx512 {
extern const PairKernels pair_kernels;
}

}  // namespace erbs
