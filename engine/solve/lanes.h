// Arithmetic of eight joints or eight blocks side by side, compiled once per instruction set (lanes_*.cpp) and selected at program start.
// Plain loops over lanes, -ffp-contract=off and no sums across lanes give equal bits with every instruction set. Only plain data passes
// here: an Eigen function compiled for wider instructions could be linked into code for all machines.
#pragma once
#include "engine/laws/crushing.h"
#include "engine/laws/interlock.h"
#include "engine/laws/point.h"
#include "engine/model/joint_batch.h"

namespace erbs {

// Results of the elastic pass of one pack.
struct alignas(64) JointLanes {
  double q[6][lanes], f[6][lanes];
  double arm_a[3][lanes], arm_b[3][lanes];  // m, from the centroids to the point where the force acts, world
  double th[3][lanes];                      // rad, mean rotation since the reference poses
  double near[lanes];                       // > 0: beyond the bound on tension, shear or compression
};

// Eight cracked joints of one law: corners of their overlap, contact points with their history, and the history and account of the joints.
struct alignas(64) CornerLanes {
  double s[lanes], t[lanes];  // m
};
struct alignas(64) SpotLanes {
  double s[lanes], t[lanes], weight[lanes];  // m, m, m2
};
struct alignas(64) SlipLanes {
  double s[lanes], t[lanes], bearing[lanes];  // as in `PointHistory`
};
// The rigid motion nearest to the slips of all points, and the residual slips. `stale`: the slips have changed since.
struct CommonLanes {
  double s[lanes], t[lanes], turn[lanes];  // m, rad
  double apart[lanes], stored[lanes];      // m, greatest residual; J, of the springs when the joint is at that rigid motion
  double stale[lanes];                     // 0 or 1
};
struct alignas(64) BondLanes {
  double damage[lanes], secant[lanes], reach[lanes];  // as in `PointHistory`
};
struct alignas(64) CellLanes {
  double s[lanes], t[lanes], ss[lanes], st[lanes], tt[lanes];  // as in Cell
};
struct alignas(64) FaceLanes {
  double frame[4][lanes];                                                   // at rest, as a quaternion x y z w
  double stiffness[6][lanes], half_s[lanes], half_t[lanes], radius[lanes];  // as in `JointBatch`
  double bend_s[lanes], bend_t[lanes], twist[lanes];                        // N m, `JointType::face`
};
// Shapes of eight joints of one law with equal numbers of overlap corners, points and cell corners.
struct CrackedShape {
  int corners, points;
  unsigned used;  // lanes with a joint, as bits
  double number;  // name of the pack in `CrackedSums::worst`
  const FaceLanes* face;
  const CornerLanes* corner;
  const SpotLanes* spot;     // [points]
  const CellLanes* cell;     // [points]
  const int* first;          // corners of cell i: `[first[i], first[i + 1])`
  const CornerLanes* loop;   // corners of the cells
  double per_step;           // 1/s, one over the last step, for dashpots; 0 without
  const CornerLanes* watch;  // where cells measure their opening; equal to `loop` for rules with points on the edge
  // For laws with a plateau in compression: crushed faces, and corners as in `Bed`; null in empty lanes [lanes].
  CrushedFace* const* crushed;
  const double* const* face_corner;
  double event_budget;  // J, for `event_bound.h`; 0: no prediction
  Interlock interlock;
};
// All other data of eight cracked joints that a step reads and writes, in the order of access and in one piece.
struct alignas(64) CrackedLanes {
  int a[lanes], b[lanes], row_a[lanes], row_b[lanes];
  double arm_a[3][lanes], arm_b[3][lanes];  // m, from the centroids to the joint, world, at rest
  double viscous[lanes];                    // s, coefficient b of the dashpots; 0 in empty lanes
  double q[6][lanes];                       // at the last step, like `f` and `stored`
  CommonLanes common;
  double f[6][lanes], stored[lanes];
  double least_damage[lanes];                                           // of all points; 1 for dry joints
  double drag[6][lanes];                                                // N, N m, of the dashpots at the last step, not contained in `f`
  SlipLanes* slip() { return reinterpret_cast<SlipLanes*>(this + 1); }  // stored behind this object [points]
  const SlipLanes* slip() const { return reinterpret_cast<const SlipLanes*>(this + 1); }
};
// Sums of several packs over a step, lane by lane.
struct alignas(64) CrackedSums {
  double friction[lanes], fracture[lanes], crushing[lanes], damping[lanes];  // J
  double error[lanes];  // J, the greatest |work of the resultant - stored - dissipated|
  double worst[lanes];  // pack of that error: `number` of its shape
  double haste[lanes];  // greatest `last_dt` over allowed step (`event_bound.h`)
};

// Constants of eight intact joints. Adjacent packs with joints of the same types share one, which then stays in the cache.
struct alignas(64) SoundLaw {
  // of the resultant on b, therefore both negative
  double shear[lanes], across[lanes];  // N/m: stiffness along the faces; excess of the stiffness across them
  double open_limit[lanes], slip_limit[lanes], slip_slope[lanes], close_limit[lanes];  // as in `JointBatch`
  double diameter[lanes];                                                              // m, twice the radius of `JointBatch`
};
// Eight intact joints in world axes at the reference poses: the data that a step reads, and no other (`lanes_sound.inc`).
struct alignas(64) SoundBatch {
  double gap[3][lanes], turn[3][lanes];     // m, rad: relative displacement and half the relative rotation
  double arm_a[3][lanes], arm_b[3][lanes];  // m, from the centroids to the joint
  double normal[3][lanes];
  double bend[6][lanes];  // N m: symmetric, xx yy zz yz xz xy; against half rotations; of the resultant on b: negative
  const SoundLaw* law;
  Crossing other;  // where the data of blocks b are; blocks a are the owners
  int used;        // number of joints; -1: none, and their forces are cleared
};
// Packs of intact joints that have come near their limits, with the data for a closer bound; null for all others, and for all if there are
// none. `carried` times the distance of their blocks bounds the error of joints since the reference poses. `ahead`: distance of prefetch,
// in packs; 0: all packs stay in the cache.
struct SoundCloser {
  const JointBatch* const* batch;
  double carried;
  int ahead;
};
// The end from which each joint is seen (1: a, -1: b), and the address of its stiffness against rotation (N m).
struct alignas(64) SoundLanes {
  double sign[lanes];
  const double* bending[lanes];  // about s, t, n; zeros in a lane without a joint
};
struct SoundEnds {
  // Start of the rows of blocks and joint ends, in doubles, for packs without owners.
  int a[lanes], b[lanes], row_a[lanes], row_b[lanes];
};

// Data of eight blocks that do not change from step to step.
struct alignas(64) BlockConstants {
  double mass[lanes], inverse_mass[lanes];  // kg, 1/kg; 0 for fixed and driven blocks; inverse 0 for sleepers
  double moving[lanes], damped[lanes];      // 0 or 1
  double inverse_inertia[6][lanes];         // 1/(kg m2), axes at rest: xx yy zz yz xz xy
  double turn_limit[lanes];                 // rad2, of the rotation since the reference pose; infinite without intact joints
  int first_slot, slots;                    // of eight wrench rows each; none: nobody reads pose rows of these blocks either
  int first_taken, taken;                   // range in `BlockArrays::taken`
  bool carried;                             // increments since the reference pose are read; if not, no intact joint acts on these blocks
};

// Arrays of all blocks by groups of eight, and rows of eight doubles by block. `push` and `load` are null if there are none, `row` and
// `pose` if nobody reads them.
struct BlockArrays {
  const BlockConstants* constant;
  RowLanes<3>*u, *v, *momentum, *w;
  RowLanes<4>* q;
  const RowLanes<3>* base_u;
  const RowLanes<4>* base_q;
  double *row, *pose;
  RowLanes<6>* shift;
  const RowLanes<6>*kept, *given;
  const Crossing* taken;
  const double *wrench, *push, *load;
};

// Work of blocks in this step, summed lane by lane, so that totals do not depend on the width of registers.
struct alignas(64) BlockWork {
  double base[lanes], damping[lanes], absolute[lanes];                    // J
  double base_after[lanes], damping_after[lanes], absolute_after[lanes];  // J, of the half drift after a sample
  double kinetic[lanes], height[lanes];                                   // J, at a sample
  double stale[lanes];                                                    // blocks with joints that are beyond their `turn_limit`
};

struct KickDrift {
  double kick, dt, half_last, half_next;     // s
  double damping, damped_keep, damped_kick;  // 1/s; a damped kick is `(1 + damped_keep) v + kick (1 + damped_kick) push`
  double ground[3], gravity[3];              // m/s2
  bool first;                                // no drift has come before
  bool damping_explicit, gyroscopic, shaken;
};

// Addresses of the poses and rest geometry of eight joints, and one result.
struct alignas(64) PoseLanes {
  const double *ua[lanes], *ub[lanes], *qa[lanes], *qb[lanes];  // m, unit quaternions x y z w: components `lanes` doubles apart
  const double *arm_a[lanes], *arm_b[lanes], *rest[lanes];      // m, at rest; frame as in `JointBatch`: components adjacent
  double far[lanes];                                            // 1: relative rotation too large for the series of `turn`
};

struct LaneKernels {
  const char* name;
  // Elastic pass (`joint_geometry.h`): q, its elastic resultant, and the bound within which a joint is intact.
  void (*elastic)(const JointBatch& batch, const double* rows, JointLanes& out);
  // Cracked joints: poses of blocks to wrench rows by the point laws (`joint_response.h`). `poses`: rows of eight doubles, displacement and
  // attitude x y z w. `cracked` contains their history; `sums` receives their account. True if a joint may be beyond its faces
  // (`beyond_its_faces()`).
  bool (*respond)(const PointLaw& law, const CrackedShape& shape, BondLanes* bond, CrackedLanes& cracked, const double* poses,
                  double* wrench_rows, CrackedSums& sums);
  // The same if no point has a bond left.
  bool (*rub)(const PointLaw& law, const CrackedShape& shape, CrackedLanes& cracked, const double* poses, double* wrench_rows,
              CrackedSums& sums);
  // Resultants to wrenches on both blocks: the force acts at the midpoint of the material points; all is rotated forward by `th`.
  void (*wrenches)(const JointBatch& batch, const JointLanes& in, double* wrench_rows);
  // Intact joints: increments of blocks to wrenches, for groups [first, last) of eight blocks. Lane l of the packs of group g
  // (`first_batch`) contains joints that block l of this group owns. Forces on owners are summed in `kept`; forces on neighbours go to
  // `given` of the pack. The energy of the joints is added to `stored[lanes]` if that is not null. Returns the number of packs with a joint
  // near its limits, and their indices in `near`.
  int (*sound)(SoundBatch* batch, const SoundCloser& closer, const int* first_batch, int first, int last, const RowLanes<6>* shift,
               RowLanes<6>* kept, RowLanes<6>* given, double* stored, int* near);
  // Intact joints of packs [first, last) without owners: pose rows of blocks to wrench rows of both ends.
  int (*sound_ends)(const SoundBatch* batch, const SoundEnds* ends, int first, int last, const double* rows, double* wrench_rows,
                    int* near);
  // Kick and drift of groups [first, last) of blocks (`integrate.h`); true if a number is not finite.
  bool (*advance)(const KickDrift& step, const BlockArrays& blocks, int first, int last, bool sample, BlockWork& work);
  // Geometry of joints from the poses of their blocks: frame, arms, gap and rotation of `out`.
  void (*pose)(PoseLanes& joints, JointBatch& out);
  // Geometry of intact joints in world axes from that of `batch`; constants stay.
  void (*sound_pose)(const JointBatch& batch, const SoundLanes& lane, SoundBatch& out);
  // Occupies the arithmetic units from registers alone and returns the number of operations, for comparison with their peak.
  double (*work_registers)(long rounds);
};

// For the widest instruction set of this processor; the environment variable `ERBS_ISA=sse2|avx2|avx512` selects another.
const LaneKernels& lane_kernels();

namespace sse2 {
extern const LaneKernels kernels;
}
namespace avx2 {
extern const LaneKernels kernels;
}
namespace avx512 {
extern const LaneKernels kernels;
}

}  // namespace erbs
