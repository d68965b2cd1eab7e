// Scatter of the strength from joint to joint: lognormal with mean 1, correlated over a length. model/build/strength_field.h draws it.
#pragma once
#include "engine/base/field.h"

namespace erbs {

struct Scatter {
  double cv = 0;      // coefficient of variation of the strength; 0: none
  double length = 0;  // m, correlation length; 0: each joint for itself
  int seed = 1;

  static Fields<Scatter> fields() {
    return {
        {"cv", &Scatter::cv, "", "coefficient of variation; each joint multiplies ft, c, Gf1 and Gf2 by one lognormal factor of mean 1", 0,
         2, true},
        {"length", &Scatter::length, "m", "correlation length: exp(-(r / length)^2) between joints r apart (0: independent)", 0, 1e6},
        {"seed", &Scatter::seed, "", "seed of the field; equal seeds give equal strengths", 0, 2147483647},
    };
  }
};

}  // namespace erbs
