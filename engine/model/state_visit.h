// Field list of the State: every member, once. Checkpoints and state_hash use this list: a member that is missing here does not survive
// a restart. The structured binding below stops compiling when State gains or loses a member.
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
  auto& [step, start_step, start_t, t, dt, last_dt, u, q, v, spin_momentum, w, base_u, base_q, row, shift, island, grounded, joined, unjoined, loose, batch, place, tier, memory, history,
         crushed, wrench, kept, given, viscous, debris, parting, rest, dt_goal, calm, event_dt, joints_broken, energy, gravity_before, moment_before, max_penetration_relative, momentum_residual] = state;
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
  f("base_u", base_u, Part::carried);
  f("base_q", base_q, Part::carried);
  f("row", row, Part::carried);
  f("shift", shift, Part::carried);
  f("island", island, Part::carried);
  f("grounded", grounded, Part::carried);
  f("joined", joined, Part::carried);
  f("unjoined", unjoined, Part::carried);
  f("loose", loose, Part::carried);
  f("batch", batch, Part::carried);
  f("place", place, Part::carried);
  f("tier", tier, Part::history);
  f("memory", memory, Part::carried);
  f("history", history, Part::history);
  f("crushed", crushed, Part::history);
  f("wrench", wrench, Part::carried);
  f("kept", kept, Part::carried);
  f("given", given, Part::carried);
  f("viscous", viscous, Part::carried);
  f("debris", debris, Part::history);
  f("parting", parting, Part::carried);
  f("rest", rest, Part::carried);
  f("dt_goal", dt_goal, Part::carried);
  f("calm", calm, Part::carried);
  f("event_dt", event_dt, Part::carried);
  f("joints_broken", joints_broken, Part::history);
  f("energy", energy, Part::carried);
  f("gravity_before", gravity_before, Part::carried);
  f("moment_before", moment_before, Part::carried);
  f("max_penetration_relative", max_penetration_relative, Part::carried);
  f("momentum_residual", momentum_residual, Part::carried);
}

}  // namespace erbs
