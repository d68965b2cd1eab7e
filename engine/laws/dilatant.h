// Dry joint of rough faces that mate: sliding rides up their asperities and wears them down. Dilatancy with degradation.
//
// Slip away from the mated position lifts the faces by tan(psi) of its length (Patton 1966, psi: dilation angle), slip back lowers them.
// The angle falls with the way slid: tan(psi) (1 - way / wear_slip), zero from `wear_slip` on. In Plesha's law (1987) it falls
// exponentially with the work of friction; the linear fall has a plain closed form and an end. Straight away, the faces rise by
//   uplift(slip) = tan(psi) slip (1 - slip / (2 wear_slip)), at most tan(psi) wear_slip / 2.
// Slip and way are those of the whole face, the mean of its points. Faces ride and wear while they are a joint, in tiny hops too. Friction
// is Coulomb's, of the pressure alone, as in 3DEC: mu includes what the asperities add to it. The uplift takes part of the work of
// friction, (mu - tan(psi)) N slip is lost, so tan(psi) must be below mu.
//
// Opening is measured between the lifted faces. Uplift presses the faces, pressure brakes the slip, so both are solved together: the step's
// uplift belongs to the slip ds = (ks |s| - mu p) / (ks + mu kn tan(psi)), with |s| the elastic slip of the trial and p the mean pressure
// before it rises. (Uplift one step late would be negative damping.) The next step starts from the uplift of the true slip. The change of
// uplift does the work of the mean normal force of two steps, which closes the ledger to round-off. A joint goes over to contact once its
// asperities are worn, or as soon as it opens, tips or has slid by 5 % of its side, by which its fixed overlap then errs. Contact keeps the
// uplift it has. With psi = 0 the law is that of DryFriction to the last bit.
#pragma once
#include "engine/laws/face.h"
#include "engine/laws/law.h"

namespace erbs {
struct Dilatant;
}

namespace erbs::ERBS_TARGET {

struct DilatantFace : ElasticFace {
  static constexpr bool lifts = true;
  enum { uplift, used, way, slip_s, slip_t, count };  // m; `uplift` of the slip so far, `used`: in the last step
  static constexpr int numbers = count;

  // m, by which a slip of the face to `slip` lifts it further; `wears`: the part of the slip on which asperities are left.
  template <class T>
  static ERBS_INLINE T rise(const PointLaw& law, const T* own, InPlane<T> slip, T& wears) {
    const T length = sqrt(square(InPlane<T>{slip.s - own[slip_s], slip.t - own[slip_t]}));
    const T away = sqrt(square(slip)) - sqrt(square(InPlane<T>{own[slip_s], own[slip_t]}));  // from the mated position
    wears = max(min(length, law.own[1] - own[way]), 0);
    return law.own[0] * (1 - (own[way] + 0.5 * wears) / law.own[1]) * wears * away / nonzero(length);
  }
  // m, by which the slip of this step lifts the faces: `gap_s`, `gap_t` (m) in the plane of the joint, under the force (N) before.
  template <class T>
  static ERBS_INLINE T coming_rise(const PointLaw& law, const T* own, T gap_s, T gap_t, T force, T area) {
    const T s = gap_s - own[slip_s], t = gap_t - own[slip_t], size = sqrt(s * s + t * t);
    const T pressure = force / nonzero(area), over = max(law.ks * size - law.mu * pressure, 0);
    const T radius = sqrt(own[slip_s] * own[slip_s] + own[slip_t] * own[slip_t]);
    const T along = select(radius > 0, (s * own[slip_s] + t * own[slip_t]) / nonzero(radius * size), T(1));  // cosine of its direction
    const T angle = law.own[0] * max(1 - own[way] / law.own[1], 0) * along;
    const T slides = over / max(law.ks + law.mu * law.kn * angle, 0.1 * law.ks) / nonzero(size);
    T wears;
    return rise(law, own, InPlane<T>{own[slip_s] + slides * s, own[slip_t] + slides * t}, wears);
  }
  // Advances the history to the mean plastic slip (m) of the face; `now` (m): the lift used in this step.
  template <class T>
  static ERBS_INLINE void advance(const PointLaw& law, T* own, InPlane<T> slip, T now) {
    T wears;
    own[uplift] = own[uplift] + rise(law, own, slip, wears);
    own[used] = now;
    own[way] = own[way] + wears;
    own[slip_s] = slip.s, own[slip_t] = slip.t;
  }
  // 1 where the joint may go over to contact; `gap` as the joint sees it, range as in joints/joint_forces.h.
  template <class T>
  static ERBS_INLINE T released(const PointLaw& law, const T* own, const T gap[6], T half_s, T half_t) {
    const T least = min(half_s, half_t), rotated = gap[3] * gap[3] + gap[4] * gap[4];
    const T slid = gap[0] * gap[0] + gap[1] * gap[1], nearest = gap[2] - abs(gap[3]) * half_t - abs(gap[4]) * half_s;
    return select((own[way] >= law.own[1]) | (slid > 0.01 * least * least) | (rotated > 0.03 * 0.03) | (nearest > 0.004 * least) |
                      (law.own[0] + 0 * least <= 0),
                  T(1), T(0));
  }
};
template <>
struct FaceOf<Dilatant> {
  using type = DilatantFace;
};

}  // namespace erbs::ERBS_TARGET

#ifdef ERBS_HOST
#include <cmath>

namespace erbs {

struct Dilatant {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;
  double psi = 0;        // rad
  double wear_slip = 0;  // m
  double damping = 0.3;  // as in DryFriction, like `interlock`
  double interlock = 1;

  static constexpr std::string_view law_name = "dilatant";
  static constexpr std::string_view help =
      "A dry joint of rough faces: sliding lifts them at the angle psi, which falls to zero over the slip `wear_slip`.";
  static Fields<Dilatant> fields() {
    return {
        {"kn", &Dilatant::kn, "Pa/m", "normal stiffness of the joint", 1e3, 1e16, true},
        {"ks", &Dilatant::ks, "Pa/m", "shear stiffness of the joint (default 0.4 kn)", 0, 1e16},
        {"mu", &Dilatant::mu, "", "coefficient of friction, asperities included", 0, 10, true},
        {"psi", &Dilatant::psi, "rad", "dilation angle of the unworn faces; its tangent must be below mu", 0, 0.8, true},
        {"wear_slip", &Dilatant::wear_slip, "m", "slip at which the asperities are worn off", 1e-6, 1, true},
        {"damping", &Dilatant::damping, "", "viscous ratio of a joint that has opened or slid, relative to its critical value", 0, 1},
        {"interlock", &Dilatant::interlock, "", "as in dry{}", 0, 1},
    };
  }
  std::string complete() {
    if (ks == 0) ks = 0.4 * kn;
    return "";
  }
  std::vector<std::string> mistakes() const {
    if (std::tan(psi) < mu || psi == 0) return {};
    return {fmt::format("tan(psi) = {:.3g} is not below mu = {:g}, so that sliding would create energy; give a smaller psi", std::tan(psi),
                        mu)};
  }
  PointLaw compile() const {
    PointLaw p;
    p.kn = kn;
    p.ks = ks > 0 ? ks : 0.4 * kn;
    p.mu = p.mu_residual = mu;
    p.damping = damping;
    p.interlock = interlock > 0;
    p.dry = true;
    p.own[0] = std::tan(psi);
    p.own[1] = wear_slip;
    return p;
  }
  static LawEffects<Dilatant> effects() {
    return {{"dilatancy", [](const Dilatant& d) { return d.psi > 0; }, [](Dilatant& d) { d.psi = 0; }},
            {"damping of rough joints", [](const Dilatant& d) { return d.damping > 0; }, [](Dilatant& d) { d.damping = 0; }, true}};
  }
};

}  // namespace erbs
#endif
