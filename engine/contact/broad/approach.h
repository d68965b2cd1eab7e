// Upper bounds of the motion of bodies towards each other.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/vec.h"

namespace erbs {

// The two greatest of many numbers.
struct Farthest {
  double greatest = 0, second = 0;

  void take(double x) {
    if (!(x <= greatest)) second = std::exchange(greatest, x);
    else second = std::max(second, x);
  }
  double two() const { return greatest + second; }
};

// m, path of a point at the distance `reach` (m) from the centroid, by rotation alone: |R - R0| (Frobenius) is 2 sqrt 2 sin(angle / 2); the
// chord is reach times that / sqrt 2.
inline double turning_path(const Mat3& from, const Mat3& to, double reach) { return reach * std::sqrt(0.5) * (to - from).norm(); }

// Upper bound of how far any two of `count` bodies have come towards each other, which does not contain the common motion of all.
// `moved(b)`: motion of body b, a vector; `rotated(b)`: what its rotation adds.
template <class Moved, class Turned>
double greatest_approach(std::size_t count, Moved moved, Turned rotated) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t b = 0; b < count; ++b) low = low.cwiseMin(moved(b)), high = high.cwiseMax(moved(b));
  const Vec3 together = (low + high) / 2;
  Farthest all, apart;
  for (std::size_t b = 0; b < count; ++b) {
    const Vec3 by = moved(b);
    const double more = rotated(b);
    all.take(std::max(0.0, by.norm() + more));
    apart.take(std::max(0.0, (by - together).norm() + more));
  }
  return std::min(all.two(), apart.two());
}

}  // namespace erbs
