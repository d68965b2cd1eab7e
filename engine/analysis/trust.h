// What a run tells about itself while it goes, so that its user knows how far to trust it.
#pragma once
#include <string>
#include <type_traits>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/record/metrics.h"
#include "engine/solve/long_steps.h"

namespace erbs {

struct TrustWatch {
  double residual = 0, residual_time = 0;          // worst relative residual of the energy ledger, and when (s)
  int residual_joint = -1;                         // whose own balance jumped most up to then
  double dt_margin = 0;                            // largest step over the limit then in force
  double deepest = 0;                              // relative penetration at the last look
  long warned = 0, looked = 0;                     // steps; at the last look
  long past_gate = 0, sinking = 0;         // of the warned steps, by what they were warned of
  LongSteps past_step;
};

template <class T, class F>
requires std::is_same_v<std::remove_const_t<T>, TrustWatch>
void each(T& t, F&& f) {
  f("trust_residual", t.residual);
  f("trust_residual_time", t.residual_time);
  f("trust_residual_joint", t.residual_joint);
  f("trust_deepest", t.deepest);
  f("trust_warned", t.warned);
  f("trust_looked", t.looked);
  f("trust_past_gate", t.past_gate);
  f("trust_past_step", t.past_step.count);
  f("trust_dt_margin", t.past_step.worst);
  f("trust_sinking", t.sinking);
}

// Whether steps that were too long were too many and too long to believe what came of them.
bool stepped_too_far(const TrustWatch& watch, const State& state);

// A look, after every settling of the ledger. `allowed`: s, the limit on the step now (infinite where nothing is joined or touches);
// `past`: the steps since the last look that what touched bore no more. The steps since the last look count as warned where the residual is
// past `gate` or blocks sink deeper into each other beyond a hundredth of their smallest edge; else those past their limit.
void look(TrustWatch& watch, const State& state, double allowed, double gate, LongSteps past = {});

Metrics::Trust trust_of(const TrustWatch& watch, const Model& model, const State& state);
std::string trust_line(const Metrics::Trust& trust);

}  // namespace erbs
