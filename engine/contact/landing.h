// How long a step may be for bodies that are about to meet, to meet with more of their faces, or to part (solve/event_bound.h).
//
// A corner that strikes presses with a triangle of its face, an edge with a strip: what a step errs by is a small part of what it would
// err by had the whole face landed flat. So the stiffness of what lands is that of the share of the face that sinks in within the next steps.
#pragma once
#include "engine/contact/contact.h"

namespace erbs {

// What keeps a pair of small bodies apart that touch no more and bear nothing (Pair::separating), -1 where it is to go to pair_force().
int short_keeper(const Pair& pair, const ContactShape& a, const ContactShape& b);
// Such a pair in short: true where that surely keeps them apart still. `result` then has what pair_force() gives, to round-off. The pose of
// the view is not asked for, and the pair only where the bodies may land.
bool stands_apart(int keeper, const Pair& pair, const View& view, const ContactSettings& settings, double dt, PairResult& result);

// Of a pair that touches and has been evaluated: its patch may let go, and a face that is about to fall flat meets all of it within a step or
// two. Sets `haste` and, where that is near, the rates of landing of `result`. dt (s): the next step at most.
void foresee(const Pair& pair, const View& view, const ContactSettings& settings, double dt, PairResult& result);

// Of a pair that is `apart` (m), as pair_force() finds it: sets `haste` and, where they may meet within the next steps, the rates of landing.
void landing(const Pair& pair, const View& view, const ContactSettings& settings, double apart, double dt, PairResult& result);

}  // namespace erbs
