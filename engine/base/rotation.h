// Change of an arm under a rotation.
#pragma once
#include "engine/base/vec.h"

namespace erbs {

// (R - I) a = 2 w (v x a) + 2 v x (v x a) for q = (w, v). This form loses no digits for tiny rotations.
inline Vec3 rotation_change(const Quat& q, const Vec3& a) {
  const Vec3 v = q.vec(), va = v.cross(a);
  return 2 * q.w() * va + 2 * v.cross(va);
}

}  // namespace erbs
