// Eight touching pairs side by side: what contact.cpp computes for a pair from its overlap, in lanes. Plain data, compiled once for each
// instruction set (pair_lanes.inc); elementwise, so that a pair's numbers do not depend on its neighbours.
#pragma once
#include "engine/contact/clip.h"

namespace erbs {

// A number of each lane; vectors by component, matrices row by row; axes of the pair where nothing else is said.
using Lane = double[8];

// Rows of eight numbers as they lie in Pair, ContactBlock and PairResult.
inline constexpr int pair_rows = 7, block_rows = 4, result_rows = 2;

struct alignas(64) PairLanes {
  const double *pair[8], *reference[8], *other[8];  // where they are read from
  Lane p[8 * pair_rows], r[8 * block_rows], o[8 * block_rows];
  Lane swapped;  // 1 where the reference is block b, else 0
  Lane crowd;    // as in pair_force()
  Lane turn[9], shift[3];
  OverlapSums sums[8];
  Lane deepest;  // m
  Lane total, area, force[3], moment[3], normal[3], size, pressure_centre[3], centroid[3], second[6], gyration;
  Lane linear[3], angular[3];     // m/s, rad/s, motion of the other body
  Lane along, turning[3];         // for ClipKernels::approach
  Lane closing;                   // m/s
  Lane inverse_mass, chi, limit;  // of the dashpot
  Lane damping[4];                // total and first moment as ClipKernels::damp gives them, kn = 1
  // friction: springs with this slip, dashpots; what of them is borne
  Lane u0[3], psi0, u1[3], psi1, kt, kr, springs[3], torsion, dashpots[3], dashpot_torsion, lever[3], most, radius, share;
  Lane holds;  // 1 where springs and dashpots are borne surely
  Lane slips;
  Lane result[8 * result_rows];
};

struct PairSettings {
  double dt, memory, reference_speed, settling, settling_tangential, surely_within, slow, rate, slender, flat_face;
};

// Eight blocks side by side in State, and the rows by which pairs see them.
struct BlockLanes {
  const Lane *u, *q, *v, *w;  // m, x y z w, m/s, rad/s, as in State
  Lane *last_u, *last_q;      // where they were when they were followed last
  const double* reach;        // m, farthest point of each from its centroid
  double *spun, *spin;        // m, that point's way as the block turned from step to step, at most; m/s, its speed
  double *way, *way_soon;     // m, the same with the way of the centroid; with what the next steps may add
  double* row[8];             // ContactBlock
  const Lane* axes;           // of their shapes at rest, row by row; none: those of the world
};

// What a search looks at. Balls side by side, with room for seven more behind the last; an oriented box as two rows of eight.
struct Balls {
  const double *x, *y, *z, *radius;  // m
};
struct alignas(64) OrientedBox {
  double centre[3], turn[9], half[3], radius;  // m, by column, m, m: of the ball about it
};

struct PairKernels {
  // Pose, motion and way of the blocks marked; `soon` (s): the next steps. `fastest` (m/s): of any block so far, lane by lane.
  void (*follow)(const BlockLanes&, unsigned which, double soon, Lane& fastest);
  void (*place)(PairLanes&);                         // reads the rows; fills turn and shift
  void (*patch)(PairLanes&, const PairSettings&);    // from sums to turning; total = 0 where there is no patch to speak of
  void (*dashpot)(PairLanes&, const PairSettings&);  // from closing
  void (*springs)(PairLanes&, const PairSettings&);  // up to holds
  void (*bear)(PairLanes&, PairLanes&);  // of two batches, what reaches the limit; `holds` then is 0 where that is left to the caller
  void (*finish)(PairLanes&, const PairSettings&);  // rows of pairs and results
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
