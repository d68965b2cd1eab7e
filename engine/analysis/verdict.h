// Whether the numbers of a run are to be believed: its gate of energy, whether it diverges, and what is wrong once it has ended.
#pragma once
#include <string>

#include "engine/analysis/prepare.h"
#include "engine/analysis/trust.h"
#include "engine/record/collapse.h"

namespace erbs {

// What a verdict reads of a run.
struct RunSoFar {
  const Scene& scene;
  const Prepared& run;
  const Collapse& collapse;
  const TrustWatch& trust;
  long opened = 0;           // joints that have gone over to contact
  double dt_at_start = 0;    // s
  double height_energy = 0;  // J, at most given free by a fall of everything to the lowest rest
  bool allow_unstable = false;
};

// Most of the relative residual of the ledger: 1e-6 while all is elastic, 1e-3 with cracks, friction and contacts, 1e-2 once blocks have
// come loose or fallen; or as the scene says.
double energy_gate(const RunSoFar& so_far);

// A sequential scheme feeds energy at any dt: a study of it says unstable = true, and only numbers that break end the run.
bool growth_allowed(const Scene& scene);

// Whether nothing that the run may still do can be of use. `right`: the last step at which the ledger knew half of what passed through;
// brought up to date.
bool diverges(const RunSoFar& so_far, long& right);

// What is wrong with the numbers of a run that ended as `status` says, and the knob that cures it; empty where nothing is.
std::string trouble_of(const RunSoFar& so_far, const std::string& status);

// "energy residual ..., largest step ..., where": for log.txt.
std::string ledger_line(const RunSoFar& so_far);

}  // namespace erbs
