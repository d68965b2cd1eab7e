// Weights applied slowly, with damping, until what bears them is at rest: where Newton's method finds no equilibrium, or knows nothing of
// the contacts that bear.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/analysis/start/prepare.h"
#include "engine/analysis/start/resting.h"

namespace erbs::analysis {

// Poses of some blocks, and what the joints among them and fixed ones remember.
struct Held {
  std::vector<std::uint8_t> block;  // [nblock]
  State state;

  void give_back(const Model& model, State& to) const;
};

// Hears about ten times a second what the start has come to. May throw to end it.
using StartTold = std::function<void(const std::string& line)>;

// Blocks, in ascending order, that have left their place or still move, and those of them that still move or are lower by half their
// thinnest extent; the others have slid or leaned to where they rest.
struct Unsteady {
  std::vector<int> moved, falls;
  Unsteady& operator+=(const Unsteady& more);
};

// Ramps gravity and constant loads, then holds them until every block that does not fall is at rest. What has left its place or still moves
// then begins the run in its place; run.fallen is what became of it. For a push, and if others do not come to rest beside it, it lies where
// it fell. `still`: blocks that stay in place, with the joints among them [nblock]; empty: none. `damp_loose`: damps blocks without a joint
// too.
Unsteady ramp_gravity(const Scene& scene, Prepared& run, const std::vector<std::uint8_t>& still, int threads, bool damp_loose = false,
                      const StartTold& told = {});

// Lowers what lies on a structure at rest onto it: its weight and its loads come slowly, all others act in full, and the structure is
// damped at about the critical value of its lowest mode. Ends when all that keeps its place is at rest. Returns the blocks that have left
// their place or still move after a while, those of the structure among them; the state is of no use then.
std::vector<int> lower_blocks(const Scene& scene, Prepared& run, const Resting& resting, int threads, const StartTold& told = {});

}  // namespace erbs::analysis
