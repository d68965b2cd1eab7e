// Physical constants and conventions. The engine computes in SI; scripts use factors.
#pragma once
#include <limits>

namespace erbs {
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double standard_g = 9.81;  // m/s2, the value in all sources of the project
inline constexpr double pi = 3.14159265358979323846;
}  // namespace erbs
