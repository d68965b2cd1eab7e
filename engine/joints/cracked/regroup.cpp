// Lanes of cracked joints, ordered anew while joints leave. A house that falls releases its joints one by one; without this, half of the
// lanes of its packs are empty. The order is a function of the State alone, so a resumed run has the same.
#include <algorithm>

#include "engine/base/count.h"
#include "engine/joints/cracked/cracked.h"
#include "engine/model/joint_packs.h"

namespace erbs {
namespace {

constexpr unsigned full = (1U << pack_size) - 1;

}  // namespace

void Cracked::move(int j, int to) {
  const int from = lane_of(j);
  store(group_[z(from / pack_size)], from % pack_size, true);
  vacate(from);
  put(j, to);
}

// Packs of one type share their shape: a joint of another type does not enter them.
int Cracked::fuller_lane(int j, int from) const {
  const Joint& joint = model_.joint[z(j)];
  for (int g = 0; g < from; ++g) {
    const Group& group = group_[z(g)];
    if (group.empty() || group.used == full || group.debonded != group_[z(from)].debonded) continue;
    if ((group.type != joint.type && group.type != nullptr) || !fits(group, joint)) continue;
    return g * pack_size + int(std::find(group.joint, group.joint + pack_size, -1) - group.joint);
  }
  return -1;
}

void Cracked::regroup() {
  for (int g = 0; g < groups(); ++g) {
    if (group_[z(g)].debonded) continue;
    for (int l = 0; l < pack_size; ++l) {
      const int j = group_[z(g)].joint[l];
      if (j >= 0 && debonded(j)) move(j, find_lane(model_.joint[z(j)], true));
    }
  }
  for (int g = groups() - 1; g > 0; --g)
    for (int l = 0; l < pack_size; ++l) {
      const int j = group_[z(g)].joint[l];
      const int to = j < 0 || group_[z(g)].used == full ? -1 : fuller_lane(j, g);
      if (to >= 0) move(j, to);
    }
  for (; groups() > 0 && group_.back().empty(); group_.pop_back(), state_.joints.pack.pop_back())
    if (group_.back().at + group_.back().room == memory_.size()) memory_.resize(group_.back().at);
}

}  // namespace erbs
