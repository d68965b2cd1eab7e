// Weights applied slowly, with damping, until what bears them is at rest: where Newton's method finds no equilibrium, or knows nothing of
// the contacts that bear.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/analysis/start/prepare.h"

namespace erbs::analysis {

// Ramps gravity and constant loads, then holds them until every block that does not fall is at rest. Returns the blocks that fall or still
// move. `still`: blocks that stay in place, with the joints among them [nblock]; empty: none.
std::vector<int> ramp_gravity(const Scene& scene, Prepared& run, const std::vector<std::uint8_t>& still, int threads);

// Lowers blocks onto a structure at rest: their weights and loads come slowly, all others act in full. Ends when all is at rest, or at once
// when a block leaves its place, by a twentieth of its thickness to a side or half of it down. Returns the blocks that left; the state is
// of no use then. `lowered`: those blocks [nblock]. `still`: as above.
std::vector<int> lower_blocks(const Scene& scene, Prepared& run, const std::vector<std::uint8_t>& lowered,
                              const std::vector<std::uint8_t>& still, int threads);

}  // namespace erbs::analysis
