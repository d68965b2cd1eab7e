// Blocks kept from falling while others come to rest under their own weight.
#pragma once
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// Bounds the speed of blocks against what they are joined with, so that their elastic settlement comes and their fall does not. A drag in
// proportion to the mass is the gentlest constraint (Gauss 1829): what bears a block feels the reaction of its first instant of free fall.
// In a step a block in free fall may gain more speed than it may have. That is taken from it in advance, so that it drifts at the bound.
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
  std::vector<Motion> left_;            // as the last call left them [blocks]
  std::vector<std::vector<int>> next_;  // what joints lead to [nblock]
};

}  // namespace erbs::analysis
