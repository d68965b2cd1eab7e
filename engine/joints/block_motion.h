// THE relative pose of the two blocks of a joint, exact (kinematics.h explains it). A template on the scalar type, a number or a pack.
#pragma once
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// (R - I) a for the rotation by q. This form loses no digits for tiny rotations.
template <class T>
ERBS_INLINE Vec3<T> rotation_change(Quat<T> q, Vec3<T> a) {
  const Vec3<T> v{q.x, q.y, q.z}, va = cross(v, a);
  return T(2) * q.w * va + T(2) * cross(v, va);
}

// Two blocks as their joint sees them: rotated arms, relative displacement and rotation, world axes.
template <class T>
struct BlockMotionPair {
  Vec3<T> arm_a, arm_b, gap, rotation;  // m, m, m, rad
  Quat<T> sum;                          // of their quaternions: the rotation half way, of any length
  T two;                                // over the square of that length
  MaskFor<T> far;                       // rotated against each other beyond the range of the series for `rotation`
};

template <class T>
ERBS_INLINE BlockMotionPair<T> block_motion(Vec3<T> ua, Quat<T> qa, Vec3<T> ub, Quat<T> qb, Vec3<T> arm_a, Vec3<T> arm_b) {
  constexpr double c[] = {2, 2.0 / 3, 4.0 / 15, 4.0 / 35, 16.0 / 315, 16.0 / 693};  // 2 acos(w) / |v| in 1 - w
  T w = qb.w * qa.w + (qb.x * qa.x + qb.y * qa.y + qb.z * qa.z);
  if (any(w < 0)) {  // one of them has made a full turn: the other quaternion of its attitude
    const T side = select(w < 0, T(-1), T(1));
    qb = {side * qb.x, side * qb.y, side * qb.z, side * qb.w}, w = side * w;
  }
  const Vec3<T> va{qa.x, qa.y, qa.z}, vb{qb.x, qb.y, qb.z}, v = qa.w * vb - qb.w * va - cross(vb, va);
  const T y = 1 - w;
  BlockMotionPair<T> out;
  out.far = y > 2e-3;
  out.rotation = (c[0] + y * (c[1] + y * (c[2] + y * (c[3] + y * (c[4] + y * c[5]))))) * v;
  out.sum = {qa.x + qb.x, qa.y + qb.y, qa.z + qb.z, qa.w + qb.w};
  out.two = 1 / (1 + w);
  const Vec3<T> rotated_a = rotation_change(qa, arm_a), rotated_b = rotation_change(qb, arm_b);
  out.gap = (ub - ua) + rotated_b - rotated_a;
  out.arm_a = arm_a + rotated_a;
  out.arm_b = arm_b + rotated_b;
  return out;
}

}  // namespace erbs::ERBS_TARGET
