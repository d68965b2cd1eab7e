// The arithmetic of eight joints or eight blocks side by side, compiled once for each instruction set (lanes_*.cpp) and chosen when
// the program starts. Plain loops over lanes: -ffp-contract=off and the absence of sums across lanes give the same bits with each.
// Only plain data passes here: an Eigen function compiled with wider instructions could end up in code meant for any machine.
#pragma once
#include "engine/laws/crushing.h"
#include "engine/laws/interlock.h"
#include "engine/laws/point.h"
#include "engine/model/joint_batch.h"

namespace erbs {

// Results of the elastic pass of one batch.
struct alignas(64) JointLanes {
  double q[6][lanes], f[6][lanes];
  double arm_a[3][lanes], arm_b[3][lanes];  // m, from the centroids to where the force acts, world
  double th[3][lanes];                      // rad, mean rotation since the refresh
  double near[lanes];                       // > 0: the bound on tension, shear or compression is passed
};

// Eight joints of one law that have cracked: the corners of their overlap, their points with what these remember, and the joints'
// own memory and account of the step.
struct alignas(64) CornerLanes {
  double s[lanes], t[lanes];  // m
};
struct alignas(64) SpotLanes {
  double s[lanes], t[lanes], weight[lanes];  // m, m, m2
};
struct alignas(64) SlipLanes {
  double s[lanes], t[lanes], bearing[lanes];  // as in PointHistory
};
// The rigid motion nearest to the slips of all points, and what is left of them: functions of the slips, `stale` where these have changed.
struct CommonLanes {
  double s[lanes], t[lanes], turn[lanes];  // m, rad
  double apart[lanes], stored[lanes];      // m, the greatest; J, of the springs when the joint is where its slips are
  double stale[lanes];                     // 0 or 1
};
struct alignas(64) BondLanes {
  double damage[lanes], secant[lanes], reach[lanes];  // as in PointHistory
};
struct alignas(64) CellLanes {
  double s[lanes], t[lanes], ss[lanes], st[lanes], tt[lanes];  // as in Cell
};
struct alignas(64) FaceLanes {
  double frame[4][lanes];                                                   // at rest, as a quaternion x y z w
  double stiffness[6][lanes], half_s[lanes], half_t[lanes], radius[lanes];  // as in JointBatch
  double bend_s[lanes], bend_t[lanes], twist[lanes];                        // N m, Joint::face
};
// The shapes of eight joints of one law with the same numbers of everything: corners of the overlap, points, corners of their cells.
struct CrackedShape {
  int corners, points;
  unsigned used;  // lanes with a joint, as bits
  double number;  // by which sums name it
  const FaceLanes* face;
  const CornerLanes* corner;
  const SpotLanes* spot;     // [points]
  const CellLanes* cell;     // [points]
  const int* first;          // corners of cell i: [first[i], first[i + 1])
  const CornerLanes* loop;   // corners of the cells
  double per_step;           // 1/s, of dashpots, over the last step; 0 without
  const CornerLanes* watch;  // where the cells watch for tension; = loop for rules with points on the edge
  // of laws with a plateau in compression: what has been crushed, and the corners as in Bed; null in empty lanes  [lanes]
  CrushedFace* const* crushed;
  const double* const* face_corner;
  double event_budget;  // J, for event_bound.h; 0: not asked for
  Interlock interlock;
};
// All that a step reads and writes of them beside their shapes and bonds, in the order in which it does and in one piece.
struct alignas(64) CrackedLanes {
  int a[lanes], b[lanes], row_a[lanes], row_b[lanes];
  double arm_a[3][lanes], arm_b[3][lanes];  // m, from the centroids to the joint, world, at rest
  double viscous[lanes];                    // s, b of dashpots; 0 in empty lanes
  double q[6][lanes];                       // at the last step, and so are f and stored
  CommonLanes common;
  double f[6][lanes], stored[lanes];
  double least_damage[lanes];                                           // of the points; 1 for dry joints
  double drag[6][lanes];                                                // of the dashpots now; part of f of the JointLanes
  SlipLanes* slip() { return reinterpret_cast<SlipLanes*>(this + 1); }  // behind it [points]
  const SlipLanes* slip() const { return reinterpret_cast<const SlipLanes*>(this + 1); }
};
// What several such did in their steps, lane by lane.
struct alignas(64) CrackedSums {
  double friction[lanes], fracture[lanes], crushing[lanes], damping[lanes];  // J
  double error[lanes];  // J, the greatest |work of the resultant - stored - dissipated|
  double worst[lanes];  // whose that is: `number` of the shape
  double haste[lanes];  // the greatest of event_bound.h, over the last step
};

// What no refresh changes of eight sound joints. Joints of the same types side by side share one, which then stays near the processor.
struct alignas(64) SoundLaw {
  // the resultant on b: so both are negative
  double shear[lanes], across[lanes];  // N/m: stiffness along the faces, and how much more it is across them
  double open_limit[lanes], slip_limit[lanes], slip_slope[lanes], close_limit[lanes];  // as in JointBatch
  double diameter[lanes];                                                              // m, twice the radius of JointBatch
};
// Eight sound joints in world axes at the last refresh: what a step reads of them, and nothing else (lanes_sound.inc).
struct alignas(64) SoundBatch {
  double gap[3][lanes], turn[3][lanes];     // m, rad: relative displacement and half the relative rotation
  double arm_a[3][lanes], arm_b[3][lanes];  // m, from the centroids to the joint
  double normal[3][lanes];
  double bend[6][lanes];  // N m: symmetric, xx yy zz yz xz xy; against half rotations, the resultant on b: negative
  const SoundLaw* law;
  Crossing other;  // where blocks b are; blocks a are their keepers
  int used;        // joints in it; -1: none, and nothing left of them
};
// Batches of sound joints that have come near their limits, with all that tells how near; null for others, and for all if none has. By
// `carried` times the distance of their blocks joints may be amiss for what they are carried from the last refresh. While one batch is
// computed, the one `ahead` of it is asked for; 0: all lie near.
struct SoundCloser {
  const JointBatch* const* batch;
  double carried;
  int ahead;
};
// Of its joints: whether they are seen from their other end (-1) or not (1), and where the stiffnesses against rotation (N m) lie.
struct alignas(64) SoundLanes {
  double sign[lanes];
  const double* bending[lanes];  // about s, t, n; of nothing in a lane without a joint
};
struct SoundEnds {
  int a[lanes], b[lanes], row_a[lanes], row_b[lanes];  // where rows of blocks and joint ends begin, in doubles, where no lane is a keeper's
};

// Eight blocks: what does not change from step to step.
struct alignas(64) BlockConstants {
  double mass[lanes], inverse_mass[lanes];  // kg, 1/kg; 0 for blocks that are held
  double moving[lanes], damped[lanes];      // 0 or 1
  double inverse_inertia[6][lanes];         // 1/(kg m2), axes at rest: xx yy zz yz xz xy
  double turn_limit[lanes];                 // rad2, of joined blocks between refreshes
  int first_slot, slots;                    // of eight wrench rows; none: nobody reads rows of these blocks either
  int first_taken, taken;                   // of BlockArrays::taken
  bool carried;  // somebody reads what they have done since their refresh: else no sound joint acts on them either
};

// All blocks, by groups of eight; the rows of eight doubles by blocks, `push` and `load` null where there is nothing, `row` and `pose`
// where nobody reads them.
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

// What blocks did in this step, added up lane by lane: every lane its own sum, so that totals do not depend on the width of registers.
struct alignas(64) BlockWork {
  double base[lanes], damping[lanes], absolute[lanes];                    // J
  double base_after[lanes], damping_after[lanes], absolute_after[lanes];  // J, of the half drift after a sample
  double kinetic[lanes], height[lanes];                                   // J, at a sample
  double stale[lanes];                                                    // joined blocks past their turn_limit
};

struct KickDrift {
  double kick, dt, half_last, half_next;     // s
  double damping, damped_keep, damped_kick;  // 1/s; a damped kick is (1 + damped_keep) v + kick (1 + damped_kick) push
  double ground[3], gravity[3];              // m/s2
  bool first;                                // no drift has led here
  bool damping_explicit, gyroscopic, shaken;
};

// Eight joints: where the poses of their blocks and what they are at rest lie, and what follows.
struct alignas(64) PoseLanes {
  const double *ua[lanes], *ub[lanes], *qa[lanes], *qb[lanes];  // m, unit quaternions x y z w: components `lanes` doubles apart
  const double *arm_a[lanes], *arm_b[lanes], *rest[lanes];      // m, at rest; frame as in JointBatch: components side by side
  double far[lanes];  // 1: the blocks have turned so far against each other that the series for `turn` does not hold
};

struct LaneKernels {
  const char* name;
  // joint_geometry.h gives the formulas: q, its elastic resultant and the bound that keeps a joint on this path.
  void (*elastic)(const JointBatch& batch, const double* rows, JointLanes& out);
  // Joints that have cracked, poses of blocks to wrench rows by the point laws (joint_response.h); memory in `cracked`, account in `sums`.
  // `poses`: rows of eight doubles, displacement and attitude x y z w.
  // True where a joint may be beyond its faces (beyond_its_faces of joint_kernel.h).
  bool (*respond)(const PointLaw& law, const CrackedShape& shape, BondLanes* bond, CrackedLanes& cracked, const double* poses,
                  double* wrench_rows, CrackedSums& sums);
  // The same where no point has a bond left.
  bool (*rub)(const PointLaw& law, const CrackedShape& shape, CrackedLanes& cracked, const double* poses, double* wrench_rows,
              CrackedSums& sums);
  // Resultants to wrenches on both blocks: force at the midpoint of the material points, then everything turned by th.
  void (*wrenches)(const JointBatch& batch, const JointLanes& in, double* wrench_rows);
  // Sound joints, displacements of blocks to wrenches. Groups [first, last) of eight blocks: lane l of batches
  // [first_batch[g], first_batch[g + 1]) holds joints that block l of group g keeps. What acts on keepers is summed up in `kept`, what
  // acts on the other blocks goes to `given` of the batch; the energy they store is added to stored[lanes], if wanted. Returns how many
  // batches hold a joint whose limits may be near, and which.
  int (*sound)(SoundBatch* batch, const SoundCloser& closer, const int* first_batch, int first, int last, const RowLanes<6>* shift,
               RowLanes<6>* kept, RowLanes<6>* given, double* stored, int* near);
  // Batches [first, last) of any sound joints, rows of blocks to wrench rows of both ends.
  int (*sound_ends)(const SoundBatch* batch, const SoundEnds* ends, int first, int last, const double* rows, double* wrench_rows,
                    int* near);
  // Kick and drift of groups [first, last) of blocks (integrate.h); true where a number broke.
  bool (*advance)(const KickDrift& step, const BlockArrays& blocks, int first, int last, bool sample, BlockWork& work);
  // Geometry of joints from the poses of their blocks: frame, arms, gap and turn of `out`.
  void (*pose)(PoseLanes& joints, JointBatch& out);
  // The geometry of sound joints in world axes from that of the batch; what no refresh changes stays.
  void (*sound_pose)(const JointBatch& batch, const SoundLanes& lane, SoundBatch& out);
  // Keeps the arithmetic units busy from registers alone; returns how many operations that took. For comparison with their peak.
  double (*work_registers)(long rounds);
};

const LaneKernels& lane_kernels();  // the widest this processor has; ERBS_ISA=sse2|avx2|avx512 in the environment asks for another

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
