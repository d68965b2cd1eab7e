// Time of a step of a scene: the fast kernel against the reference, intact and broken, by number of threads. Also the bytes a step touches.
#pragma once
#include <cstdint>
#include <string>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/time_step_bound.h"

namespace erbs::study {

struct Timing {
  double user = 0, wall = 0;  // s per step: processor time of all threads, and elapsed time
  long steps = 0;             // number of timed steps
  double touching = 0;        // mean number of pairs in contact
  double dt = 0;              // s, mean
  std::uint64_t hash = 0;     // of the motion after `hash_steps` steps from the initial state
};

// Advances `state` by the first steps of a run.
void run_in(const Model& model, State& state, const StepRange& range, int threads);

// Steps a copy of `state` for about `seconds` of processor time. Times are medians of several stretches: for structures that only sway.
Timing time_steps(const Model& model, State state, const StepRange& range, const std::string& kernel, int threads, double seconds);

// Steps a copy of `state` to the time `until` (s). Times are means: for structures that fall apart. The work does not depend on the speed.
Timing time_course(const Model& model, State state, const StepRange& range, int threads, double until);

// Instructions of a step of the intact structure with every effect off, relative to the plain passes over joints and blocks. These passes
// contain no code for effects. 0 if instructions cannot be counted.
double instructions_over_bare(const Model& model, const State& state, const StepRange& range);

// The same state with every joint cracked, without bond or cohesion.
State all_broken(const Model& model, State state);

// Memory traffic (bytes) and arithmetic (flop) of one step of an intact structure, derived from layout and formulas, not measured.
struct Demand {
  double bytes = 0, flop = 0;
};
Demand demand(const Model& model);

}  // namespace erbs::study
