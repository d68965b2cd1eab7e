// Intervals at which loads and ground motion act on each block while contacts have levels (model/levels.h).
#pragma once
#include <span>
#include <vector>

#include "engine/base/memory.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Loads act together with the forces that bear them. A block with joints has the interval of joints, any other block that of its slowest
// pair. If weight acted more often than its support, the block would fall and be pushed back within each interval: dashpots, friction and
// the prediction of openings would see a speed g H / 2 of a block at rest.
class BlockLevels {
 public:
  BlockLevels(const Model& model, const State& state) : model_(model), state_(state) {}
  void start(std::span<const int> live);               // at the start of a macro step, before pairs have their next level
  void substep(std::span<const int> live, bool anew);  // in its other steps; `anew`: the first step of a resumed run
  // s, half the impulse of a load over its force: the parts before and after this kick; zero where loads do not act [whole groups]
  const double* since() const { return since_.data(); }
  const double* next() const { return next_.data(); }

 private:
  const Model& model_;
  const State& state_;
  std::vector<int> level_;  // of the present macro step [nblock]
  Rows since_, next_;       // s
};

}  // namespace erbs
