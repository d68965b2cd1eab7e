// Loads of a step: their means over its kick, and their wrenches on blocks.
#pragma once
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs {

class StepLoads {
 public:
  StepLoads(const Model& model, State& state);

  // Means over the interval of the coming kick: the second half of the last drift and the first half of the next. Books the work of
  // tilting.
  void evaluate();
  const Excitation& now() const { return now_; }
  Vec6 wrench(int b) const;                                      // N, N m about the centroid
  const double* rows() const { return load_.data(); }            // the same as rows of eight; null without loads
  std::vector<LoadedBlock>& loaded_blocks() { return loaded_; }  // moving blocks with loads, in ascending order

 private:
  void tilt();

  const Model& model_;
  State& state_;
  Excitation now_;
  Rows load_;
  std::vector<LoadedBlock> loaded_;
};

}  // namespace erbs
