// Random numbers that are the same on every machine: splitmix64 (Steele, Lea and Flood 2014).
#pragma once
#include <cstdint>

namespace erbs {

struct Random {
  std::uint64_t state = 0;

  std::uint64_t next() {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double uniform() { return double(next() >> 11) * 0x1p-53; }  // in [0, 1)
  double within(double reach) { return reach * (2 * uniform() - 1); }
};

}  // namespace erbs
