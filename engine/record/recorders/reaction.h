// Recorder of forces on blocks: forces of joints and contacts, and forces of the loads.
#pragma once
#include <string>
#include <vector>

#include "engine/record/recorders/recorder.h"

namespace erbs {

// Sum of force or moment over the given blocks; moments are about `point` (default: origin). Without blocks, the sum of `reaction` is over
// all fixed and driven blocks: the action of the whole structure on its supports. A standing house gives fz = -weight. The sum of `load` is
// then over the others, the moving blocks.
struct Reaction {
  enum class What { reaction, reaction_moment, load, load_moment } what;
  std::vector<int> blocks;
  std::string name, axis;
  Vec3 point;  // m

  static std::vector<Quantity> quantities() {
    return {{"reaction", "force of joints and contacts on the blocks, summed (N); without blocks: on all supports"},
            {"reaction_moment", "its moment about the point, or the origin (N m)"},
            {"load", "force of the loads on the blocks, summed (N), gravity and ground motion left out"},
            {"load_moment", "its moment about the point, or the origin (N m)"}};
  }

  explicit Reaction(const RecorderRequest& request)
      : what(What(quantity_index(quantities(), request.recorder.quantity))),
        blocks(request.blocks),
        name(request.recorder.name),
        axis(request.recorder.axis),
        point(request.recorder.point) {
    if (!blocks.empty()) return;
    for (int b = 0; b < request.model.nblock; ++b)
      if ((request.model.kind[std::size_t(b)] != Kind::moving) != of_load()) blocks.push_back(b);
  }

  std::vector<std::string> columns() const {
    return of_moment() ? axis_columns(name, axis, "m", "N_m") : axis_columns(name, axis, "f", "N");
  }

  void needs(Needs& n) const { (of_load() ? n.load_wrench : n.block_wrench) = true; }

  void sample(const Snapshot& s, double* out) const {
    const std::span<const Vec6> wrench = of_load() ? s.load_wrench : s.block_wrench;
    ERBS_ASSERT(wrench.size() >= std::size_t(s.model.nblock));
    Vec3 sum = Vec3::Zero();
    for (const int i : blocks) {
      const auto b = std::size_t(i);
      const Vec3 force = wrench[b].head<3>();
      if (of_moment()) sum += wrench[b].tail<3>() + Vec3(s.model.rest[b] + s.pose.u[b] - point).cross(force);
      else sum += force;
    }
    put_axes(sum, axis, out);
  }

 private:
  bool of_load() const { return what == What::load || what == What::load_moment; }
  bool of_moment() const { return what == What::reaction_moment || what == What::load_moment; }
};

}  // namespace erbs
