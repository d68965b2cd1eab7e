// Law of a contact point, compiled from a Law into plain numbers for the inner loop.
#pragma once
#include <algorithm>
#include <cmath>

#include "engine/laws/laws.h"
#include "engine/laws/point.h"

namespace erbs {

// Opening at which damage p starts to grow further.
inline double kappa_at(const PointLaw& law, double p) { return law.opening_peak + p * (law.opening_ultimate - law.opening_peak); }

// Secant stiffness of an opened point at damage p: the line from the origin to the softening branch, where the tensile strength is
// ft (1 - p). This is the linear softening of Hillerborg et al. 1976 in damage form: unloading returns to zero opening, so that a crack
// closes at zero gap.
inline double secant(const PointLaw& law, double p) {
  if (p <= 0) return law.kn;
  if (p >= 1) return 0;
  const double opening = kappa_at(law, p);
  return opening > 0 ? law.ft * (1 - p) / opening : 0;
}

// Sets the damage of a point; p must not be below the present damage.
inline void damage_to(const PointLaw& law, PointHistory& h, double p) {
  h.damage = std::min(1.0, p);
  h.secant = secant(law, h.damage);
  h.kappa = kappa_at(law, h.damage);
}

inline double friction_at(const PointLaw& law, double p) { return law.mu + p * (law.mu_residual - law.mu); }

// Shear strength of the bond alone, at tension sigma (Pa) and damage p. The caller adds friction under compression. The coupling coulomb
// gives c - mu sigma; linear and ellipse reach zero shear at ft.
inline double bond_shear(const PointLaw& law, double sigma, double p) {
  const double c = law.c * (1 - p), ft = law.ft * (1 - p);
  if (sigma <= 0) return c;
  switch (law.coupling) {
    case PointLaw::Coupling::coulomb:
      return std::max(0.0, c - friction_at(law, p) * sigma);
    case PointLaw::Coupling::linear:
      return ft > 0 ? std::max(0.0, c * (1 - sigma / ft)) : 0;
    case PointLaw::Coupling::ellipse:
      return ft > 0 ? c * std::sqrt(std::max(0.0, 1 - sigma * sigma / (ft * ft))) : 0;
  }
  return 0;
}

PointLaw compile(const Law& law);

}  // namespace erbs
