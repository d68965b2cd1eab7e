// Debris at rest: which blocks sleep, and since when the other blocks have been still (solve/contacts/sleep.h).
#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

struct SleepState {
  std::vector<std::uint8_t> asleep;       // [nblock]; empty if the scene allows no sleep
  std::vector<double> last_motion;        // s, time of the last motion of a block; infinite if not checked yet [nblock]
  std::vector<double> slept_at;           // s, time at which a sleeping block fell asleep [nblock]
  Vec3 effective_gravity = Vec3::Zero();  // m/s2, effective gravity (gravity minus ground acceleration) of their rest
  int count = 0;                          // number of sleeping blocks
};

// All members that a checkpoint or a hash must contain.
template <class R, class F>
requires std::is_same_v<std::remove_const_t<R>, SleepState>
void each(R& r, F&& f) {
  f("asleep", r.asleep), f("last_motion", r.last_motion), f("slept_at", r.slept_at), f("effective_gravity", r.effective_gravity),
      f("count", r.count);
}

}  // namespace erbs
