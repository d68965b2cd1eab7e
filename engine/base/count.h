// Indices and counts are ints; containers take them as std::size_t.
#pragma once
#include <cstddef>

namespace erbs {
constexpr std::size_t z(int i) { return static_cast<std::size_t>(i); }
}  // namespace erbs
