// Dry joint: linear in compression, no tension, Coulomb friction.
//
// A block that slides on an elastic bed is unstable in itself where its pressure lies off the middle: friction follows the pressure, which
// makes the stiffness unsymmetric, and two modes of the bed may then merge and grow (flutter by mode coupling: Martins, Oden and Simoes
// 1990; Hoffmann et al. 2002; scenes/verify/v10_flutter.lua has it on paper). What real joints lose at their asperities ends it.
#pragma once
#include "engine/base/field.h"

namespace erbs {

struct DryFriction {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;
  // A face that falls flat comes back with exp(-pi xi / sqrt(1 - xi^2)) = .37 of its speed, as contacts do at the default restitution of .3.
  double damping = 0.3;  // of critical, once the joint has opened or slid; until then it is as damping{} says
  double interlock = 1;  // 0: friction goes by the pressure of the moment alone (interlock.h)

  static constexpr std::string_view law_name = "dry";
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
};

}  // namespace erbs
