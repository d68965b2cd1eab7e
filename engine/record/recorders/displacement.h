// Recorder of block motion: displacement, velocity and acceleration of centroids or material points, rotation and angular velocity.
#pragma once
#include <string>
#include <vector>

#include "engine/record/recorders/joint_condition.h"
#include "engine/record/recorders/recorder.h"

namespace erbs {

struct BlockMotion {
  enum class What { displacement, velocity, acceleration, rotation, spin } what;
  std::vector<int> blocks;
  std::string name, axis;
  bool absolute, has_point;
  Vec3 point;  // m, position at rest

  static std::vector<Quantity> quantities() {
    return {{"displacement", "displacement from rest, mean over the blocks (m)"},
            {"velocity", "velocity, mean over the blocks (m/s)"},
            {"acceleration", "acceleration, mean over the blocks (m/s2)"},
            {"rotation", "rotation vector from rest, mean over the blocks (rad)"},
            {"spin", "angular velocity, mean over the blocks (rad/s)"}};
  }

  explicit BlockMotion(const RecorderRequest& request)
      : what(What(quantity_index(quantities(), request.recorder.quantity))),
        blocks(request.blocks),
        name(request.recorder.name),
        axis(request.recorder.axis),
        absolute(request.recorder.frame == "abs"),
        has_point(request.recorder.has_point),
        point(request.recorder.point) {}

  std::vector<std::string> columns() const {
    const std::string frame = absolute ? "abs" : "rel";
    switch (what) {
      case What::displacement:
        return axis_columns(name, axis, "u", frame + "_m");
      case What::velocity:
        return axis_columns(name, axis, "v", frame + "_m_s");
      case What::acceleration:
        return axis_columns(name, axis, "a", frame + "_m_s2");
      case What::rotation:
        return axis_columns(name, axis, "r", "rad");
      case What::spin:
        return axis_columns(name, axis, "w", "rad_s");
    }
    return {};
  }

  void needs(Needs&) const {}

  void sample(const Snapshot& s, double* out) const {
    Vec3 sum = Vec3::Zero();
    for (const int b : blocks) sum += of_block(s, std::size_t(b));
    put_axes(sum / double(blocks.size()), axis, out);
  }

 private:
  Vec3 of_block(const Snapshot& s, std::size_t b) const {
    const Vec3 rest_arm = has_point ? Vec3(point - s.model.rest[b]) : Vec3(Vec3::Zero());
    const Vec3 rotated = rotation_change(s.pose.q[b], rest_arm), arm = rest_arm + rotated;
    const MovingBlock m = what == What::displacement || what == What::rotation ? MovingBlock{} : s.motion(b);
    switch (what) {
      case What::displacement:
        return s.pose.u[b] + rotated + (absolute ? s.ground_u : Vec3(Vec3::Zero()));
      case What::velocity:
        return m.v + m.w.cross(arm) + (absolute ? s.ground_v : Vec3(Vec3::Zero()));
      case What::acceleration:
        return m.a + m.alpha.cross(arm) + m.w.cross(m.w.cross(arm)) + (absolute ? s.ground_a : Vec3(Vec3::Zero()));
      case What::rotation:
        return rotation_vector(s.pose.q[b]);
      case What::spin:
        return m.w;
    }
    return Vec3::Zero();
  }
};

}  // namespace erbs
