// Field list of the State: every member of every part, once, in the order of the file. Checkpoints and state_hash use this list: a member
// that is missing here does not survive a restart. A structured binding stops compiling when its part gains or loses a member.
#pragma once
#include <type_traits>

#include "engine/model/state.h"

namespace erbs {

// Role of a member in state_hash. `motion` and `history` are the result of a run. `carried` is no result, but is needed to continue with
// equal bits (caches, ledger).
enum class Part { motion, history, carried };

template <class S, class F>
requires std::is_same_v<std::remove_const_t<S>, State>
void each(S& state, F&& f) {
  auto& [time, pose, motion, topology, joints, contacts, sleep, cache, energy, tilt, observed] = state;
  auto& [step, start_step, start_t, t, dt, last_dt, dt_target, steps_since_limited, event_dt, bonds_due, macro, substep, substeps,
         last_substeps, next_substeps, next_dt, fast_dt, slow_dt, slow_event_dt, macro_steps_since_limited] = time;
  auto& [u, q] = pose;
  auto& [v, spin_momentum, w] = motion;
  auto& [island, grounded, joined, unjoined, loose] = topology;
  auto& [pack, slot, stage, memory, history, crushed, share, viscous] = joints;
  auto& [list, separation] = contacts;
  auto& [ref_u, ref_q, lazy_rotation, increment, pose_row, wrench, owner_sum, neighbour_force] = cache;
  auto& [gravity_before, moment_before] = tilt;
  auto& [joints_broken, max_penetration_relative, momentum_residual] = observed;
  f("step", step, Part::carried);
  f("start_step", start_step, Part::carried);
  f("start_t", start_t, Part::carried);
  f("t", t, Part::motion);
  f("dt", dt, Part::carried);
  f("last_dt", last_dt, Part::carried);
  f("u", u, Part::motion);
  f("q", q, Part::motion);
  f("v", v, Part::motion);
  f("spin_momentum", spin_momentum, Part::motion);
  f("w", w, Part::carried);
  f("ref_u", ref_u, Part::carried);
  f("ref_q", ref_q, Part::carried);
  f("lazy_rotation", lazy_rotation, Part::carried);
  f("pose_row", pose_row, Part::carried);
  f("increment", increment, Part::carried);
  f("island", island, Part::carried);
  f("grounded", grounded, Part::carried);
  f("joined", joined, Part::carried);
  f("unjoined", unjoined, Part::carried);
  f("loose", loose, Part::carried);
  f("pack", pack, Part::carried);
  f("slot", slot, Part::carried);
  f("stage", stage, Part::history);
  f("memory", memory, Part::carried);
  f("history", history, Part::history);
  f("crushed", crushed, Part::history);
  f("share", share, Part::history);
  f("wrench", wrench, Part::carried);
  f("owner_sum", owner_sum, Part::carried);
  f("neighbour_force", neighbour_force, Part::carried);
  f("viscous", viscous, Part::carried);
  f("contacts", list, Part::history);
  f("separation", separation, Part::carried);
  f("sleep", sleep, Part::carried);
  f("dt_target", dt_target, Part::carried);
  f("steps_since_limited", steps_since_limited, Part::carried);
  f("event_dt", event_dt, Part::carried);
  f("bonds_due", bonds_due, Part::carried);
  f("macro", macro, Part::carried);
  f("substep", substep, Part::carried);
  f("substeps", substeps, Part::carried);
  f("last_substeps", last_substeps, Part::carried);
  f("next_substeps", next_substeps, Part::carried);
  f("next_dt", next_dt, Part::carried);
  f("fast_dt", fast_dt, Part::carried);
  f("slow_dt", slow_dt, Part::carried);
  f("slow_event_dt", slow_event_dt, Part::carried);
  f("macro_steps_since_limited", macro_steps_since_limited, Part::carried);
  f("joints_broken", joints_broken, Part::history);
  f("energy", energy, Part::carried);
  f("gravity_before", gravity_before, Part::carried);
  f("moment_before", moment_before, Part::carried);
  f("max_penetration_relative", max_penetration_relative, Part::carried);
  f("momentum_residual", momentum_residual, Part::carried);
}

}  // namespace erbs
