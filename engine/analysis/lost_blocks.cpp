#include "engine/analysis/lost_blocks.h"

#include <algorithm>
#include <limits>

#include "engine/base/error.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

}  // namespace

std::string lost_blocks(const Model& m, const State& s) {
  const double g = m.gravity.norm();
  if (!(g > 0) || std::find(m.kind.begin(), m.kind.end(), Kind::fixed) == m.kind.end()) return {};
  const Vec3 up = -m.gravity / g;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int b = 0; b < m.nblock; ++b) low = std::min(low, up.dot(m.rest[z(b)])), high = std::max(high, up.dot(m.rest[z(b)]));
  int count = 0, first = -1;
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving || !(up.dot(m.rest[z(b)] + s.u[z(b)]) < low - (high - low))) continue;
    if (first < 0) first = b;
    ++count;
  }
  if (count == 0) return {};
  return fmt::format(
      "{} block{} fell past the ground by more than the height of the structure, '{}' the first of the scene; if what comes off "
      "should land, make the ground larger: ground{{ size = ... }}",
      count, count > 1 ? "s" : "", m.block_name[z(first)]);
}

}  // namespace erbs
