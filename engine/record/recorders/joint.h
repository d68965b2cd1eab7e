// Recorder of joints between two sets of blocks: opening, slip, forces, moment and damage.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "engine/record/recorders/joint_condition.h"
#include "engine/record/recorders/recorder.h"

namespace erbs {

// Joints with one side in `blocks` and the other in `others`; an empty set stands for all blocks.
struct JointQuantity {
  enum class What { opening, slip, normal_force, shear_force, joint_moment, damage, broken, normal_stress, shear_stress, crushing } what;
  std::string name, axis;
  std::vector<int> joints;
  std::vector<double> sign;  // +1 if side a is in `blocks`, -1 if side b is
  Vec3 centre;               // m, area-weighted centre of the joints at rest

  static std::vector<Quantity> quantities() {
    return {{"opening", "largest opening of the joints (m)"},
            {"slip", "largest slip of the joints (m)"},
            {"normal_force", "force across the joints, summed, tension positive (N); zero once contact has replaced a joint"},
            {"shear_force", "length of the sum of the forces along the joints (N); likewise"},
            {"joint_moment", "moment of the joints on the blocks, about the common centre of the joints at rest (N m); likewise"},
            {"damage", "share of the joints' area that is damaged, 0 to 1"},
            {"broken", "number of joints with no bond left"},
            {"normal_stress",
             "normal stress of the joints, tension positive (Pa): mean over their area, least (the greatest compression), greatest; "
             "zero once contact has replaced a joint"},
            {"shear_stress", "shear stress of the joints (Pa): shear force over their area, and the greatest at a contact point; likewise"},
            {"crushing", "compressive strength that crushing has taken, as a share, mean over the joints' area (0 to 1)"}};
  }

  explicit JointQuantity(const RecorderRequest& request);

  std::vector<std::string> columns() const {
    switch (what) {
      case What::opening:
        return {name + "_opening_m"};
      case What::slip:
        return {name + "_slip_m"};
      case What::normal_force:
        return {name + "_normal_N"};
      case What::shear_force:
        return {name + "_shear_N"};
      case What::joint_moment:
        return axis_columns(name, axis, "m", "N_m");
      case What::damage:
        return {name + "_damage"};
      case What::broken:
        return {name + "_broken"};
      case What::normal_stress:
        return {name + "_normal_stress_mean_Pa", name + "_normal_stress_min_Pa", name + "_normal_stress_max_Pa"};
      case What::shear_stress:
        return {name + "_shear_stress_mean_Pa", name + "_shear_stress_max_Pa"};
      case What::crushing:
        return {name + "_crushing"};
    }
    return {};
  }

  void needs(Needs& n) const {
    if (what == What::normal_force || what == What::shear_force || what == What::joint_moment || what == What::normal_stress ||
        what == What::shear_stress)
      n.joint_force = true;
  }

  void sample(const Snapshot& s, double* out) const;
};

}  // namespace erbs
