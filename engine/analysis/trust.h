// What a run tells about itself while it goes, so that its user knows how far to trust it.
#pragma once
#include <string>
#include <type_traits>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/record/metrics.h"

namespace erbs {

struct TrustWatch {
  double residual = 0, residual_time = 0;  // worst relative residual of the energy ledger, and when (s)
  int residual_joint = -1;                 // whose own balance jumped most up to then
  double dt_margin = 0;                    // largest step over the limit then in force
  double deepest = 0;                      // relative penetration at the last look
  long warned = 0, looked = 0;             // steps; at the last look
  long past_gate = 0, past_step = 0, sinking = 0;  // of the warned steps, by what they were warned of
};

template <class T, class F>
requires std::is_same_v<std::remove_const_t<T>, TrustWatch>
void each(T& t, F&& f) {
  f("trust_residual", t.residual);
  f("trust_residual_time", t.residual_time);
  f("trust_residual_joint", t.residual_joint);
  f("trust_dt_margin", t.dt_margin);
  f("trust_deepest", t.deepest);
  f("trust_warned", t.warned);
  f("trust_looked", t.looked);
  f("trust_past_gate", t.past_gate);
  f("trust_past_step", t.past_step);
  f("trust_sinking", t.sinking);
}

// A step past the limit of what has just closed is shortened at once, and costs little: by 1.6 in 0.04 % of the steps of a block that
// stutters (v10_stick_slip) 1e-7 of the energy, by 1.54 in 0.19 % of those of a collapse (h25_chaos_of_a_collapse) 2e-4. What vibrates at
// the limit grows by exp(2 acosh ratio) a step: 4.4-fold at 1.3, 14-fold at 2.
inline constexpr double step_slack = 1.05;
struct StepTooLong {
  double ratio, share;  // of the limit, more at worst; of the steps, more past the slack
};
inline constexpr StepTooLong steps_too_long[] = {{1.3, 1e-2}, {2, 1e-3}};

// Whether steps that were too long were too many and too long to believe what came of them.
bool stepped_too_far(const TrustWatch& watch, const State& state);

// A look, after every settling of the ledger. `allowed`: s, the limit on the step now (infinite where nothing is joined or touches).
// The steps since the last look count as warned where the residual is past
// `gate`, the step past its limit by more than a twentieth, or blocks sink deeper into each other beyond a hundredth of their smallest edge.
void look(TrustWatch& watch, const State& state, double allowed, double gate);

Metrics::Trust trust_of(const TrustWatch& watch, const Model& model, const State& state);
std::string trust_line(const Metrics::Trust& trust);

}  // namespace erbs
