// Debris at rest: which blocks sleep, and since when the others have been still (solve/sleep.h).
#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

struct Rest {
  std::vector<std::uint8_t> asleep;  // [nblock]; empty where the scene lets none
  std::vector<double> stirred;       // s, when the block was last seen to move; infinite for one not looked at yet [nblock]
  std::vector<double> slept_at;      // s, when a sleeper fell asleep [nblock]
  Vec3 pull = Vec3::Zero();          // m/s2, gravity less the ground's acceleration under which they lie still
  int count = 0;                     // of those asleep
};

// Every member that a checkpoint or a hash must hold.
template <class R, class F>
requires std::is_same_v<std::remove_const_t<R>, Rest>
void each(R& r, F&& f) {
  f("asleep", r.asleep), f("stirred", r.stirred), f("slept_at", r.slept_at), f("pull", r.pull), f("count", r.count);
}

}  // namespace erbs
