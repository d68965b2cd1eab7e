// Elastic pass of joints in their own frame: pose rows of blocks to relative displacements, resultants to wrench rows. kinematics.h gives
// the formulas.
#pragma once
#include "engine/joints/kernels.h"
#include "engine/laws/yield.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// Limits of eight joints (laws/yield.h), from a `JointPack` or from `IntactConstants`.
template <class Limits>
ERBS_INLINE YieldLimits<Pack> limits_of(const Limits& L) {
  return {load(L.open_limit), load(L.close_limit), load(L.slip_limit), load(L.slip_slope)};
}

struct Relative {
  Pack gap[6];         // m, rad: joint frame
  Pack3 arm_a, arm_b;  // m, from the centroids to where the force acts, world
  Pack3 theta;         // rad, mean rotation since the reference poses
};

// Starts of rows of eight doubles.
struct Begins {
  int at[pack_size];
};
ERBS_INLINE Begins begins(const int* row) {
  Begins out;
  for (int l = 0; l < pack_size; ++l) out.at[l] = 8 * row[l];
  return out;
}

// Change of x by a rotation t = tan(angle) about its axis, as in pose rows: to third order.
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

// Force and moment in world axes to the wrench rows of both ends.
template <class Ends>
ERBS_INLINE void write_wrenches(const Ends& B, Pack3 F, Pack3 moment, Pack3 arm_a, Pack3 arm_b, double* rows) {
  const Pack3 on_a = moment + cross(arm_a, F), on_b = cross(F, arm_b) - moment;
  const Pack out_a[8] = {F.x, F.y, F.z, on_a.x, on_a.y, on_a.z, on_a.y, on_a.z};
  const Pack out_b[8] = {-F.x, -F.y, -F.z, on_b.x, on_b.y, on_b.z, on_b.y, on_b.z};
  pack_to_rows(out_a, rows, begins(B.wrench_row_a).at);
  pack_to_rows(out_b, rows, begins(B.wrench_row_b).at);
}

// Resultants rotate with the frame; the force acts at the midpoint of the material points.
ERBS_INLINE void write_joint_wrenches(const JointPack& B, const Relative& o, const Pack resultant[6], double* rows) {
  const Pack3 s = load3(B.frame), t = load3(B.frame + 3), n = load3(B.frame + 6);
  const auto in_world = [&](const Pack* x) {
    const Pack3 base = x[0] * s + x[1] * t + x[2] * n;
    return base + cross(o.theta, base);
  };
  write_wrenches(B, in_world(resultant), in_world(resultant + 3), o.arm_a, o.arm_b, rows);
}

static void elastic(const JointPack& B, const double* rows, ElasticPack& o) {
  Relative r;
  relative(B, rows, r);
  for (int i = 0; i < 6; ++i) store(o.gap[i], r.gap[i]), store(o.resultant[i], load(B.stiffness[i]) * r.gap[i]);
  store3(o.arm_a, r.arm_a);
  store3(o.arm_b, r.arm_b);
  store3(o.theta, r.theta);
  store(o.may_yield, face_bound(limits_of(B), r.gap, load(B.half_s), load(B.half_t), load(B.radius)));
}

static void wrenches(const JointPack& B, const ElasticPack& o, double* rows) {
  Relative r;
  r.arm_a = load3(o.arm_a), r.arm_b = load3(o.arm_b), r.theta = load3(o.theta);
  Pack resultant[6];
  for (int i = 0; i < 6; ++i) resultant[i] = load(o.resultant[i]);
  write_joint_wrenches(B, r, resultant, rows);
}

}  // namespace erbs::ERBS_TARGET
