#include "engine/model/lost_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

Vec3 place_of(const Model& m, const State& s, int b) { return m.rest[z(b)] + s.pose.u[z(b)]; }

// m, along `up`: the lowest corner of what does not move by itself. What is still above it may slide down a slope.
double foot_of_ground(const Model& m, const Vec3& up) {
  double low = std::numeric_limits<double>::infinity();
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] == Kind::moving) continue;
    for (const Polyhedron& part : m.parts[z(b)])
      for (const Vec3& corner : part.vertices) low = std::min(low, up.dot(corner));
  }
  return low;
}

}  // namespace

std::vector<int> blocks_past_ground(const Model& m, const State& s) {
  const double g = m.gravity.norm();
  if (!(g > 0) || std::ranges::find(m.kind, Kind::fixed) == m.kind.end()) return {};
  const Vec3 up = -m.gravity / g;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int b = 0; b < m.nblock; ++b) {
    const double at = up.dot(m.rest[z(b)]), half = 0.5 * m.smallest_edge[z(b)];  // blocks may all lie at one height
    low = std::min(low, at - half), high = std::max(high, at + half);
  }
  std::vector<int> out;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving && up.dot(place_of(m, s, b)) < low - (high - low)) out.push_back(b);
  return out;
}

std::string lost_blocks(const Model& m, const State& s) {
  std::vector<int> lost = blocks_past_ground(m, s);
  if (lost.empty()) return {};
  const Vec3 up = -m.gravity.normalized();
  const double foot = foot_of_ground(m, up);
  std::erase_if(lost, [&](int b) { return up.dot(place_of(m, s, b)) > foot; });
  if (lost.empty()) return {};
  double farthest = 0;  // m, horizontal distance from the centre of the ground
  for (const int b : lost) farthest = std::max(farthest, place_of(m, s, b).head<2>().lpNorm<Eigen::Infinity>() + m.smallest_edge[z(b)]);
  const std::size_t count = lost.size();
  const Vec3 at = place_of(m, s, lost.front());
  return fmt::format(
      "{} fell past the ground by more than the height of the structure, '{}' the first of the scene, now at ({:.3g}, {:.3g}, "
      "{:.3g}) m; if what comes off should land, make the ground larger: ground{{ size = {:g} }} reaches below {}",
      counted(count, "block"), m.block_name[z(lost.front())], at.x(), at.y(), at.z(), std::ceil(2 * farthest + 1),
      count > 1 ? "all of them" : "it");
}

}  // namespace erbs
