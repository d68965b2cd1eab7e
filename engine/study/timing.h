// How long a step of a scene takes: the kernel against the reference, sound and broken, by threads; and the bytes it touches.
#pragma once
#include <cstdint>
#include <string>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct Timing {
  double user = 0, wall = 0;  // s a step, of all threads together and by the clock
  long steps = 0;             // timed
  double touching = 0;        // pairs in contact, mean
  double dt = 0;              // s, mean
  std::uint64_t hash = 0;     // of the motion after `hash_steps` steps from the given state
};

// The first steps of a run, in place, as a run takes them.
void run_in(const Model& model, State& state, int threads);

// Steps a copy of `state` for about `seconds` of processor time; times are medians of several stretches, as of a structure that only sways.
Timing time_steps(const Model& model, State state, const std::string& kernel, int threads, double seconds);

// Steps a copy of `state` to the time `until` (s); times are means. For structures that come apart: the same work whatever the speed.
Timing time_course(const Model& model, State state, int threads, double until);

// Instructions of a step of the intact structure with every effect off, over those of the bare passes over joints and blocks, which
// know of no effect; 0 where instructions cannot be counted.
double instructions_over_bare(const Model& model, const State& state);

// Every joint cracked, without bond or cohesion, as it stands.
State all_broken(const Model& model, State state);

// What one step of a sound structure reads and writes (bytes) and computes (flop): from the layout and the formulas, not measured.
struct Demand {
  double bytes = 0, flop = 0;
};
Demand demand(const Model& model);

}  // namespace erbs
