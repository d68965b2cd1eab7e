// Dry joint: linear in compression, no tension, Coulomb friction.
#pragma once
#include "engine/base/field.h"

namespace erbs {

struct DryFriction {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;

  static constexpr std::string_view law_name = "dry";
  static Fields<DryFriction> fields() {
    return {
        {"kn", &DryFriction::kn, "Pa/m", "normal stiffness of the joint", 1e3, 1e16, true},
        {"ks", &DryFriction::ks, "Pa/m", "shear stiffness of the joint (default 0.4 kn)", 0, 1e16},
        {"mu", &DryFriction::mu, "", "coefficient of friction", 0, 10, true},
    };
  }
};

}  // namespace erbs
