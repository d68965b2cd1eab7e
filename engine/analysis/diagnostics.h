// Diagnostics of a running simulation, which tell its user how far to trust the results.
#pragma once
#include <string>
#include <type_traits>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/record/results/metrics.h"
#include "engine/solve/long_steps.h"

namespace erbs::analysis {

struct RunDiagnostics {
  double residual = 0, residual_time = 0;  // worst relative residual of the energy ledger, and its time (s)
  int residual_joint = -1;                 // joint whose energy balance jumped most up to then
  double dt_margin = 0;                    // largest ratio of a time step to the limit then in force
  double max_penetration = 0;              // relative penetration at the last update
  long warned = 0, last_update = 0;        // warned steps; step of the last update
  long past_tolerance = 0, sinking = 0;    // warned steps, by cause
  LongSteps past_step;
};

template <class T, class F>
requires std::is_same_v<std::remove_const_t<T>, RunDiagnostics>
void each(T& t, F&& f) {
  f("diagnostics_residual", t.residual);
  f("diagnostics_residual_time", t.residual_time);
  f("diagnostics_residual_joint", t.residual_joint);
  f("diagnostics_max_penetration", t.max_penetration);
  f("diagnostics_warned", t.warned);
  f("diagnostics_last_update", t.last_update);
  f("diagnostics_past_tolerance", t.past_tolerance);
  f("diagnostics_past_step", t.past_step.count);
  f("diagnostics_dt_margin", t.past_step.worst);
  f("diagnostics_sinking", t.sinking);
}

// True if too many steps exceeded the stability limit by too much for the results to be believed.
bool stepped_too_far(const RunDiagnostics& watch, const State& state);

// Updates the diagnostics; called after every settlement of the energy ledger. `allowed`: s, the present stability limit; infinite if
// nothing is joined or touches. `past`: steps since the last update that exceeded the limit of the contacts.
// All steps since the last update count as warned if the residual exceeds `tolerance`, or if penetration grows beyond a hundredth of the
// smallest edge. Otherwise only the steps beyond their limit count.
void update_diagnostics(RunDiagnostics& watch, const State& state, double allowed, double tolerance, LongSteps past = {});

Metrics::Diagnostics diagnostics_of(const RunDiagnostics& watch, const Model& model, const State& state);
std::string diagnostics_line(const Metrics::Diagnostics& diagnostics);

}  // namespace erbs::analysis
