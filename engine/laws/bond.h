// The bond of a contact point: shear strength, friction and damage. Templates on the scalar type, a number or a pack.
//
// Tension softens linearly (Hillerborg, Modeer and Petersson 1976) in damage form: the secant at damage p is the line from the origin to
// the softening branch, where the strength is ft (1 - p). Unloading returns to zero opening, so that a crack closes at zero gap.
#pragma once
#include "engine/laws/point.h"
#include "engine/simd/pack.h"

namespace erbs::ERBS_TARGET {

// Opening (m) at which damage p starts to grow further.
template <class T>
ERBS_INLINE T kappa_at(const PointLaw& law, T p) {
  return law.opening_peak + p * (law.opening_ultimate - law.opening_peak);
}

template <class T>
ERBS_INLINE T friction_at(const PointLaw& law, T p) {
  return law.mu + p * (law.mu_residual - law.mu);
}

// Shear strength (Pa) of the bond alone, at tension sigma >= 0 (Pa) and damage p; zero at p = 1. Friction under compression comes on top.
// The coupling coulomb gives c - mu sigma; linear and ellipse reach zero shear at ft.
template <class T>
ERBS_INLINE T bond_shear(const PointLaw& law, T sigma, T p) {
  const T left = 1 - p;
  if (law.coupling == PointLaw::Coupling::coulomb) return select(p < 1, max(law.c * left - friction_at(law, p) * sigma, 0), T(0));
  const T ft = law.ft * left, use = sigma / nonzero(ft);
  T share = law.coupling == PointLaw::Coupling::linear ? max(1 - use, 0) : sqrt(max(1 - use * use, 0));
  share = select(sigma > 0, select(ft > 0, share, T(0)), T(1));
  return select(p < 1, law.c * left * share, T(0));
}

// History of the bond of a point, as in `PointHistory`.
template <class T>
struct Bond {
  T damage, secant, kappa;
  ERBS_INLINE T stiffness(const PointLaw& law) const { return select(damage > 0, secant, T(law.kn)); }  // Pa/m, in tension
};

// Raises the damage where `marked`; `to` must not be below the present damage.
template <class T, class M>
ERBS_INLINE void damage_to(const PointLaw& law, Bond<T>& b, M marked, T to) {
  const T d = min(to, 1), opening = kappa_at(law, d);
  const T secant = select((d < 1) & (opening > 0), law.ft * (1 - d) / nonzero(opening), T(0));
  b.damage = select(marked, d, b.damage);
  b.kappa = select(marked, opening, b.kappa);
  b.secant = select(marked, select(d > 0, secant, T(law.kn)), b.secant);
}

// Damage by the widest opening of a point's cell (m), where the point `holds`. Returns the tension (Pa) at the point's own opening, which
// weakens its shear strength.
template <class T, class M>
ERBS_INLINE T damage_by_opening(const PointLaw& law, Bond<T>& b, M holds, T widest, T opening) {
  const M more = holds & (widest > select(b.damage > 0, b.kappa, T(law.opening_peak)));
  if (any(more)) {
    const double span = law.opening_ultimate - law.opening_peak;
    damage_to(law, b, more, span > 0 ? T((widest - law.opening_peak) / span) : T(1));
  }
  return select(holds & (opening > 0), b.stiffness(law) * opening, T(0));
}

// Loss of the bond by crushing: the deepest closing of the cell (m) exceeds the ultimate one and the plateau. Tension is lost with it.
template <class T, class M>
ERBS_INLINE void damage_by_closing(const PointLaw& law, Bond<T>& b, M holds, T deepest, T& sigma) {
  const M crushed = holds & (deepest > law.closing_ultimate) & (deepest > law.fc / law.kn);
  if (any(crushed)) damage_to(law, b, crushed, T(1));
  sigma = select(crushed, T(0), sigma);
}

}  // namespace erbs::ERBS_TARGET
