// Blocks kept from falling while others come to rest under their own weight.
#pragma once
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// Bounds the speed of blocks against what bears them: the nearest block by joints that is not held back. Their elastic settlement comes and
// their fall does not. A drag in proportion to the mass is the gentlest constraint (Gauss 1829): what bears a block feels the reaction of
// its first instant of free fall. In a step a block in free fall may gain more speed than it may have. What it gains in the mean of some
// steps, in which joints swing, is taken from it in advance, so that it drifts at the bound.
class HeldBack {
 public:
  HeldBack(const Model& model, State& state, const std::vector<int>& blocks);
  // After every step. `share`: 1/s, of a block's thickness, with rotation at the radius of gyration.
  void bound(double share);

 private:
  struct Motion {
    Vec3 v = Vec3::Zero(), spin = Vec3::Zero();  // m/s; N m s
  };
  Vec3 rotation(int b, const Vec3& spin) const;  // 1/s

  const Model& model_;
  State& state_;
  const std::vector<int>& block_;
  std::vector<Motion> left_;  // as the last call left them [blocks]
  std::vector<Motion> gain_;  // of a step, in the mean [blocks]
  std::vector<int> bearer_;   // -1: none [blocks]
};

}  // namespace erbs::analysis
