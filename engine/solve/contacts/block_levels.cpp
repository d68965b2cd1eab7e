#include "engine/solve/contacts/block_levels.h"

#include "engine/base/count.h"
#include "engine/model/levels.h"

namespace erbs {
void BlockLevels::start_macro_step(std::span<const std::uint8_t> was_slow, std::vector<std::uint8_t> slow) {
  since_.resize(block_groups(model_.nblock) * pack_size);
  next_.resize(since_.size());
  for (int b = 0; b < model_.nblock; ++b) {
    since_[z(b)] = interval_before(state_.time, was_slow[z(b)] != 0);
    next_[z(b)] = interval_after(state_.time, slow[z(b)] != 0);
  }
  slow_ = std::move(slow);
  within_ = false;
}

void BlockLevels::substep() {
  if (std::exchange(within_, true)) return;
  since_.resize(block_groups(model_.nblock) * pack_size);
  next_.resize(since_.size());
  for (int b = 0; b < model_.nblock; ++b) since_[z(b)] = next_[z(b)] = slow_[z(b)] != 0 ? 0 : state_.time.dt;
}

}  // namespace erbs
