// Blocks that lie on a structure at rest and that no joint ties to it: a slab on two mortared piers, rubble on a vault, a lintel.
#pragma once
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// Their indices, of the lowest layer. A start from equilibrium knows joints alone, so that their weight comes upon the structure at once.
std::vector<int> resting_on_structure(const Model& model, const State& state);
// What to tell the user of them; empty if there are none.
std::string warning_of_resting(const Model& model, const State& state);
// "a, b, c, d, e and 3 more"
std::string names_of(const Model& model, const std::vector<int>& blocks);

}  // namespace erbs::analysis
