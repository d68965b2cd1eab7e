#include "engine/analysis/quasi_static/push_curve.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/limit/outcome.h"
#include "engine/base/count.h"

namespace erbs::analysis {
namespace {

constexpr double joint_moved = 1e-4;  // of a joint's size: it has opened or slid

}  // namespace

double shown_multiplier(const PushSettings& push, double multiplier) { return push.tilts() ? std::tan(multiplier) : multiplier; }

JointChange joint_change(const Model& m, const JointState& joints, const BlockPoses& pose, int j) {
  if (joints.stage[z(j)] == JointStage::intact) return {};
  const JointCondition c = joint_condition(m, joints, pose, j);
  const double size = joint_moved * m.joint[z(j)].type->radius;
  return {c.opening > size, c.slip > size && c.slip > c.opening, c};
}

CurvePoint curve_point(const Model& m, const State& s, const Relaxation& relaxation, const Solver& solver, const PushSettings& push) {
  CurvePoint p;
  const BlockPoses& pose = solver.sample().pose;
  p.multiplier = shown_multiplier(push, relaxation.loads().multiplier());
  p.displacement = relaxation.monitor().along(pose);
  double weight = 0;  // N
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving)
      p.most = std::max(p.most, pose.u[z(b)].dot(push.direction)), weight += m.mass[z(b)] * m.gravity.norm();
  p.base_shear = relaxation.reaction(solver).dot(load_direction(push, m.gravity));
  p.base_shear_over_weight = weight > 0 ? p.base_shear / weight : std::nan("");
  for (int j = 0; j < m.njoint; ++j) {
    const JointChange change = joint_change(m, s.joints, pose, j);
    p.opening += change.open, p.slid += change.slid;
  }
  return p;
}

void DisplacedShapes::take(const std::vector<double>& along, long state, bool is_peak) {
  if (state == 0) gravity = along;
  if (state == 1) elastic = along;
  if (is_peak) peak = along;
}

std::vector<double> along_push(const Relaxation& relaxation, const Solver& solver, const Vec3& direction) {
  const BlockPoses& pose = solver.sample().pose;
  std::vector<double> along;
  for (int b = 0; b < relaxation.model().nblock; ++b) along.push_back(pose.u[z(b)].dot(direction));
  along.push_back(relaxation.monitor().along(pose));
  return along;
}

PushShape push_shape(const Model& m, const std::vector<std::string>& groups, const DisplacedShapes& shapes) {
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3(Vec3::UnitZ());
  const auto moved = [&](const std::vector<double>& shape, int b) { return shape[z(b)] - shapes.gravity[z(b)]; };
  PushShape out;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving)
      out.blocks.push_back(
          {m.block_name[z(b)], groups[z(b)], m.mass[z(b)], m.rest[z(b)].dot(up), moved(shapes.elastic, b), moved(shapes.peak, b)});
  out.elastic = moved(shapes.elastic, m.nblock), out.peak = moved(shapes.peak, m.nblock);
  return out;
}

std::vector<std::string> curve_columns(const PushSettings& push) {
  return {push.tilts()           ? "multiplier_tan"
          : push.pattern.empty() ? "multiplier_g"
                                 : "multiplier",
          "displacement_m",
          "largest_displacement_m",
          "base_shear_N",
          "base_shear_over_weight",
          "joints_opened",
          "joints_slid",
          "unbalanced_relative",
          "relaxation_steps"};
}

std::vector<double> curve_row(const CurvePoint& p) {
  return {p.multiplier,      p.displacement, p.most,       p.base_shear, p.base_shear_over_weight,
          double(p.opening), double(p.slid), p.unbalanced, p.steps};
}

}  // namespace erbs::analysis
