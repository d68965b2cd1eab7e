// Bound on the time step by bodies that are about to touch, to touch with more of their faces, or to separate (`joints/event_bound.h`).
//
// A corner that strikes presses with a triangle of its face, an edge with a strip. The step then errs much less than for a whole face that
// lands flat. So an impact has the stiffness of the share of the face that sinks in within the next steps.
#pragma once
#include "engine/contact/law/pair.h"

namespace erbs {

// Separating feature (`ContactPair::separating_axis`) of a pair of small bodies that no longer touch and carry no force; -1: use
// `pair_force()`.
int cached_axis(const ContactPair& pair, const ContactShape& a, const ContactShape& b);
// Short evaluation of such a pair: true if the feature surely still separates the bodies. `result` is then that of `pair_force()`, to
// round-off. The pose of the view is not read, and the pair only if an impact is possible.
bool still_separated(int separating_axis, const ContactPair& pair, const PairFrame& frame, const ContactSettings& settings, double dt,
                     PairResult& result);

// For a touching pair after its evaluation: its patch may open, and a face about to fall flat may touch as a whole within a step or two.
// Sets `event_rate` and, if that is near, the impact rates of `result`. dt (s): upper bound of the next step.
void foresee(const ContactPair& pair, const PairFrame& frame, const ContactSettings& settings, double dt, PairResult& result);

// For a pair that is `apart` (m), as found by `pair_force()`: sets `event_rate` and, if an impact is possible within the next steps, its
// rates.
void impact_bound(const ContactPair& pair, const PairFrame& frame, const ContactSettings& settings, double apart, double dt,
                  PairResult& result);

}  // namespace erbs
