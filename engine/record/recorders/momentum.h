// Recorder of momentum: linear, and angular about a point at rest (default: origin). World axes, relative to the ground.
#pragma once
#include <string>
#include <vector>

#include "engine/record/recorders/recorder.h"

namespace erbs {

// Sum over the given blocks; without blocks, over all moving blocks.
struct Momentum {
  enum class What { momentum, angular_momentum } what;
  std::vector<int> blocks;
  std::string name, axis;
  Vec3 point;  // m

  static std::vector<Quantity> quantities() {
    return {{"momentum", "linear momentum relative to the ground, summed over the blocks (kg m/s); without blocks: over all that move"},
            {"angular_momentum", "angular momentum about the point, or the origin, world axes, summed likewise (kg m2/s)"}};
  }

  explicit Momentum(const RecorderRequest& request)
      : what(What(quantity_index(quantities(), request.recorder.quantity))),
        blocks(request.blocks),
        name(request.recorder.name),
        axis(request.recorder.axis),
        point(request.recorder.point) {
    if (!blocks.empty()) return;
    for (int b = 0; b < request.model.nblock; ++b)
      if (request.model.kind[std::size_t(b)] == Kind::moving) blocks.push_back(b);
  }

  std::vector<std::string> columns() const {
    return what == What::momentum ? axis_columns(name, axis, "p", "kg_m_s") : axis_columns(name, axis, "L", "kg_m2_s");
  }

  void needs(Needs&) const {}

  void sample(const Snapshot& s, double* out) const {
    Vec3 sum = Vec3::Zero();
    for (const int i : blocks) {
      const auto b = std::size_t(i);
      const MovingBlock m = s.motion(b);
      const Vec3 p = s.model.mass[b] * m.v;
      sum += what == What::momentum ? p : Vec3(m.spin_momentum + Vec3(s.model.rest[b] + s.pose.u[b] - point).cross(p));
    }
    put_axes(sum, axis, out);
  }
};

}  // namespace erbs
