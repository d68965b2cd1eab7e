// Joints in their own frame, for laws that look at points: rows of blocks to q, resultants to wrench rows.
// kinematics.h gives the formulas.
#pragma once
#include "engine/joints/kernels.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

struct Relative {
  Pack gap[6];         // m, rad: joint frame
  Pack3 arm_a, arm_b;  // m, from the centroids to where the force acts, world
  Pack3 theta;         // rad, mean rotation since the refresh
};

// Where rows of eight doubles begin.
struct Begins {
  int at[pack_size];
};
ERBS_INLINE Begins begins(const int* row) {
  Begins out;
  for (int l = 0; l < pack_size; ++l) out.at[l] = 8 * row[l];
  return out;
}

// By how much x turns with t = tan(angle) about its axis, as rows of blocks have it: to third order.
ERBS_INLINE Pack3 rotation_change(Pack3 t, Pack3 x) {
  const Pack3 c = cross(t, x);
  const Pack w = 1 - 0.5 * dot(t, t);
  return w * c + 0.5 * cross(t, c);
}

ERBS_INLINE void relative(const JointPack& B, const double* rows, Relative& o) {
  Pack a[8], b[8];
  rows_to_pack(rows, begins(B.a).at, a);
  rows_to_pack(rows, begins(B.b).at, b);
  const Pack3 du{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ta{a[3], a[4], a[5]}, tb{b[3], b[4], b[5]};
  const Pack3 theta = 0.5 * (ta + tb), h = 0.5 * (tb - ta), e = h - 0.5 * cross(theta, h);
  const Pack3 arm_a = load3(B.arm_a), arm_b = load3(B.arm_b), rotated_a = rotation_change(ta, arm_a),
              rotated_b = rotation_change(tb, arm_b);
  const Pack3 D = load3(B.gap) + (du + (rotated_b - rotated_a)), back = D - cross(theta, D);
  const Pack3 rotation = load3(B.rotation) + 2.0 * e, half = 0.5 * D;
  o.arm_a = (arm_a + rotated_a) + half;
  o.arm_b = (arm_b + rotated_b) - half;
  o.theta = theta;
  for (int i = 0; i < 3; ++i) {
    const Pack3 axis = load3(B.frame + 3 * i);
    o.gap[i] = dot(axis, back);
    o.gap[3 + i] = dot(axis, rotation);
  }
}

// Force and moment, world axes, to the rows of both ends.
template <class Ends>
ERBS_INLINE void write_wrenches(const Ends& B, Pack3 F, Pack3 moment, Pack3 arm_a, Pack3 arm_b, double* rows) {
  const Pack3 on_a = moment + cross(arm_a, F), on_b = cross(F, arm_b) - moment;
  const Pack out_a[8] = {F.x, F.y, F.z, on_a.x, on_a.y, on_a.z, on_a.y, on_a.z};
  const Pack out_b[8] = {-F.x, -F.y, -F.z, on_b.x, on_b.y, on_b.z, on_b.y, on_b.z};
  pack_to_rows(out_a, rows, begins(B.wrench_row_a).at);
  pack_to_rows(out_b, rows, begins(B.wrench_row_b).at);
}

// Resultants turn with the frame; the force acts at the midpoint of the material points.
ERBS_INLINE void write_joint_wrenches(const JointPack& B, const Relative& o, const Pack resultant[6], double* rows) {
  const Pack3 s = load3(B.frame), t = load3(B.frame + 3), n = load3(B.frame + 6);
  const auto in_world = [&](const Pack* x) {
    const Pack3 base = x[0] * s + x[1] * t + x[2] * n;
    return base + cross(o.theta, base);
  };
  write_wrenches(B, in_world(resultant), in_world(resultant + 3), o.arm_a, o.arm_b, rows);
}

// Bound: the greatest corner opening is exact for a rectangle and an upper bound for any other polygon; the greatest slip is an upper
// bound; compression capacity is looked at only where there is one.
ERBS_INLINE Pack yield_bound(const JointPack& B, const Pack gap[6]) {
  const Pack bend = abs(gap[3]) * load(B.half_t) + abs(gap[4]) * load(B.half_s), opening = gap[2] + bend;
  const Pack closing = bend - gap[2] - load(B.close_limit), torn = opening - load(B.open_limit);
  const Pack slip = sqrt(gap[0] * gap[0] + gap[1] * gap[1]) + abs(gap[5]) * load(B.radius);
  const Pack over = max(torn, closing), slid = slip + load(B.slip_slope) * opening - load(B.slip_limit);
  return max(over, slid);
}

static void elastic(const JointPack& B, const double* rows, ElasticPack& o) {
  Relative r;
  relative(B, rows, r);
  for (int i = 0; i < 6; ++i) store(o.gap[i], r.gap[i]), store(o.resultant[i], load(B.stiffness[i]) * r.gap[i]);
  store3(o.arm_a, r.arm_a);
  store3(o.arm_b, r.arm_b);
  store3(o.theta, r.theta);
  store(o.may_yield, yield_bound(B, r.gap));
}

static void wrenches(const JointPack& B, const ElasticPack& o, double* rows) {
  Relative r;
  r.arm_a = load3(o.arm_a), r.arm_b = load3(o.arm_b), r.theta = load3(o.theta);
  Pack resultant[6];
  for (int i = 0; i < 6; ++i) resultant[i] = load(o.resultant[i]);
  write_joint_wrenches(B, r, resultant, rows);
}

}  // namespace erbs::ERBS_TARGET
