// The arithmetic of eight joints or eight blocks side by side, compiled once for each instruction set (lanes_*.cpp) and chosen when
// the program starts. Plain loops over lanes: -ffp-contract=off and the absence of sums across lanes give the same bits with each.
// Only plain data passes here: an Eigen function compiled with wider instructions could end up in code meant for any machine.
#pragma once
#include "engine/laws/point.h"
#include "engine/model/joint_batch.h"

namespace erbs {

// Results of the elastic pass of one batch.
struct alignas(64) JointLanes {
  double q[6][lanes], f[6][lanes];
  double y[3][lanes];   // m, turned-back distance of the centroids
  double sum[3][lanes]; // m, turned-back sum of the arms
  double th[3][lanes];  // rad, mean rotation since the refresh
  double near[lanes];   // > 0: the bound on tension, shear or compression is passed
};

// Eight joints of one law that have cracked: the corners of their overlap, their points with what these remember, and the joints'
// own memory and account of the step.
struct alignas(64) CornerLanes {
  double s[lanes], t[lanes];  // m
};
struct alignas(64) PointLanes {
  double s[lanes], t[lanes], weight[lanes];                                                             // m, m, m2
  double slip_s[lanes], slip_t[lanes], damage[lanes], crushed[lanes], secant[lanes], reach[lanes];  // as in PointHistory
};
struct alignas(64) CellLanes {
  double s[lanes], t[lanes], ss[lanes], st[lanes], tt[lanes];  // as in Cell
};
struct alignas(64) FaceLanes {
  double bend_s[lanes], bend_t[lanes], twist[lanes];  // N m, Joint::face
};
// The shapes of eight joints of one law with the same numbers of everything: corners of the overlap, points, corners of their cells.
struct CrackedShape {
  int corners, points;
  const FaceLanes* face;
  const CornerLanes* corner;
  const CellLanes* cell;         // [points]
  const int* first;              // corners of cell i: [first[i], first[i + 1])
  const CornerLanes* loop;       // corners of the cells
  const double* rate;            // of dashpots, b over the last step; null without [lanes]
  const CornerLanes* watch;      // where the cells watch for tension; = loop for rules with points on the edge
};
struct alignas(64) CrackedLanes {
  double q[6][lanes], f[6][lanes], stored[lanes];                   // at the last step
  double friction[lanes], fracture[lanes], crushing[lanes];         // J, of this step
  double drag[6][lanes];                                            // of the dashpots now, with `rate` only; part of f of the JointLanes
  double error[lanes];                                              // J, work of the resultant - stored - dissipated
  double least_damage[lanes];                                       // of the points; 1 for dry joints
};

// Eight blocks: what the kick and the drift read and write. Layout of q: x, y, z, w.
struct alignas(64) BlockLanes {
  // in
  double mass[lanes], inverse_mass[lanes], moving[lanes], damping[lanes];  // kg, 1/kg, 0 or 1, 1/s
  double inverse_inertia[9][lanes];                                        // 1/(kg m2), axes at rest
  double force[3][lanes], moment[3][lanes];                                // N, N m, of joints, contacts and loads
  double load[6][lanes];                                                   // N, N m, of loads alone
  double base_u[3][lanes], base_q[4][lanes];
  // in and out
  double u[3][lanes], q[4][lanes], v[3][lanes], momentum[3][lanes];
  // out
  double w[3][lanes], row[6][lanes];
  double base0[lanes], base1[lanes], damped0[lanes], damped1[lanes], loaded0[lanes], loaded1[lanes];  // J
  double kinetic[lanes], height[lanes], turned[lanes], speed[lanes];                                  // J, J, rad2, m2/s2
};

struct KickDrift {
  double kick, dt, half_last, half_next;  // s
  double ground[3], gravity[3];           // m/s2
  bool first;                             // no drift has led here
  bool damping_explicit, gyroscopic;
};

struct LaneKernels {
  const char* name;
  // joint_geometry.h gives the formulas: q, its elastic resultant and the bound that keeps a joint on this path.
  void (*elastic)(const JointBatch& batch, const double* rows, JointLanes& out);
  // Point laws of joints that have cracked (joint_response.h): q of `io` gives its f; memory and account in `cracked`.
  void (*respond)(const PointLaw& law, const JointBatch& batch, const CrackedShape& shape, PointLanes* point, CrackedLanes& cracked,
                  JointLanes& io);
  // Resultants to wrenches on both blocks: force at the midpoint of the material points, then everything turned by th.
  void (*wrenches)(const JointBatch& batch, const JointLanes& in, double* wrench_rows);
  // integrate.h
  void (*advance)(const KickDrift& step, BlockLanes& blocks);
};

const LaneKernels& lane_kernels();  // the widest this processor has; ERBS_ISA=sse2|avx2|avx512 in the environment asks for another

namespace sse2 { extern const LaneKernels kernels; }
namespace avx2 { extern const LaneKernels kernels; }
namespace avx512 { extern const LaneKernels kernels; }

}  // namespace erbs
