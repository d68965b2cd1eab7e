// Arithmetic of eight joints or eight blocks side by side, compiled once per instruction set (step_kernels.cpp) and selected at program
// start. Plain loops over lanes, -ffp-contract=off and no sums across lanes give equal bits with every instruction set. Only plain data
// passes here: an Eigen function compiled for wider instructions could be linked into code for all machines.
#pragma once
#include "engine/laws/crushing.h"
#include "engine/laws/interlock.h"
#include "engine/laws/laws.h"
#include "engine/model/joint_pack.h"

namespace erbs {

// Results of the elastic pass of one pack.
struct alignas(64) ElasticPack {
  double gap[6][pack_size], resultant[6][pack_size];
  double arm_a[3][pack_size], arm_b[3][pack_size];  // m, from the centroids to the point where the force acts, world
  double theta[3][pack_size];                       // rad, mean rotation since the reference poses
  double may_yield[pack_size];                      // > 0: beyond the bound on tension, shear or compression
};

// Eight cracked joints of one law: corners of their overlap, contact points with their history, and the history and account of the joints.
struct alignas(64) CornerPack {
  double s[pack_size], t[pack_size];  // m
};
struct alignas(64) PointPack {
  double s[pack_size], t[pack_size], weight[pack_size];  // m, m, m2
};
struct alignas(64) SlipPack {
  double s[pack_size], t[pack_size], mean_pressure[pack_size], lent[pack_size];  // as in `PointHistory`
};
// The rigid motion nearest to the slips of all points, and the residual slips. `outdated`: the slips have changed since.
struct MeanSlipPack {
  double s[pack_size], t[pack_size], rotation[pack_size];  // m, rad
  double apart[pack_size], stored[pack_size];              // m, greatest residual; J, of the springs when the joint is at that rigid motion
  double outdated[pack_size];                              // 0 or 1
  double lent[pack_size];                                  // > 0: to some point (interlock.h)
};
struct alignas(64) BondPack {
  double damage[pack_size], secant[pack_size], kappa[pack_size];  // as in `PointHistory`
};
struct alignas(64) CellPack {
  double s[pack_size], t[pack_size], ss[pack_size], st[pack_size], tt[pack_size];  // as in Cell
};
struct alignas(64) FacePack {
  double frame[4][pack_size];                                                               // at rest, as a quaternion x y z w
  double stiffness[6][pack_size], half_s[pack_size], half_t[pack_size], radius[pack_size];  // as in `JointPack`
  double bend_s[pack_size], bend_t[pack_size], twist[pack_size];                            // N m, `JointType::face`
};
inline constexpr int most_cells_in_line = 5;  // of a grid of cells
// Tension of all cells of a joint that is open all over, which is linear: integrals of the secant stiffness of the points over their cells.
struct TensionPack {
  double k[pack_size], s[pack_size], t[pack_size];     // N/m; N, times s and t
  double ss[pack_size], st[pack_size], tt[pack_size];  // N m
};
// Shapes of eight joints of one law with equal numbers of overlap corners, points and cell corners.
struct CrackedShape {
  int corners, points;
  unsigned used;  // lanes with a joint, as bits
  double number;  // name of the pack in `CrackedSums::worst`
  const FacePack* face;
  const CornerPack* overlap_corner;
  const PointPack* point;          // [points]
  const CellPack* cell;            // [points]
  const int* first;                // corners of cell i: `[first[i], first[i + 1])`
  const CornerPack* cell_loop;     // corners of the cells
  double per_step;                 // 1/s, one over the last step, for dashpots; 0 without
  const CornerPack* tension_loop;  // where cells measure their opening; equal to `cell_loop` for rules with points on the edge
  // For laws with a plateau in compression: crushed faces; corners, or points that bear, as in
  // `CompressionFace`; null in empty lanes [lanes].
  CrushedFace* const* crushed;
  const double* const* bearing;
  double event_budget;  // J, for `event_bound.h`; 0: no prediction
  InterlockStep interlock;
  bool rectangles;                               // the overlaps are rectangles along s and t about the centre
  int lines;                                     // > 0: so are the cells, in a grid of as many along s and t (strips.h)
  const CornerPack* line;                        // between these lines: at s, and at t [lines + 1]
  bool lumped() const { return first[1] == 1; }  // points bear the face (Cell::lumped)
};
// All other data of eight cracked joints that a step reads and writes, in the order of access and in one piece.
struct alignas(64) CrackedPack {
  int a[pack_size], b[pack_size], wrench_row_a[pack_size], wrench_row_b[pack_size];
  double arm_a[3][pack_size], arm_b[3][pack_size];  // m, from the centroids to the joint, world, at rest
  double viscous[pack_size];                        // s, coefficient b of the dashpots; 0 in empty lanes
  double hop_time[pack_size], hop_loan[pack_size];  // s, `Hop` (laws/interlock.h)
  double share_n[pack_size], share_s[pack_size];    // of the stiffness of the intact joint (fading.h)
  double gap[6][pack_size];                         // at the last step, like `resultant` and `stored`
  MeanSlipPack mean_slip;
  double resultant[6][pack_size], stored[pack_size];
  double least_damage[pack_size];  // of all points; 1 for dry joints
  double drag[6][pack_size];       // N, N m, of the dashpots at the last step, not contained in `resultant`
  TensionPack tension;
  int tension_outdated;  // the secant stiffness of a point has changed since
  // Stored behind this object: the slips [points], then the numbers that only the joint's law knows (laws/face.h).
  SlipPack* slip() { return reinterpret_cast<SlipPack*>(this + 1); }
  const SlipPack* slip() const { return reinterpret_cast<const SlipPack*>(this + 1); }
  double (*own(int points))[pack_size] { return reinterpret_cast<double(*)[pack_size]>(slip() + points); }
  const double (*own(int points) const)[pack_size] { return reinterpret_cast<const double(*)[pack_size]>(slip() + points); }
};
// Sums of several packs over a step, lane by lane.
struct alignas(64) CrackedSums {
  double friction[pack_size], fracture[pack_size], crushing[pack_size], damping[pack_size];  // J
  double error[pack_size];       // J, the greatest |work of the resultant - stored - dissipated|
  double worst[pack_size];       // pack of that error: `number` of its shape
  double event_rate[pack_size];  // greatest `last_dt` over allowed step (`event_bound.h`)
};

// Constants of eight intact joints. Adjacent packs with joints of the same types share one, which then stays in the cache.
struct alignas(64) IntactConstants {
  // of the resultant on b, therefore both negative
  double shear[pack_size], across[pack_size];  // N/m: stiffness along the faces; excess of the stiffness across them
  double open_limit[pack_size], slip_limit[pack_size], slip_slope[pack_size], close_limit[pack_size];  // as in `JointPack`
  double diameter[pack_size];                                                                          // m, twice the radius of `JointPack`
};
// Eight intact joints in world axes at the reference poses: the data that a step reads, and no other (`intact_kernel.h`).
struct alignas(64) IntactPack {
  double gap[3][pack_size], rotation[3][pack_size];  // m, rad: relative displacement and half the relative rotation
  double arm_a[3][pack_size], arm_b[3][pack_size];   // m, from the centroids to the joint
  double normal[3][pack_size];
  double bend[6][pack_size];  // N m: symmetric, xx yy zz yz xz xy; against half rotations; of the resultant on b: negative
  const IntactConstants* law;
  GatherTable other;  // where the data of blocks b are; blocks a are the owners
  int used;           // number of joints; -1: none, and their forces are cleared
};
// Packs of intact joints that have come near their limits, with the data for a closer bound; null for all others, and for all if there are
// none. `carried` times the distance of their blocks bounds the error of joints since the reference poses. `ahead`: distance of prefetch,
// in packs; 0: all packs stay in the cache.
struct CornerCheck {
  const JointPack* const* pack;
  double carried;
  int ahead;
};
// The end from which each joint is seen (1: a, -1: b), and the address of its stiffness against rotation (N m).
struct alignas(64) IntactInput {
  double sign[pack_size];
  const double* bending[pack_size];  // about s, t, n; zeros in a lane without a joint
};
struct IntactEnds {
  // Start of the rows of blocks and joint ends, in doubles, for packs without owners.
  int a[pack_size], b[pack_size], wrench_row_a[pack_size], wrench_row_b[pack_size];
};

// Data of eight blocks that do not change from step to step.
struct alignas(64) BlockConstants {
  double mass[pack_size], inverse_mass[pack_size];  // kg, 1/kg; 0 for fixed and driven blocks; inverse 0 for sleepers
  double moving[pack_size], damped[pack_size];      // 0 or 1
  double gravity_factor[pack_size];                 // Model::gravity_factor; read only if `KickDrift::relaxes`
  double inverse_inertia[6][pack_size];             // 1/(kg m2), axes at rest: xx yy zz yz xz xy
  double rotation_limit[pack_size];                 // rad2, of the rotation since the reference pose; infinite without intact joints
  int first_wrench_slot, wrench_slots;              // of eight wrench rows each; none: nobody reads pose rows of these blocks either
  int first_gather, gathers;                        // range in `BlockArrays::gather_in`
  bool carried;  // increments since the reference pose are read; if not, no intact joint acts on these blocks
};

// Arrays of all blocks by groups of eight, and rows of eight doubles by block. `contact_wrench` and `load_wrench` are null if there are
// none, `pose_row` and `pose` if nobody reads them.
struct BlockArrays {
  const BlockConstants* constant;
  VectorPack<3>*u, *v, *momentum, *w;
  VectorPack<4>* q;
  const VectorPack<3>* ref_u;
  const VectorPack<4>* ref_q;
  double *pose_row, *pose;
  VectorPack<6>* increment;
  const VectorPack<6>*owner_sum, *neighbour_force;
  const GatherTable* gather_in;
  const double *wrench, *contact_wrench, *load_wrench;
  // s, interval of loads before and after this kick where contacts have levels (model/levels.h), one number per block; null: the steps
  const double *load_since = nullptr, *load_next = nullptr;
  const double* inertia = nullptr;  // force of a coarse inertia; null: none
};

// Work of blocks in this step, summed lane by lane, so that totals do not depend on the width of registers.
struct alignas(64) BlockWork {
  double base[pack_size], damping[pack_size], absolute[pack_size];                    // J
  double base_after[pack_size], damping_after[pack_size], absolute_after[pack_size];  // J, of the half drift after a sample
  double kinetic[pack_size], height[pack_size];                                       // J, at a sample
  double outdated[pack_size];  // blocks with joints that are beyond their `rotation_limit`
};

struct KickDrift {
  double kick, dt, half_last, half_next;     // s
  double more;                               // as `book()` says
  double shortens;                           // with a coarse inertia (last drift - next drift) / 4 kick
  double damping, damped_keep, damped_kick;  // 1/s; a damped kick is `(1 + damped_keep) v + kick (1 + damped_kick) contact_wrench`
  double local;                              // Model::local_damping
  double ground[3], gravity[3];              // m/s2
  bool first;                                // no drift has come before
  bool damping_explicit, gyroscopic, shaken;
  bool relaxes;  // damping, local damping, coarse inertia or gravity factors
};

// Addresses of the poses and rest geometry of eight joints, and one result.
struct alignas(64) PosePack {
  const double *ua[pack_size], *ub[pack_size], *qa[pack_size],
      *qb[pack_size];                                                   // m, unit quaternions x y z w: components `pack_size` doubles apart
  const double *arm_a[pack_size], *arm_b[pack_size], *rest[pack_size];  // m, at rest; frame as in `JointPack`: components adjacent
  double far[pack_size];                                                // 1: relative rotation too large for the series of `rotation`
};

struct StepKernels {
  const char* name;
  // Elastic pass (`kinematics.h`): q, its elastic resultant, and the bound within which a joint is intact.
  void (*elastic)(const JointPack& pack, const double* rows, ElasticPack& out);
  // Cracked joints: poses of blocks to wrench rows by the point laws (`response.h`). `poses`: rows of eight doubles, displacement and
  // attitude x y z w. `cracked` contains their history; `sums` receives their account. True if a joint may be beyond its faces
  // (`out_of_range()`).
  // One kernel for each type of law; null for a type without a bond.
  using Respond = bool(const PointLaw& law, const CrackedShape& shape, BondPack* bond, CrackedPack& cracked, const double* poses,
                       double* wrench_rows, CrackedSums& sums);
  Respond* respond[Laws::count];
  // The same if no point has a bond left.
  using Friction = bool(const PointLaw& law, const CrackedShape& shape, CrackedPack& cracked, const double* poses, double* wrench_rows,
                        CrackedSums& sums);
  Friction* friction[Laws::count];
  // Resultants to wrenches on both blocks: the force acts at the midpoint of the material points; all is rotated forward by `theta`.
  void (*wrenches)(const JointPack& pack, const ElasticPack& in, double* wrench_rows);
  // Intact joints: increments of blocks to wrenches, for groups [first, last) of eight blocks. Lane l of the packs of group g
  // (`first_pack`) contains joints that block l of this group owns. Forces on owners are summed in `owner_sum`; forces on neighbours go to
  // `neighbour_force` of the pack. The energy of the joints is added to `stored[pack_size]` if that is not null. Returns the number of
  // packs with a joint near its limits, and their indices in `may_yield`.
  int (*intact)(IntactPack* pack, const CornerCheck& corner_check, const int* first_pack, int first, int last,
                const VectorPack<6>* increment, VectorPack<6>* owner_sum, VectorPack<6>* neighbour_force, double* stored, int* may_yield);
  // Intact joints of packs [first, last) without owners: pose rows of blocks to wrench rows of both ends.
  int (*intact_ends)(const IntactPack* pack, const IntactEnds* ends, int first, int last, const double* rows, double* wrench_rows,
                     int* may_yield);
  // Kick and drift of groups [first, last) of blocks (`integrate.h`); true if a number is not finite.
  bool (*advance)(const KickDrift& step, const BlockArrays& blocks, int first, int last, bool sample, BlockWork& work);
  // All forces on the moving blocks of these groups, weights among them (N, N m).
  void (*forces)(const KickDrift& step, const BlockArrays& blocks, int first, int last, VectorPack<6>* out);
  // Geometry of joints from the poses of their blocks: frame, arms, gap and rotation of `out`.
  void (*pose)(PosePack& joints, JointPack& out);
  // Geometry of intact joints in world axes from that of `pack`; constants stay.
  void (*intact_geometry)(const JointPack& pack, const IntactInput& lane, IntactPack& out);
  // Occupies the arithmetic units from registers alone and returns the number of operations, for comparison with their peak.
  double (*work_registers)(long rounds);
};

// For the widest instruction set of this processor; the environment variable `ERBS_ISA=sse2|avx2|avx512` selects another.
const StepKernels& step_kernels();

namespace sse2 {
extern const StepKernels kernels;
}
namespace avx2 {
extern const StepKernels kernels;
}
namespace avx512 {
extern const StepKernels kernels;
}

}  // namespace erbs
