// Constants of nature and of convention. SI inside, always; scripts use factors.
#pragma once

namespace erbs {
inline constexpr double standard_g = 9.81;  // m/s2, the value all sources of the project use
inline constexpr double pi = 3.14159265358979323846;
}  // namespace erbs
