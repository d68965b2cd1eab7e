// Intervals at which loads and ground motion act on each block while contacts have levels (model/levels.h).
#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Loads act together with the forces that bear them: once in a macro step on a block with a slow pair, else in every step. If weight acted
// more often than its support, the block would fall and be pushed back within each interval: dashpots, friction and the prediction of
// openings would see a speed g H / 2 of a block at rest.
class BlockLevels {
 public:
  BlockLevels(const Model& model, const State& state) : model_(model), state_(state) {}
  // Blocks with a slow pair [nblock]: in the last macro step and in this one, which starts; or after a resumption within it.
  void start_macro_step(std::span<const std::uint8_t> was_slow, std::vector<std::uint8_t> slow);
  void resume(std::vector<std::uint8_t> slow) { slow_ = std::move(slow), within_ = false; }
  void substep();  // in the other steps of a macro step
  // s, half the impulse of a load over its force: the parts before and after this kick; zero where loads do not act [whole groups]
  const double* since() const { return since_.data(); }
  const double* next() const { return next_.data(); }

 private:
  const Model& model_;
  const State& state_;
  std::vector<std::uint8_t> slow_;
  std::vector<double> since_, next_;  // s
  bool within_ = false;               // they are those of the other steps of this macro step
};

}  // namespace erbs
