#include "engine/record/results/lowered_supports.h"

#include <algorithm>
#include <cmath>
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
  return -upwards(model).dot(pose.u[s] + rotation_change(pose.q[s], arm));
}

// Blocks that each block bears at rest: those whose joint faces upwards, and those that lie on it without one [nblock].
std::vector<std::vector<int>> borne_by(const Model& model) {
  constexpr double touching = 1e-3;  // of a block's thickness
  constexpr double level = 0.02;     // of a unit normal: a head joint bears nothing
  std::vector<std::vector<int>> out(model.kind.size());
  for (const Joint& joint : model.joint) {
    const double up = joint.type->frame.col(2).dot(upwards(model));  // of the normal from a to b
    if (up > level) out[z(joint.a)].push_back(joint.b);
    if (up < -level) out[z(joint.b)].push_back(joint.a);
  }
  std::vector<Eigen::AlignedBox3d> box;
  std::vector<std::size_t> order;  // from left to right
  for (std::size_t b = 0; b < out.size(); ++b) box.push_back(box_at_rest(model, b)), order.push_back(b);
  std::ranges::sort(order, {}, [&](std::size_t b) { return box[b].min().x(); });
  const auto lies_on = [&](std::size_t upper, std::size_t lower) {
    return model.kind[upper] == Kind::moving &&
           std::fabs(box[upper].min().z() - box[lower].max().z()) <= touching * model.thickness[upper] &&
           box[upper].min().y() < box[lower].max().y() && box[lower].min().y() < box[upper].max().y();
  };
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && box[order[k]].min().x() < box[order[i]].max().x(); ++k) {
      const std::size_t a = order[i], b = order[k];
      if (lies_on(a, b)) out[b].push_back(int(a));
      if (lies_on(b, a)) out[a].push_back(int(b));
    }
  return out;
}

}  // namespace

Vec3 upwards(const Model& model) {
  const double size = model.gravity.norm();
  return size > 0 ? Vec3(model.gravity / -size) : Vec3::UnitZ();
}

double height_above_rest(const Model& model, const BlockPoses& pose, std::size_t b) { return upwards(model).dot(pose.u[b]); }

std::vector<LoweredSupports::Ride> rides_of(const Model& model) {
  std::vector<LoweredSupports::Ride> out;
  if (model.prescribed_motions.empty()) return out;
  const std::vector<std::vector<int>> next = borne_by(model);
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
    if (!left[i]) left[i] = way_down(model, pose, ride[i]) - (start[b] - height_above_rest(model, pose, b)) > 0.5 * model.thickness[b];
  }
}

void LoweredSupports::leave(int block) {
  for (std::size_t i = 0; i < ride.size(); ++i)
    if (ride[i].block == block) left[i] = 1;
}

double LoweredSupports::lowered(const Model& model, const BlockPoses& pose, std::size_t b) const {
  double way = 0;
  const auto first = std::ranges::lower_bound(ride, int(b), {}, &Ride::block);
  for (std::size_t i = std::size_t(first - ride.begin()); i < ride.size() && ride[i].block == int(b); ++i)
    if (!left[i]) way = std::max(way, way_down(model, pose, ride[i]));
  return way;
}

}  // namespace erbs
