// Response spectrum of a ground-motion record, exact for acceleration linear between points.
#pragma once
#include <vector>

#include "engine/loads/waves/polyline.h"

namespace erbs {

struct ResponsePoint {
  double period = 0;        // s
  double displacement = 0;  // m, peak relative to the ground
  double acceleration = 0;  // m/s2, pseudo-acceleration: displacement times (2 pi / period)^2
};

// Peak response over the record and after it. Within the record it is sampled at least 40 times per period, which finds a peak to 0.3 %.
std::vector<ResponsePoint> response_spectrum(const Polyline& acceleration, const std::vector<double>& periods, double damping_ratio);

// `count` periods from `low` to `high`, in equal ratios.
std::vector<double> spectrum_periods(double low, double high, int count);

}  // namespace erbs
