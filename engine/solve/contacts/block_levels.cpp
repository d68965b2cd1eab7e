#include "engine/solve/contacts/block_levels.h"

#include <algorithm>
#include <cstdint>

#include "engine/model/levels.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// The greatest level of the pairs of each block [nblock].
std::vector<int> slowest(const std::vector<ContactPair>& pairs, std::span<const int> live, std::uint8_t ContactPair::*level, int nblock) {
  std::vector<int> out(z(nblock), 0);
  for (const int i : live) {
    const ContactPair& pair = pairs[z(i)];
    for (const int b : {pair.a, pair.b}) out[z(b)] = std::max(out[z(b)], int(pair.*level));
  }
  return out;
}

}  // namespace

void BlockLevels::start(std::span<const int> live) {
  const TimeStep& time = state_.time;
  const std::vector<ContactPair>& pairs = state_.contacts.list.pair;
  const std::vector<int> before = slowest(pairs, live, &ContactPair::level, model_.nblock);
  level_ = slowest(pairs, live, &ContactPair::next_level, model_.nblock);
  since_.assign(block_groups(model_.nblock) * pack_size, 0.0);
  next_ = since_;
  for (int b = 0; b < model_.nblock; ++b) {
    const bool joined = state_.topology.joined[z(b)] != 0;
    if (joined) level_[z(b)] = time.joint_level;
    since_[z(b)] = joined ? time.since_joints : (1 << before[z(b)]) * time.last_dt;
    next_[z(b)] = (1 << level_[z(b)]) * time.dt;
  }
}

void BlockLevels::substep(std::span<const int> live, bool anew) {
  const TimeStep& time = state_.time;
  if (anew || level_.empty()) {
    level_ = slowest(state_.contacts.list.pair, live, &ContactPair::level, model_.nblock);
    for (int b = 0; b < model_.nblock; ++b)
      if (state_.topology.joined[z(b)]) level_[z(b)] = time.joint_level;
    next_.assign(block_groups(model_.nblock) * pack_size, 0.0);
  }
  for (int b = 0; b < model_.nblock; ++b) next_[z(b)] = acts(level_[z(b)], time.substep) ? (1 << level_[z(b)]) * time.dt : 0;
  since_ = next_;
}

}  // namespace erbs
