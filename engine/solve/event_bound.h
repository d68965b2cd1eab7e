// How long a step may be for what opens and closes next.
//
// Leapfrog conserves T_n+1/2 + k p_n p_n+1 / 2 of a spring that is pressed all the time. A one-sided one breaks that twice a blow: the kick
// that enters (p_n < 0 < p_n+1) loses k p_n+1 |p_n| / 2, the kick that leaves gains k p_n |p_n+1| / 2, where within a step the touch falls
// decides how much. At a rate of r (m/s) both are k (r dt)^2 / 8 at most. At omega dt = 1.8 a blow returns a fifth to five times its
// energy, twice on average, at .3 it errs by 4 %, at .1 by .2 %. So what is about to open or close is foreseen: each face says
//   dt_event = sqrt(budget / (k r^2 / 8)), the step by which its event errs by no more than `budget`,
//   in_time  = the time until then, over event_steps,
// and the step is no longer than the greater of the two. So it is shortened while blocks still fly, when that costs nothing: a change of
// dt errs by F^2 (dt_0^2 - dt_1^2) / (8 m), F the net force. It grows again once this is below the budget too (Solver::follow_contacts).
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

inline constexpr int foresee_every = 4;  // steps
// Of Energy::reference, by which one event may err: a hundred of them, of either sign, leave a third of the gate of 1e-3.
inline constexpr double event_tolerance = 3e-5;
// ... and all of them: as their sum comes near it, each may err by less.
inline constexpr double event_sum = 5e-4;

// Of many loose blocks each blow is a smaller part of the whole, and the gate is that of a collapse, 1e-2: both grow with the root of their
// number from 16 on. A pile of 300 takes 4 % more steps than without any bound, not 21 %, and its ledger is 5e-4, not 4e-3.
inline constexpr double most_for_many = 4;

// J, by which an event may err now; 0 where any may.
double event_allowance(const Model& model, const State& state);
// The same; 0 where none is to be looked for in this step.
double event_budget(const Model& model, const State& state);
// last_dt over the step that joint j allows, which was at q0 a step ago and is at q now; 0 where nothing is about to happen.
double foresee(const Model& model, const Joint& joint, const double q0[6], const double q[6], double budget);

}  // namespace erbs
