// Levels: each contact acts at its own interval, a power of two times the step (impulse multiple time stepping, Verlet-I or r-RESPA:
// Grubmueller, Heller, Windemuth and Schulten 1991; Tuckerman, Berne and Martyna 1992).
//
// A macro step of `TimeStep::substeps` steps begins with an evaluation of all interactions. A pair of level l acts at every 2^l-th step,
// with an impulse of 2^l times its force; between these steps it does not act. Joints act in every step, or in every 2^joint_level-th while
// contacts about to land need a shorter one. Loads and ground motion act on a block together with its joints, or with its slowest pair
// (solve/contacts/block_levels.h). Where an interval changes, the impulse has the mean of the last and the next interval, as the kick of
// the integrator has. With one level this is the integrator of integrate.h to the last bit.
//
// Work. A kick J changes the kinetic energy by J (v- + v+) / 2. So the second half of the work of friction and dashpots is booked with the
// velocity right after the kick (`ContactForces::book_after_kick`). Elastic energy is a function of the pose. What is left in the ledger is
// the error of the integrator: (F_N - F_n) . a H^2 / 4 for an impulse interval H and the acceleration a by faster forces. It is zero to
// round-off for linear springs of one level.
//
// Resonance. Impulses of a slow spring excite a mode of frequency w when w H comes near a multiple of pi (Biesiadecki and Skeel 1993; Fong,
// Darve and Lew 2008). The interval of a pair is therefore bounded by all that acts on its two blocks, not by the pair alone: w H stays at
// or below 1, with w from the stiffness on the block, joints included. A pair on a block with stiff joints acts as often as they do.
//
// Longer intervals. Leapfrog returns the energy error F^2 H^2 / 8m of a spring when its force returns to zero; a longer H in between keeps
// it. So intervals grow only while all that grow together err by less than events may, and none grows in an impact.
//
// On trial, and off by default: tests/bench/README.md lists what differs with it.
#pragma once
#include "engine/model/state.h"

namespace erbs {

inline constexpr int most_levels = 8;
// True if an interaction of this level acts at the step of this number within its macro step.
inline bool acts(int level, int substep) { return (substep & ((1 << level) - 1)) == 0; }
// True in a step in which all interactions act.
inline bool at_macro_step(const TimeStep& time) { return time.substep == 0; }
// True if this macro step, or the one before, has more than one step.
inline bool has_levels(const TimeStep& time) { return time.substeps > 1 || time.last_substeps > 1; }
inline bool joints_act(const TimeStep& time) { return acts(time.joint_level, time.substep); }
// Impulse of joints over the kick of this step, times their force.
inline double joints_share(const TimeStep& time) {
  if (!joints_act(time)) return 0;
  if (!has_levels(time)) return 1;
  return (time.since_joints + (1 << time.joint_level) * time.dt) / (time.last_dt + time.dt);
}
// s, what a decision of this macro step must look ahead: its length.
inline double macro_dt(const TimeStep& time) { return time.substeps > 1 ? time.substeps * time.dt : time.dt; }

}  // namespace erbs
