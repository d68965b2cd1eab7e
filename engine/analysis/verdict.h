// Verdict on the results of a run: energy tolerance, divergence, and the errors found at its end.
#pragma once
#include <string>

#include "engine/analysis/diagnostics.h"
#include "engine/analysis/start/prepare.h"
#include "engine/record/results/collapse.h"

namespace erbs::analysis {

// The part of a run that a verdict uses.
struct RunSoFar {
  const Scene& scene;
  const Prepared& run;
  const Collapse& collapse;
  const RunDiagnostics& diagnostics;
  long released = 0;         // number of joints released to contact
  double dt_at_start = 0;    // s
  double height_energy = 0;  // J, potential energy released if all blocks fell to the lowest centroid
  bool allow_unstable = false;
};

// Energy tolerance: largest accepted relative residual of the ledger, unless the scene gives one. 1e-6 while all is elastic, 1e-3 with
// cracks, friction and contacts, 1e-2 after blocks have come loose or fallen.
double energy_tolerance(const RunSoFar& so_far);

// A sequential scheme feeds energy at any dt. A study of it says unstable = true, and then only invalid numbers end the run.
bool growth_allowed(const Scene& scene);

// True if the rest of the run would be useless. `right` is the last step with a valid ledger: less than half of the energy passed is
// missing, losses have given none, and kinetic energy is not negative. The call updates it.
bool diverges(const RunSoFar& so_far, long& right);

// The same of a run that has reached its end, however few its steps.
bool diverged_at_end(const RunSoFar& so_far);

// Error in the numbers of a run that ended with `status`, and the setting that cures it; empty if there is none.
std::string trouble_of(const RunSoFar& so_far, const std::string& status);

// "energy residual ..., largest step ..., joint", for log.txt.
std::string ledger_line(const RunSoFar& so_far);

}  // namespace erbs::analysis
