// Two levels of time while a few blocks keep the step short: contacts between other blocks act once in several steps (impulse multiple time
// stepping, Verlet-I or r-RESPA: Grubmueller, Heller, Windemuth and Schulten 1991; Tuckerman, Berne and Martyna 1992).
//
// A macro step of `TimeStep::substeps` steps begins with an evaluation of all interactions. Joints act in every step, and so do pairs with
// a fast block: one that has a joint or a former joint, or that bears no longer step (`ContactBound::divide`, `hasten`). A pair of two
// other, loose blocks is slow: it acts at the start of the macro step, with the impulse of all its steps. Loads and ground motion act on a
// block together with its slow pairs, else in every step (block_levels.h). Where an interval changes, the impulse has the mean of the last
// and the next interval, as the kick of the integrator has. With one step in a macro step this is the integrator of integrate.h to the last
// bit.
//
// Work. A kick J changes the kinetic energy by J (v- + v+) / 2. So the second half of the work of friction and dashpots is booked with the
// velocity right after the kick (`ContactForces::book_after_kick`). Elastic energy is a function of the pose. What is left in the ledger is
// the error of the integrator: (F_N - F_n) . a H^2 / 4 for an impulse interval H and the acceleration a by faster forces. It is zero to
// round-off for linear springs of one interval. In a blow both forces rise together, to a sum of F^2 H^2 / (8 m). So each block bears only
// an interval at which its slow forces err by little (`ContactBound::bears`).
//
// Resonance. Impulses of a slow spring excite a mode of frequency w when w H comes near a multiple of pi (Biesiadecki and Skeel 1993; Fong,
// Darve and Lew 2008). The macro step is therefore bounded by all that acts on a loose block, fast pairs included, at the same share of the
// limit as a step without levels; and no slow pair acts on a block with joints.
//
// Choice (`Solver::plan_macro_step`). Fast and loose blocks have the same rules for their step as a run with one level: limits, coming
// impacts and predicted events, each for its own part. A macro step shrinks at once and grows after a time without a limit, while the
// longer interval errs by no more than events may.
#pragma once
#include "engine/model/joint_packs.h"
#include "engine/model/state.h"

namespace erbs {

inline bool may_have_levels(const Model& model) {
  return model.analysis.contact_levels() > 1 && !model.analysis.unstable && model.analysis.solver == "leapfrog" && owner_computes(model) &&
         !model.dashpots;
}
inline constexpr int divide_every = 64;  // macro steps between two divisions of the blocks by the step that they bear
inline bool divides(const TimeStep& time) { return time.macro % divide_every == 0 && time.macro_steps_since_limited >= 0; }
// Steps in a macro step at most.
inline int most_steps(const Model& model) { return 1 << (model.analysis.contact_levels() - 1); }
// True in a step in which all interactions act.
inline bool at_macro_step(const TimeStep& time) { return time.substep == 0; }
// True if this macro step, or the one before, has more than one step.
inline bool has_levels(const TimeStep& time) { return time.substeps > 1 || time.last_substeps > 1; }
// s, what a decision of this macro step must look ahead: its length.
inline double macro_dt(const TimeStep& time) { return time.substeps > 1 ? time.substeps * time.dt : time.dt; }
// s, interval of a pair before and after the start of a macro step.
inline double interval_before(const TimeStep& time, bool slow) { return slow ? time.last_substeps * time.last_dt : time.last_dt; }
inline double interval_after(const TimeStep& time, bool slow) { return slow ? time.substeps * time.dt : time.dt; }

}  // namespace erbs
