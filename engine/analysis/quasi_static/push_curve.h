// The curve of a push: a row of curve.csv for each state of equilibrium.
#pragma once
#include <string>
#include <type_traits>
#include <vector>

#include "engine/analysis/quasi_static/relaxation.h"
#include "engine/record/performance/performance_folder.h"
#include "engine/record/recorders/joint_condition.h"
#include "engine/record/results/capacity.h"

namespace erbs::analysis {

// A multiplier as the curve shows it: of a tilt the tangent of its angle, the acceleration over g.
double shown_multiplier(const PushSettings& push, double multiplier);

// Whether a joint is open in a state, or has slid.
struct JointChange {
  bool open = false, slid = false;
  JointCondition now{};
};
JointChange joint_change(const Model& model, const JointState& joints, const BlockPoses& pose, int j);

// All of a point but what the relaxation says of itself; the solver is at a sample of `state`. `model` has the true masses.
CurvePoint curve_point(const Model& model, const State& state, const Relaxation& relaxation, const Solver& solver,
                       const PushSettings& push);

// Displacement along the push of every block, and of the monitored point behind them (m): under gravity alone, in the first state under
// load, and in the state with the largest one.
struct DisplacedShapes {
  std::vector<double> gravity, elastic, peak;  // [nblock + 1]; empty before such a state
  void take(const std::vector<double>& along, long state, bool is_peak);
};
template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, DisplacedShapes>
void each(P& p, F&& f) {
  f("shape_gravity", p.gravity);
  f("shape_elastic", p.elastic);
  f("shape_peak", p.peak);
}
std::vector<double> along_push(const Relaxation& relaxation, const Solver& solver, const Vec3& direction);
// Since the state under gravity alone. `model` has the true masses.
PushShape push_shape(const Model& model, const std::vector<std::string>& groups, const DisplacedShapes& shapes);

std::vector<std::string> curve_columns(const PushSettings& push);
std::vector<double> curve_row(const CurvePoint& point);

}  // namespace erbs::analysis
