// Joint events since the last row that are not yet in events.csv: cracks, openings, and the parts of reset_J row by row.
#pragma once
#include "engine/record/folder/run_writer.h"
#include "engine/solve/step.h"

namespace erbs::analysis {

struct JointEvents {
  double first_crack = -1;  // s
  long released = 0;
  double listed = 0;  // J, part of reset_J listed in events.csv so far
  std::vector<int> cracked_since, released_since;
  std::vector<JointRelease> releases_since;
};

template <class E, class F>
requires std::is_same_v<std::remove_const_t<E>, JointEvents>
void each(E& e, F&& f) {
  f("first_crack", e.first_crack);
  f("released", e.released);
  f("listed", e.listed);
  f("cracked_since", e.cracked_since);
  f("released_since", e.released_since);
  f("releases_since", e.releases_since);
}

// Takes the events from the solver, which clears them.
void take_events(JointEvents& events, Solver& solver);

// Writes all events up to now as rows of events.csv.
void write_events(JointEvents& events, const Snapshot& now, RunWriter& writer);

// The same at the end of a run: only releases to contact, and all energy lost since the last of them.
void write_last_events(JointEvents& events, double t, const Model& model, const Energy& energy, RunWriter& writer);

}  // namespace erbs::analysis
