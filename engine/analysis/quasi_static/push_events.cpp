#include "engine/analysis/quasi_static/push_events.h"

#include "engine/analysis/quasi_static/push_curve.h"

namespace erbs::analysis {

void write_push_events(std::vector<std::uint8_t>& happened, const Model& model, const JointState& joints, const BlockPoses& pose, double t,
                       RunWriter& writer) {
  happened.resize(std::size_t(model.njoint), 0);
  for (int j = 0; j < model.njoint; ++j) {
    std::uint8_t& known = happened[std::size_t(j)];
    const auto tell = [&](std::uint8_t bit, bool so, const char* event, double value, const char* unit) {
      if (!so || (known & bit) != 0) return;
      known = std::uint8_t(known | bit);
      writer.event(t, event, model.joint_name(j), value, unit);
    };
    const JointChange change = joint_change(model, joints, pose, j);
    const bool bonded = model.laws[std::size_t(model.joint[std::size_t(j)].type->law)].has_bond();
    tell(1, bonded && change.now.damage > 0, "crack", change.now.damage, "share");
    tell(2, change.open, "open", change.now.opening, "m");
    tell(4, change.slid, "slide", change.now.slip, "m");
  }
}

}  // namespace erbs::analysis
