// The largest force of friction of a patch, by the interlock of its asperities (interlock.h). T is a number or a pack.
#pragma once
#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/law/pair_rows.h"
#include "engine/laws/slip.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// Compressive force of the patch (N), with that of the impact dashpot: friction of a blow follows both. Where a patch opens so fast that
// its dashpot takes all the pressure, what is left is round-off.
template <class T>
ERBS_INLINE T pressing_force(const PairPackFor<T>& w) {
  const T size = load<T>(w.size), sum = size + load<T>(w.damping[0]);
  return load<T>(w.p[p_kn]) * select(sum > 1e-12 * size, sum, T(0));
}

// In N; sets `held`. Interlock acts where faces lie flat on each other, not at edges and corners: with interlock there, bodies of a heap
// tremble for ever.
template <class T>
ERBS_INLINE T friction_limit(PairPackFor<T>& w, const PairSettings& set, Vec3<T> across) {
  const MaskFor<T> flat =
      load<T>(w.area) * (load<T>(w.r[b_inertia]) + load<T>(w.o[b_inertia])) > set.flat_face * (load<T>(w.r[b_mass]) + load<T>(w.o[b_mass]));
  const Interlock<T> lock = interlock_of<T>(set.interlock, load<T>(w.p[p_hop_time]), load<T>(w.p[p_hop_loan]));
  const MaskFor<T> slow = dot(across, across) < lock.slow;
  const T pressed = pressing_force<T>(w), before = load<T>(w.p[p_mean_normal_force]);
  T mean = before;
  const T interlocked = interlocked_stress(lock, mean, load<T>(w.p[p_lent]), T(0), pressed, slow),
          held = select(flat, interlocked, pressed);
  store(w.p[p_mean_normal_force], select(flat, mean, before));
  store(w.held, held);
  return load<T>(w.p[p_mu]) * held;
}

// What the pair has lent after this step, in which its springs took no more than the limit.
template <class T>
ERBS_INLINE void lend(PairPackFor<T>& w, const PairSettings& set) {
  const T lent = load<T>(w.p[p_lent]), pressed = pressing_force<T>(w), held = load<T>(w.held);
  if (!any((lent > 0) | (held > pressed))) return;
  const Vec3<T> t = load3(w.springs);
  const T about = (load<T>(w.torsion) + dot(load3(w.lever), t)) / nonzero(load<T>(w.radius));
  const T used = min(sqrt(dot(t, t) + about * about) / nonzero(load<T>(w.p[p_mu])), held);
  store(w.p[p_lent],
        lent_after(interlock_of<T>(set.interlock, load<T>(w.p[p_hop_time]), load<T>(w.p[p_hop_loan])), lent, pressed, held, used));
}

}  // namespace erbs::ERBS_TARGET
