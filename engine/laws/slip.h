// Shear of a contact point: the return map of its friction, its softening, and what its dashpots may add. Templates on the scalar type, a
// number or a pack.
#pragma once
#include "engine/laws/bond.h"
#include "engine/laws/interlock.h"

namespace erbs::ERBS_TARGET {

template <class T>
struct InPlane {
  T s, t;
  friend ERBS_INLINE T square(InPlane a) { return a.s * a.s + a.t * a.t; }
};

// THE return map of friction: the elastic slip scaled back to `limit` where it `slides`; `size` is its length, in the unit of `limit`.
template <class T, class M>
ERBS_INLINE InPlane<T> radial_return(InPlane<T> trial, T size, T limit, M slides) {
  const T keep = select(slides, limit / nonzero(size), T(1));
  return {keep * trial.s, keep * trial.t};
}

// Shear of a point beyond its limit: radial return of the elastic slip (m) to `cap` (N), with the energies of the step (J).
template <class T>
struct SlipReturn {
  InPlane<T> elastic;    // m, in: of the trial; out: at the limit
  InPlane<T> plastic;    // m, in and out: plastic slip
  T friction, fracture;  // J, out
};

// `k` (N/m): shear stiffness of the point; `size` (N): of the trial's shear; `pressure` (N): its compressive force; `sigma` (Pa): its
// tension; `weight` (m2); `before` (m): slip one step ago less the plastic slip. Where a point with a bond slips, cohesion softens: the
// limit falls linearly with the slip that it allows, size - k slip = cap + slope slip. The work of a spring over a step is the mean of its
// two tractions times the slip; its part beyond friction is the loss of the bond.
template <class T, class M>
ERBS_INLINE void return_slip(const PointLaw& law, Bond<T>& b, bool bonds, M slides, T k, T weight, T size, T cap, T pressure, T sigma,
                             InPlane<T> before, SlipReturn<T>& slip) {
  M bonded{};
  T friction = friction_at(law, b.damage);
  if (bonds && law.c > 0) bonded = slides & (b.damage < 1);
  if (any(bonded)) {
    T to = T(1);
    if (law.slip_ultimate > 0) {
      const T slope = k + ((law.mu_residual - law.mu) * pressure - law.c * weight) / law.slip_ultimate;
      to = select(slope > 0, b.damage + (size - cap) / nonzero(slope) / law.slip_ultimate, T(1));
    }
    damage_to(law, b, bonded, to);
    friction = friction_at(law, b.damage);
    cap = select(bonded, bond_shear(law, sigma, b.damage) * weight + friction * pressure, cap);
  }
  const InPlane<T> trial = slip.elastic;
  slip.elastic = radial_return(trial, size, cap, slides);
  const T ds = trial.s - slip.elastic.s, dt = trial.t - slip.elastic.t;
  slip.plastic = {slip.plastic.s + ds, slip.plastic.t + dt};
  const T work = 0.5 * ((k * before.s + k * slip.elastic.s) * ds + (k * before.t + k * slip.elastic.t) * dt);
  const T most = friction * pressure * (size - cap) / nonzero(k);
  slip.friction = select(bonded & (most < work), most, work);
  slip.fracture = work - slip.friction;
}

// The share of a dashpot's shear `drag` that a point can bear on top of `present`, so that both together stay within `limit` (N or m, like
// the shears); 1 where not `past`.
template <class T, class M>
ERBS_INLINE T share_within(InPlane<T> present, InPlane<T> drag, T limit, M past) {
  const T size = square(drag), along = present.s * drag.s + present.t * drag.t, room = max(limit * limit - square(present), 0);
  return select(past, (sqrt(along * along + size * room) - along) / nonzero(size), T(1));
}

// The limits of interlock of a joint in a step.
template <class T>
struct Interlock {
  T gap{}, slow{}, loan{}, rate{};  // m; square of the largest slip; s; share of the difference by which the mean is updated
  double dt = 0;                    // s, since the last evaluation
  bool updates = false;
};
template <class T>
ERBS_INLINE Interlock<T> interlock_of(const InterlockStep& step, T hop_time, T hop_loan) {
  const T way = interlock_speed * step.gravity * step.slip_time * hop_time;
  const bool updates = step.since > 0;
  return {interlock_gap * step.gravity * hop_time * hop_time,
          way * way,
          hop_loan,
          updates ? select(hop_time > 0, step.since / (step.since + interlock_time * hop_time), T(0)) : T(0),
          step.dt,
          updates};
}

// The pressure (Pa) that friction of a point follows (interlock.h): its momentary pressure `stress`, or the mean if that is higher, the
// faces are `slow` and the gap (m) is small; less what is to be paid back of `lent` (Pa s) if it is lower. Updates the mean.
template <class T, class M>
ERBS_INLINE T interlocked_stress(const Interlock<T>& lock, T& mean, T lent, T gap, T stress, M slow) {
  if (lock.updates) mean = mean + (stress - mean) * lock.rate;
  const T held = select(lent > 0, max(mean, stress - lent * (lock.dt > 0 ? 1 / lock.dt : 0)), stress);
  return select(mean > stress, select((gap < lock.gap) & slow & (lent < lock.loan * (mean - stress)), mean, stress), held);
}

// What is lent after this step, in which friction followed the pressure `held` and was that of the pressure `used` (Pa).
template <class T>
ERBS_INLINE T lent_after(const Interlock<T>& lock, T lent, T stress, T held, T used) {
  return select((lent > 0) | (held > stress), max(lent + (used - stress) * lock.dt, 0), T(0));
}

// The pressure (Pa) that gives a shear of `size` (N) beyond the `strength` (N) of the bond.
template <class T>
ERBS_INLINE T pressure_of_friction(T size, T strength, T friction, T weight) {
  return max(size - strength, 0) / nonzero(friction * weight);
}

// Whether a joint slides slowly: the change of its relative displacement over a step, rotation taken at `radius` (m).
template <class T>
ERBS_INLINE MaskFor<T> slides_slowly(const Interlock<T>& lock, const T gap[6], const T before[6], T radius) {
  const T ds = gap[0] - before[0], dt = gap[1] - before[1], rotation = (gap[5] - before[5]) * radius;
  return ds * ds + dt * dt + rotation * rotation < lock.slow;
}

}  // namespace erbs::ERBS_TARGET
