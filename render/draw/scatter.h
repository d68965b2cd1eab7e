// A number that looks random, and is the same in every run.
#pragma once
#include <cstdint>

namespace erbs::render {

inline double scatter(std::uint32_t x) {  // 0..1
  x = (x ^ 61U) ^ (x >> 16U);
  x *= 9U;
  x ^= x >> 4U;
  x *= 0x27d4eb2dU;
  x ^= x >> 15U;
  return static_cast<double>(x & 0xffffU) / 65535.0;
}

}  // namespace erbs::render
