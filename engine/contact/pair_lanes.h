// Eight touching pairs as a pack: from overlap to forces, as `contact.cpp` does for one pair. Plain data, compiled once per instruction set
// (`pair_lanes.inc`). All operations are elementwise, so that a pair's numbers do not depend on its neighbours.
#pragma once
#include "engine/contact/clip.h"

namespace erbs {

// One number per lane; vectors by component, matrices row by row; in pair axes unless stated otherwise.
using Lane = double[8];

// Rows of eight numbers, in the layout of Pair, `ContactBlock` and `PairResult`.
inline constexpr int pair_rows = 7, block_rows = 4, result_rows = 2;

struct alignas(64) PairLanes {
  const double *pair[8], *reference[8], *other[8];  // addresses of the input
  Lane p[8 * pair_rows], r[8 * block_rows], o[8 * block_rows];
  Lane swapped;  // 1 if block b is the reference, else 0
  Lane crowd;    // as in `pair_force()`
  Lane turn[9], shift[3];
  OverlapSums sums[8];
  Lane deepest;  // m
  Lane total, area, force[3], moment[3], normal[3], size, pressure_centre[3], centroid[3], second[6], gyration;
  Lane linear[3], angular[3];     // m/s, rad/s, motion of the other body
  Lane along, turning[3];         // for `ClipKernels::approach`
  Lane closing;                   // m/s
  Lane inverse_mass, chi, limit;  // of the dashpot
  Lane damping[4];                // total and first moment from `ClipKernels::damp`, kn = 1
  // Friction: springs with their slip, dashpots, and the part within the limit.
  Lane u0[3], psi0, u1[3], psi1, kt, kr, springs[3], torsion, dashpots[3], dashpot_torsion, lever[3], most, radius, share;
  Lane holds;  // 1: springs and dashpots are surely within the limit
  Lane slips;
  Lane result[8 * result_rows];
};

struct PairSettings {
  double dt, memory, reference_speed, settling, settling_tangential, surely_within, slow, rate, slender, flat_face;
};

// Eight blocks side by side as in State, and their rows as pairs read them.
struct BlockLanes {
  const Lane *u, *q, *v, *w;  // m, x y z w, m/s, rad/s, as in State
  Lane *last_u, *last_q;      // their pose in the last call of `follow`
  const double* reach;        // m, distance of each block's farthest point from its centroid
  double *spun, *spin;        // m, travel of that point by rotation, upper bound; m/s, its speed by rotation
  double *way, *way_soon;     // m, travel with that of the centroid; the same after the next steps
  double* row[8];             // `ContactBlock`
  const Lane* axes;           // of the shapes at rest, row by row; null: the world axes
};

// Input of a search: balls side by side, padded by seven; an oriented box as two rows of eight.
struct Balls {
  const double *x, *y, *z, *radius;  // m
};
struct alignas(64) OrientedBox {
  double centre[3], turn[9], half[3], radius;  // m, by column, m, m: of the enclosing ball
};

struct PairKernels {
  // Pose, motion and travel of the selected blocks; `soon` (s): length of the next steps. `fastest` (m/s): greatest speed so far, by lane.
  void (*follow)(const BlockLanes&, unsigned which, double soon, Lane& fastest);
  void (*place)(PairLanes&);                         // reads the rows; sets `turn` and `shift`
  void (*patch)(PairLanes&, const PairSettings&);    // from `sums` to `turning`; `total` = 0 for a degenerate patch
  void (*dashpot)(PairLanes&, const PairSettings&);  // starts from `closing`
  void (*springs)(PairLanes&, const PairSettings&);  // as far as `holds`
  // Return map of two packs; sets `holds` to 0 for a pair that it leaves to the caller.
  void (*bear)(PairLanes&, PairLanes&);
  void (*finish)(PairLanes&, const PairSettings&);  // writes the rows of pairs and results
  void (*write)(const Lane* rows, int count, double* const to[8]);
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
