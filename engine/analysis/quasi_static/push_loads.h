// The loads of a push at a multiplier, as loads of a model: a constant acceleration of the ground, a tilt of gravity, or forces.
#pragma once
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

class PushLoads {
 public:
  // Adds the loads of `push` to `model`, at the multiplier 0. `blocks`: of the scene, for the groups of its pattern.
  PushLoads(const PushSettings& push, const std::vector<std::string>& groups, Model& model);

  void set(double multiplier);      // of the model given at the start; tilt: rad
  Vec3 weight(int block) const;     // N, of gravity and the acceleration at the present multiplier, without forces
  std::vector<Vec3> slope() const;  // N, on each block, per unit of the multiplier near 0
  double multiplier() const { return multiplier_; }
  const Vec3& direction() const { return direction_; }

 private:
  enum class Kind { acceleration, tilt, pattern } kind_;
  Model& model_;
  Vec3 direction_;
  std::size_t first_force_ = 0;  // in Model::force_loads
  double multiplier_ = 0;
  Vec3 acceleration_ = Vec3::Zero();  // m/s2, on every block
};

// The monitored point of a push; if none is named, the centroid of the highest block that has not fallen off before it (`fell`).
class MonitorPoint {
 public:
  MonitorPoint(const PushSettings& push, const Model& model, const std::vector<std::uint8_t>& fell);
  Vec3 displacement(const BlockPoses& pose) const;  // m
  double along(const BlockPoses& pose) const { return displacement(pose).dot(direction_); }
  int block() const { return block_; }

 private:
  int block_ = 0;
  Vec3 arm_, direction_;
};

}  // namespace erbs::analysis
