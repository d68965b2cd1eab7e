// Recorders of the ground's motion, and of counts over the whole model.
#pragma once
#include <string>
#include <vector>

#include "engine/record/recorders/recorder.h"

namespace erbs {

struct GroundMotion {
  enum class What { acceleration, velocity, displacement, gravity } what;
  std::string name, axis;

  static std::vector<Quantity> quantities() {
    return {{"ground_acceleration", "acceleration of the ground (m/s2); always written, as ground_ax_m_s2 ..., where the ground moves"},
            {"ground_velocity", "velocity of the ground (m/s)"},
            {"ground_displacement", "displacement of the ground (m)"},
            {"gravity", "gravity (m/s2); always written, as gravity_ax_m_s2 ..., where it tilts"}};
  }

  explicit GroundMotion(const RecorderRequest& request)
      : what(What(quantity_index(quantities(), request.recorder.quantity))), name(request.recorder.name), axis(request.recorder.axis) {}

  std::vector<std::string> columns() const {
    switch (what) {
      case What::acceleration:
      case What::gravity:
        return axis_columns(name, axis, "a", "m_s2");
      case What::velocity:
        return axis_columns(name, axis, "v", "m_s");
      case What::displacement:
        return axis_columns(name, axis, "u", "m");
    }
    return {};
  }
  void needs(Needs&) const {}
  void sample(const Snapshot& s, double* out) const {
    const Vec3* values[] = {&s.ground_a, &s.ground_v, &s.ground_u, &s.gravity};
    put_axes(*values[int(what)], axis, out);
  }
};

struct Count {
  enum class What { contact_points, joints_broken } what;
  std::string name;

  static std::vector<Quantity> quantities() {
    return {{"contact_points", "points in contact, in the whole model"}, {"joints_broken", "joints broken, in the whole model"}};
  }

  explicit Count(const RecorderRequest& request)
      : what(What(quantity_index(quantities(), request.recorder.quantity))), name(request.recorder.name) {}

  std::vector<std::string> columns() const { return {name + (what == What::contact_points ? "_contact_points" : "_joints_broken")}; }
  void needs(Needs&) const {}
  void sample(const Snapshot& s, double* out) const { out[0] = what == What::contact_points ? s.contact_points : s.joints_broken; }
};

}  // namespace erbs
