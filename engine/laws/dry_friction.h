// Dry joint: linear in compression, no tension, Coulomb friction.
//
// A block that slides on an elastic bed can be unstable by itself if its pressure is eccentric. Friction follows the pressure, which makes
// the stiffness unsymmetric; two modes of the bed may then merge and grow. This is flutter by mode coupling (Martins, Oden and Simoes
// 1990; Hoffmann et al. 2002; closed form in scenes/verify/v10_flutter.lua). Real joints lose energy at their asperities, which ends it.
#pragma once
#include "engine/laws/law.h"

namespace erbs {
struct DryFriction;
}

#ifdef ERBS_HOST
namespace erbs {

struct DryFriction {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;
  // A face that falls flat rebounds with exp(-pi xi / sqrt(1 - xi^2)) = 0.37 of its speed, like contacts at the default restitution of 0.3.
  double damping = 0.3;  // of critical, once the joint has opened or slipped; before that damping{} applies
  double interlock = 1;  // 0: friction follows the current pressure alone (interlock.h)

  static constexpr std::string_view law_name = "dry";
  static constexpr std::string_view help = "A dry joint: linear in compression, no tension, Coulomb friction.";
  static Fields<DryFriction> fields() {
    return {
        {"kn", &DryFriction::kn, "Pa/m", "normal stiffness of the joint", 1e3, 1e16, true},
        {"ks", &DryFriction::ks, "Pa/m", "shear stiffness of the joint (default 0.4 kn)", 0, 1e16},
        {"mu", &DryFriction::mu, "", "coefficient of friction", 0, 10, true},
        {"damping", &DryFriction::damping, "", "viscous ratio of a joint that has opened or slid, relative to its critical value", 0, 1},
        {"interlock", &DryFriction::interlock, "",
         "1: friction of slowly sliding faces follows their mean pressure; 0: the momentary pressure, as in theory", 0, 1},
    };
  }
  std::string complete() {
    if (ks == 0) ks = 0.4 * kn;
    return "";
  }
  PointLaw compile() const {
    PointLaw p;
    p.kn = kn;
    p.ks = ks > 0 ? ks : 0.4 * kn;
    p.mu = p.mu_residual = mu;
    p.damping = damping;
    p.interlock = interlock > 0;
    p.dry = true;
    return p;
  }
  static LawEffects<DryFriction> effects() {
    return {{"damping of dry joints", [](const DryFriction& d) { return d.damping > 0; }, [](DryFriction& d) { d.damping = 0; }, true}};
  }
};

}  // namespace erbs
#endif
