// What happened to joints since the last row, and is still to be written to events.csv: cracks, openings, and row by row what reset_J is
// made of.
#pragma once
#include "engine/record/run_writer.h"
#include "engine/solve/step.h"

namespace erbs {

struct JointEvents {
  double first_crack = -1;  // s
  long opened = 0;
  double listed = 0;  // J, of reset_J, in rows of events.csv
  std::vector<int> cracked_since, opened_since;
  std::vector<HandOver> handed_since;
};

template <class E, class F>
requires std::is_same_v<std::remove_const_t<E>, JointEvents>
void each(E& e, F&& f) {
  f("first_crack", e.first_crack);
  f("opened", e.opened);
  f("listed", e.listed);
  f("cracked_since", e.cracked_since);
  f("opened_since", e.opened_since);
  f("handed_since", e.handed_since);
}

// From the solver, which forgets them.
void take_events(JointEvents& events, Solver& solver);

// All that happened up to t (s), in rows of events.csv.
void write_events(JointEvents& events, double t, const Model& model, const State& state, RunWriter& writer);

// The same at the end of a run: of hand-overs only, with all that was lost since the last of them.
void write_last_events(JointEvents& events, double t, const Model& model, const State& state, RunWriter& writer);

}  // namespace erbs
