// From a measured displacement or velocity to the acceleration: twice differentiated through a cubic smoothing spline (Reinsch 1967).
#pragma once
#include <string_view>
#include <vector>

#include "engine/base/error.h"

namespace erbs {

struct Differentiated {
  std::vector<double> acceleration;  // m/s2 at the times; linear in between, as a cubic spline has it
  double rms = 0;                    // m, of the spline against the given displacement
};

// The spline s minimises sum (y - s)^2 + lambda Int s''^2 dt with s' = 0 at the first time: the ground starts from rest. At the frequency f
// it keeps the share 1 / (1 + (f / corner)^4) of the amplitude, without phase lag (lambda = 1 / (step (2 pi corner)^4)). A velocity is
// integrated first, linear between its points. Values: m or m/s; corner: Hz. Throws Error if the corner does not lie below half the
// sampling rate.
Differentiated differentiated(const std::vector<double>& times, std::vector<double> values, std::string_view quantity, double corner,
                              const Place& place);

}  // namespace erbs
