// THE yield criterion of a bonded joint, and its bounds over a whole face. Templates on the scalar type, a number or a pack.
//
// A point yields when its tension exceeds ft, its shear exceeds the strength of bond and friction, or its pressure exceeds fc. With the
// coupling coulomb all of this is linear in displacements:
//   opening > open,   closing > close,   slip + slope opening > slip_limit.
// The other couplings bound shear by a curve below ft; there `open` is zero, so that any tension sends a joint to the exact criterion.
// The bounds of a face put its largest opening, closing and slip into the same inequalities. A face within its bound has no point that
// yields.
#pragma once
#include "engine/laws/bond.h"

namespace erbs::ERBS_TARGET {

// True where a point yields. `opening` (m), negative if closed; `slip_square` (m2), square of the slip.
template <class T>
ERBS_INLINE MaskFor<T> point_yields(const PointLaw& law, T opening, T slip_square) {
  const T sigma = law.kn * opening, strength = bond_shear(law, max(sigma, 0), T(0)) + law.mu * max(-sigma, 0);
  return (sigma > law.ft) | (law.ks * law.ks * slip_square > strength * strength);
}

// True where a corner of the face yields by its opening (m) alone: a dry joint opens, or mortar crushes.
template <class T>
ERBS_INLINE MaskFor<T> corner_yields(const PointLaw& law, T opening) {
  return (opening > (law.dry ? 0.0 : 1e300)) | (-law.kn * opening > (law.fc > 0 ? law.fc : 1e300));
}

// Limits of a bonded point in displacements.
template <class T>
struct YieldLimits {
  T open, close;  // m; `close` is infinite without a plateau
  T slip, slope;  // m, c / ks; mu kn / ks
};

ERBS_INLINE YieldLimits<double> yield_limits(const PointLaw& law) {
  constexpr double infinite = __builtin_inf();
  return {law.coupling == PointLaw::Coupling::coulomb ? law.ft / law.kn : 0, law.fc > 0 ? law.fc / law.kn : infinite,
          law.ks > 0 ? law.c / law.ks : infinite, law.ks > 0 ? law.mu * law.kn / law.ks : 0};
}

// Positive where a point may yield: its opening and closing (m), and its slip of at most sqrt(slip_square) + swing (m). The test of slip,
// slip > room, is written slip^2 > room |room|, which needs no root.
template <class T>
ERBS_INLINE T yield_bound(const YieldLimits<T>& limit, T opening, T closing, T slip_square, T swing) {
  const T room = (limit.slip - limit.slope * opening) - swing;
  return max(max(opening - limit.open, slip_square - room * abs(room)), closing - limit.close);
}

// The same for a whole face at the relative displacement `gap` (s, t, n in m; rotations in rad) of its joint: exact openings for a
// rectangle of the half sides, an upper bound for any other polygon within it and within `radius` of the centre.
template <class T>
ERBS_INLINE T face_bound(const YieldLimits<T>& limit, const T gap[6], T half_s, T half_t, T radius) {
  const T bend = abs(gap[3]) * half_t + abs(gap[4]) * half_s;
  return yield_bound(limit, gap[2] + bend, bend - gap[2], gap[0] * gap[0] + gap[1] * gap[1], abs(gap[5]) * radius);
}

}  // namespace erbs::ERBS_TARGET
