#include "engine/solve/blocks/islands.h"

#include <numeric>

#include "engine/base/count.h"
#include "engine/joints/kinematics.h"

namespace erbs {
namespace {

int root(std::vector<int>& parent, int b) {
  while (parent[z(b)] != b) b = parent[z(b)] = parent[z(parent[z(b)])];
  return b;
}

}  // namespace

void find_islands(const Model& m, State& s) {
  std::iota(s.topology.island.begin(), s.topology.island.end(), 0);
  std::fill(s.topology.joined.begin(), s.topology.joined.end(), std::uint8_t(0));
  std::fill(s.topology.grounded.begin(), s.topology.grounded.end(), std::uint8_t(0));
  const auto anchors = [&](int b) { return m.kind[z(b)] == Kind::fixed; };
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const int a = m.joint[z(j)].a, b = m.joint[z(j)].b;
    s.topology.joined[z(a)] = s.topology.joined[z(b)] = 1;
    // the ground does not rotate, so it does not make one island of all blocks on it
    if (anchors(a) || anchors(b)) continue;
    const int ra = root(s.topology.island, a), rb = root(s.topology.island, b);
    s.topology.island[z(std::max(ra, rb))] = std::min(ra, rb);
  }
  s.topology.unjoined = 0;
  for (int b = 0; b < m.nblock; ++b) {
    s.topology.island[z(b)] = root(s.topology.island, b);
    s.topology.unjoined += m.kind[z(b)] == Kind::moving && !s.topology.joined[z(b)];
  }
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const int a = m.joint[z(j)].a, b = m.joint[z(j)].b;
    if (anchors(a) && !anchors(b)) s.topology.grounded[z(s.topology.island[z(b)])] = 1;
    if (anchors(b) && !anchors(a)) s.topology.grounded[z(s.topology.island[z(a)])] = 1;
  }
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::driven) s.topology.grounded[z(s.topology.island[z(b)])] = 1;
  for (int b = 0; b < m.nblock; ++b) s.topology.grounded[z(b)] = s.topology.grounded[z(s.topology.island[z(b)])];
}

// Block by block: a joint's geometry follows from the reference poses of its two blocks.
bool take_outdated_poses(const Model& m, State& s, std::vector<std::uint8_t>& outdated) {
  outdated.assign(z(m.nblock) + 1, 0);
  for (int j = 0; j < m.njoint; ++j)  // blocks with an intact joint; other joints are evaluated at the present poses
    if (s.joints.stage[z(j)] == JointStage::intact) outdated[z(m.joint[z(j)].a)] = outdated[z(m.joint[z(j)].b)] = 1;
  const double limit = s.cache.lazy_rotation * s.cache.lazy_rotation;
  bool past = false;
  for (int b = 0; b < m.nblock; ++b) {
    double square = 0;
    for (int i = 3; i < 6; ++i)
      square += s.cache.increment[z(b / pack_size)].x[i][b % pack_size] * s.cache.increment[z(b / pack_size)].x[i][b % pack_size];
    past = past || (outdated[z(b)] && square > limit);
    outdated[z(b)] = outdated[z(b)] && square > 0.25 * limit;
  }
  if (!past) return false;
  for (int b = 0; b < m.nblock; ++b)
    if (outdated[z(b)]) set_reference(s, b);
  return true;
}

}  // namespace erbs
