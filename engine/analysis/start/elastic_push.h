// The elastic structure under a force on each block.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/base/sparse.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

struct ElasticPush {
  double frequency = 0;  // 1/s, Rayleigh's quotient of the motion; 0 if the structure is a mechanism
  VecX force, motion;    // N; m, of the blocks that joints connect to the ground
};
ElasticPush elastic_push(const Model& model, const State& state, const std::vector<Vec3>& force);  // N [nblock]

// 1/s, the least frequency of pushes of the mass along three axes; 0 if the structure is a mechanism. `still`: blocks that are not pushed
// [nblock]; empty: none. `borne`: kg, of what moves with a block besides its own mass [nblock]; empty: none.
double lowest_frequency(const Model& model, const State& state, const std::vector<std::uint8_t>& still, const std::vector<double>& borne);

}  // namespace erbs::analysis
