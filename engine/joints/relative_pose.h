// Geometry of eight joints from the poses of their blocks (block_motion.h).
#pragma once
#include <math.h>

#include "engine/joints/block_motion.h"
#include "engine/joints/elastic_kernel.h"
#include "engine/joints/kernels.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// One number of each joint, straight into a register.
ERBS_INLINE Pack gathered(const double* const* from, int i) { return Pack::gather(from, i); }
ERBS_INLINE Pack3 gathered3(const double* const* from, int apart) {
  return {gathered(from, 0), gathered(from, apart), gathered(from, 2 * apart)};
}
ERBS_INLINE Quat<Pack> gathered4(const double* const* from) {
  const Pack3 v = gathered3(from, pack_size);
  return {v.x, v.y, v.z, gathered(from, 3 * pack_size)};
}

static void pose(PosePack& p, JointPack& out) {
  const auto of = block_motion(gathered3(p.ua, pack_size), gathered4(p.qa), gathered3(p.ub, pack_size), gathered4(p.qb),
                               gathered3(p.arm_a, 1), gathered3(p.arm_b, 1));
  store(p.far, select(of.far, Pack(1), Pack(0)));
  store3(out.arm_a, of.arm_a);
  store3(out.arm_b, of.arm_b);
  store3(out.gap, of.gap);
  store3(out.rotation, of.rotation);
  const Mat3<Pack> mean = rotation_of(of.sum, of.two);
  for (int i = 0; i < 3; ++i)
    store3(out.frame + 3 * i, mean * Pack3{gathered(p.rest, 3 * i), gathered(p.rest, 3 * i + 1), gathered(p.rest, 3 * i + 2)});
}

// The relative rotation of blocks far rotated against each other: `rotation_vector()` of vec.h, lane by lane.
[[gnu::noinline, maybe_unused]] static void large_rotation(const Pack a[4], const Pack b[4], unsigned far, Pack rotation[3]) {
  double out[3][pack_size];
  for (int i = 0; i < 3; ++i) rotation[i].store(out[i]);
  for (; far != 0; far &= far - 1) {
    const int l = __builtin_ctz(far);
    const double x = a[3][l] * b[0][l] - b[3][l] * a[0][l] - (b[1][l] * a[2][l] - b[2][l] * a[1][l]),
                 y = a[3][l] * b[1][l] - b[3][l] * a[1][l] - (b[2][l] * a[0][l] - b[0][l] * a[2][l]),
                 z = a[3][l] * b[2][l] - b[3][l] * a[2][l] - (b[0][l] * a[1][l] - b[1][l] * a[0][l]),
                 w = b[3][l] * a[3][l] + (b[0][l] * a[0][l] + b[1][l] * a[1][l] + b[2][l] * a[2][l]);
    const double sign = w < 0 ? -1 : 1, sine = sqrt(x * x + y * y + z * z), share = 2 * sign * atan2(sine, sign * w) / sine;
    out[0][l] = share * x, out[1][l] = share * y, out[2][l] = share * z;
  }
  for (int i = 0; i < 3; ++i) rotation[i] = Pack::load(out[i]);
}

// A cracked joint between the poses of its blocks.
struct JointMotion {
  Pack gap[6];         // m, rad: joint frame
  Pack3 arm_a, arm_b;  // m, from the centroids to where the force acts, world
  Pack3 axis[3];       // s, t, n
};

// `poses`: of each block displacement and attitude.
ERBS_INLINE void relative_motion(const CrackedPack& B, const FacePack& face, const double* poses, JointMotion& o) {
  Pack a[8], b[8];
  rows_to_pack(poses, begins(B.a).at, a);
  rows_to_pack(poses, begins(B.b).at, b);
  auto of = block_motion(Pack3{a[0], a[1], a[2]}, Quat<Pack>{a[3], a[4], a[5], a[6]}, Pack3{b[0], b[1], b[2]},
                         Quat<Pack>{b[3], b[4], b[5], b[6]}, load3(B.arm_a), load3(B.arm_b));
  if (any(of.far)) {
    Pack rotation[3] = {of.rotation.x, of.rotation.y, of.rotation.z};
    large_rotation(a + 3, b + 3, bits(of.far), rotation);
    of.rotation = {rotation[0], rotation[1], rotation[2]};
  }
  const Pack3 half = 0.5 * of.gap;
  o.arm_a = of.arm_a + half;
  o.arm_b = of.arm_b - half;
  const Quat<Pack> m = of.sum, r = load4(face.frame);
  const Mat3<Pack> frame =
      transposed(rotation_of(Quat<Pack>{m.w * r.x + m.x * r.w + m.y * r.z - m.z * r.y, m.w * r.y + m.y * r.w + m.z * r.x - m.x * r.z,
                                        m.w * r.z + m.z * r.w + m.x * r.y - m.y * r.x, m.w * r.w - m.x * r.x - m.y * r.y - m.z * r.z},
                             of.two));
  for (int i = 0; i < 3; ++i) {
    o.axis[i] = frame.row[i];
    o.gap[i] = dot(o.axis[i], of.gap);
    o.gap[3 + i] = dot(o.axis[i], of.rotation);
  }
}

// Resultants to wrench rows; the force acts at the midpoint of the material points.
ERBS_INLINE void write_joint_wrenches(const CrackedPack& B, const JointMotion& o, const Pack resultant[6], double* rows) {
  const auto in_world = [&](const Pack* x) { return x[0] * o.axis[0] + x[1] * o.axis[1] + x[2] * o.axis[2]; };
  write_wrenches(B, in_world(resultant), in_world(resultant + 3), o.arm_a, o.arm_b, rows);
}

static void intact_geometry(const JointPack& B, const IntactInput& lane, IntactPack& out) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  const Pack sign = load(lane.sign);
  const Mask from_b = sign < 0;
  Pack bend[6] = {};
  for (int axis = 0; axis < 3; ++axis) {
    const Pack k = 2 * gathered(lane.bending, axis);
    for (int i = 0; i < 6; ++i) bend[i] -= k * load(B.frame[3 * axis + row[i]]) * load(B.frame[3 * axis + column[i]]);
  }
  for (int i = 0; i < 6; ++i) store(out.bend[i], bend[i]);
  for (int i = 0; i < 3; ++i) {
    const Pack a = load(B.arm_a[i]), b = load(B.arm_b[i]);
    store(out.gap[i], sign * load(B.gap[i]));
    store(out.rotation[i], 0.5 * sign * load(B.rotation[i]));
    store(out.normal[i], sign * load(B.frame[6 + i]));
    store(out.arm_a[i], select(from_b, b, a));
    store(out.arm_b[i], select(from_b, a, b));
  }
}

}  // namespace erbs::ERBS_TARGET
