#include "engine/record/results/lowered_supports.h"

#include <algorithm>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/rotation.h"
#include "engine/model/box_at_rest.h"

namespace erbs {
namespace {

// m, by which a support has been lowered where it bears a block.
double way_down(const Model& model, const BlockPoses& pose, const LoweredSupports::Ride& ride) {
  const std::size_t s = z(ride.bearer);
  const Vec3 arm = model.rest[z(ride.block)] - model.rest[s];
  return -(pose.u[s] + rotation_change(pose.q[s], arm)).z();
}

// Blocks that a joint ties or, for one without a joint, that touch at rest [nblock].
std::vector<std::vector<int>> neighbours(const Model& model) {
  constexpr double touching = 1e-3;  // of a block's thickness
  std::vector<std::vector<int>> next(model.kind.size());
  const auto tie = [&](std::size_t a, std::size_t b) { next[a].push_back(int(b)), next[b].push_back(int(a)); };
  for (const Joint& joint : model.joint) tie(z(joint.a), z(joint.b));
  std::vector<std::uint8_t> loose;
  std::vector<Eigen::AlignedBox3d> box;
  for (std::size_t b = 0; b < next.size(); ++b)
    box.push_back(box_at_rest(model, b)), loose.push_back(model.kind[b] == Kind::moving && next[b].empty());
  for (std::size_t a = 0; a < next.size(); ++a)
    for (std::size_t b = 0; loose[a] && b < next.size(); ++b)
      if (const bool once = !loose[b] || a < b; once && a != b)
        if (box[a].exteriorDistance(box[b]) <= touching * model.thickness[a]) tie(a, b);
  return next;
}

}  // namespace

std::vector<LoweredSupports::Ride> rides_of(const Model& model) {
  std::vector<LoweredSupports::Ride> out;
  if (model.prescribed_motions.empty()) return out;
  const std::vector<std::vector<int>> next = neighbours(model);
  for (int s = 0; s < model.nblock; ++s) {
    if (model.kind[z(s)] != Kind::driven) continue;
    std::vector<std::uint8_t> seen(next.size());
    for (std::vector<int> open{s}; !open.empty();) {
      const int at = open.back();
      open.pop_back();
      for (const int b : next[z(at)])
        if (model.kind[z(b)] == Kind::moving && !std::exchange(seen[z(b)], 1)) out.push_back({b, s}), open.push_back(b);
    }
  }
  std::ranges::stable_sort(out, {}, &LoweredSupports::Ride::block);
  return out;
}

void LoweredSupports::follow(const Model& model, const BlockPoses& pose, const std::vector<double>& start) {
  left.resize(ride.size());
  for (std::size_t i = 0; i < ride.size(); ++i) {
    const std::size_t b = z(ride[i].block);
    if (!left[i]) left[i] = way_down(model, pose, ride[i]) - (start[b] - pose.u[b].z()) > 0.5 * model.thickness[b];
  }
}

double LoweredSupports::lowered(const Model& model, const BlockPoses& pose, std::size_t b) const {
  double way = 0;
  for (const Ride& one : std::ranges::equal_range(ride, int(b), {}, &Ride::block))
    if (!left[std::size_t(&one - ride.data())]) way = std::max(way, way_down(model, pose, one));
  return way;
}

}  // namespace erbs
