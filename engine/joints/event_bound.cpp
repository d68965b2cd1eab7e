#include "engine/joints/event_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace erbs {

double event_budget(const Model& m, const State& s) { return s.time.step % foresee_every != 0 ? 0 : event_allowance(m, s); }

double event_allowance(const Model& m, const State& s) {
  if (m.analysis.unstable || m.analysis.solver == "sequential") return 0;
  const double many = std::clamp(std::sqrt(double(s.topology.unjoined) / few_loose), 1.0, most_for_many);
  const double sum = m.njoint > few_joints ? blow_sum : has_many_events(m, s) ? rain_sum : event_sum;
  const double used = std::fabs(s.energy.event_residual) / (many * sum * s.energy.reference);
  return many * event_tolerance * s.energy.reference * std::max(least_allowance, 1 - used);
}

double blow_share(const Model& m) {
  const auto moving = double(std::ranges::count(m.kind, Kind::moving));
  return moving > few_loose ? std::numeric_limits<double>::infinity() : own_share * std::max(1.0, moving / few_blows);
}

double foresee(const Model& m, const Joint& joint, const double* gap_before, const double* gap, double budget) {
  if (!(budget > 0)) return 0;
  double square = 0, soon = 0;
  const auto gap_at = [](const double* x, const Eigen::Vector2d& c) { return x[2] + x[3] * c.y() - x[4] * c.x(); };
  const bool lumped = m.cell[std::size_t(joint.type->first_cell)].lumped();
  const int corners = lumped ? joint.type->points : joint.type->corners;
  for (int i = 0; i < corners; ++i) {
    const Point& point = m.point[std::size_t(joint.type->first_cell + (lumped ? i : 0))];
    const Eigen::Vector2d c = lumped ? Eigen::Vector2d(point.s, point.t) : m.overlap_corner[std::size_t(joint.type->first_corner + i)];
    const double opening = gap_at(gap, c), rate = opening - gap_at(gap_before, c);
    if (!(opening * rate < 0)) continue;
    square += lumped ? corners * point.weight / joint.type->area * rate * rate : rate * rate;
    soon = std::max(soon, std::fabs(rate / opening));
  }
  return std::min(std::sqrt(event_share / (corners * budget) * joint.type->stiffness[2] * square), event_steps * soon);
}

}  // namespace erbs
