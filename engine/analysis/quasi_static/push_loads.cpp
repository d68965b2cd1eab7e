#include "engine/analysis/quasi_static/push_loads.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/base/rotation.h"
#include "engine/base/units.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs::analysis {
namespace {

Wave constant(double value) { return Pulse{value, -1, unbounded}; }

double g_of(const Model& m) { return m.gravity.norm() > 0 ? m.gravity.norm() : standard_g; }

double weight_mass(const Model& m, int b) { return m.mass[z(b)] * weight_share(m, b); }

// The moving blocks that a force of the pattern acts on, with their shares of it.
std::vector<std::pair<int, double>> blocks_of(const PatternForce& force, const std::vector<std::string>& groups, const Model& m) {
  std::vector<std::pair<int, double>> out;
  double sum = 0;
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    if (force.block.empty() ? groups[z(b)] != force.group : m.block_name[z(b)] != force.block) continue;
    out.emplace_back(b, weight_mass(m, b));
    sum += out.back().second;
  }
  for (auto& one : out) one.second /= sum;
  return out;
}

}  // namespace

PushLoads::PushLoads(const PushSettings& push, const std::vector<std::string>& groups, Model& model)
    : kind_(push.tilts()           ? Kind::tilt
            : push.pattern.empty() ? Kind::acceleration
                                   : Kind::pattern),
      model_(model),
      direction_(push.direction) {
  model.grounds.clear(), model.tilts.clear();
  if (kind_ == Kind::tilt) {
    // Gravity turns about this axis towards the side that goes down.
    model.tilts.push_back({constant(0), model.gravity.normalized().cross(direction_).normalized()});
  } else if (kind_ == Kind::acceleration) {
    model.grounds.push_back({constant(0), -g_of(model) * direction_});
  }
  first_force_ = model.force_loads.size();
  for (const PatternForce& force : push.pattern)
    for (const auto& [b, share] : blocks_of(force, groups, model))
      model.force_loads.push_back({constant(0), share * force.force, b, Vec3::Zero(), false});
  set(0);
}

void PushLoads::set(double multiplier) {
  multiplier_ = multiplier;
  acceleration_ = model_.gravity;
  if (kind_ == Kind::tilt) {
    model_.tilts.front().wave = constant(multiplier);
    acceleration_ = erbs::rotation(multiplier * model_.tilts.front().axis) * model_.gravity;
  } else if (kind_ == Kind::acceleration) {
    model_.grounds.front().wave = constant(multiplier);
    acceleration_ -= multiplier * model_.grounds.front().direction;
  }
  for (std::size_t i = first_force_; i < model_.force_loads.size(); ++i) model_.force_loads[i].wave = constant(multiplier);
}

std::vector<Vec3> PushLoads::slope() const {
  std::vector<Vec3> out(z(model_.nblock), Vec3::Zero());
  for (int b = 0; b < model_.nblock && kind_ != Kind::pattern; ++b) out[z(b)] = weight_mass(model_, b) * g_of(model_) * direction_;
  for (std::size_t i = first_force_; i < model_.force_loads.size(); ++i)
    out[z(model_.force_loads[i].block)] += model_.force_loads[i].direction;
  return out;
}

Vec3 PushLoads::weight(int b) const { return weight_mass(model_, b) * acceleration_; }

MonitorPoint::MonitorPoint(const PushSettings& push, const Model& m, const std::vector<std::uint8_t>& fell)
    : arm_(Vec3::Zero()), direction_(push.direction) {
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3::UnitZ();
  double highest = -1e300;
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving || (fell[z(b)] != 0 && push.monitor.block.empty())) continue;
    const double height = push.monitor.block.empty() ? up.dot(m.rest[z(b)]) : m.block_name[z(b)] == push.monitor.block ? 1 : 0;
    if (height > highest) highest = height, block_ = b;
  }
  if (push.monitor.has_point) arm_ = push.monitor.point - m.rest[z(block_)];
}

Vec3 MonitorPoint::displacement(const BlockPoses& pose) const { return pose.u[z(block_)] + rotation_change(pose.q[z(block_)], arm_); }

}  // namespace erbs::analysis
