#include "engine/record/results/collapse.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace erbs {
namespace {

constexpr double least_rise = 0.02;     // of the thinnest extent: what could rise by less is at rest or vibrates
constexpr double straight_down = 1e-3;  // of the way: what moves sideways by less falls straight down, its direction is round-off

bool counts(const Collapse& collapse, const Model& model, std::size_t b) { return model.kind[b] == Kind::moving && !collapse.thrown[b]; }

bool down(const Collapse& collapse, const Model& model, const BlockPoses& pose, std::size_t b) {
  if (!counts(collapse, model, b)) return false;
  const double way = collapse.start[b] - height_above_rest(model, pose, b), most = 0.5 * model.thickness[b];
  return way > most && way - collapse.supports.lowered(model, pose, b) > most;
}

}  // namespace

Collapse watch_collapse(const Model& model, const BlockPoses& start) {
  Collapse collapse;
  collapse.start.resize(std::size_t(model.nblock));
  for (std::size_t b = 0; b < collapse.start.size(); ++b) collapse.start[b] = height_above_rest(model, start, b);
  collapse.supports.ride = rides_of(model);
  collapse.supports.left.assign(collapse.supports.ride.size(), 0);
  collapse.thrown.assign(collapse.start.size(), 0);
  collapse.fallen.assign(collapse.start.size(), 0);
  collapse.fall_time.assign(collapse.start.size(), 0.0);
  return collapse;
}

std::vector<std::uint8_t> thrown_blocks(const Scene& scene, const Model& model, const State& start) {
  std::vector<std::uint8_t> thrown(std::size_t(model.nblock), 0);
  bool stands = false;
  for (std::size_t b = 0; b < thrown.size(); ++b) {
    const Initial& initial = scene.blocks[b].initial();
    const bool grounded = start.topology.grounded[b];
    stands = stands || (grounded && model.kind[b] == Kind::moving);
    thrown[b] = !grounded && (!initial.velocity.isZero() || !initial.spin.isZero());
  }
  if (!stands) thrown.assign(thrown.size(), 0);
  return thrown;
}

bool update(Collapse& collapse, const Model& model, const BlockPoses& pose, double t, std::vector<int>* newly) {
  double fallen = 0, moving = 0;  // kg
  const double far = model.analysis.stop_when_moved;
  collapse.supports.follow(model, pose, collapse.start);
  for (std::size_t b = 0; b < collapse.start.size(); ++b) {
    if (!counts(collapse, model, b)) continue;
    if (far > 0 && pose.u[b].squaredNorm() > far * far) collapse.moved = true;
    moving += model.mass[b];
    if (!down(collapse, model, pose, b)) continue;
    fallen += model.mass[b];
    if (collapse.fallen[b]) continue;
    if (newly) newly->push_back(int(b));
    collapse.fallen[b] = 1;
    collapse.supports.leave(int(b));
    collapse.fall_time[b] = t;
  }
  collapse.fallen_fraction = moving > 0 ? fallen / moving : 0;
  if (fallen == 0 || collapse.fallen_fraction < model.analysis.collapse_fraction) return false;
  if (collapse.under_gravity) collapse.time = std::min(collapse.time, t);
  if (collapse.collapsed) return false;
  collapse.collapsed = true;
  collapse.time = t;
  collapse.mechanism = mechanism_of(model, pose, t);
  return true;
}

double moving_fraction(const Collapse& collapse, const Model& model, const State& state) {
  const double gravity = model.gravity.norm();
  double restless = 0, moving = 0;  // kg
  for (std::size_t b = 0; b < collapse.start.size() && gravity > 0; ++b) {
    if (!counts(collapse, model, b)) continue;
    moving += model.mass[b];
    const bool rises = state.motion.v[b].squaredNorm() > 2 * gravity * least_rise * model.thickness[b];
    if (rises && !down(collapse, model, state.pose, b)) restless += model.mass[b];
  }
  return moving > 0 ? restless / moving : 0;
}

std::string span_of_event(double output_dt, double frame_dt, double t) {
  if (!(output_dt > 0 && frame_dt > 0)) return fmt::format("by {:.2f} s", t);
  const std::array every{output_dt, frame_dt};
  double due = 0, before = 0;  // of this look, which may be taken up to a step later, and of the one before
  for (const double dt : every) due = std::max(due, dt * std::floor(t / dt + 1e-6));
  for (const double dt : every) before = std::max(before, dt * (std::ceil(due / dt - 1e-6) - 1));
  const int decimals = std::clamp(1 + int(std::ceil(-std::log10(std::min(every[0], every[1])) - 1e-6)), 0, 9);
  return fmt::format("between {:.{}f} and {:.{}f} s", before, decimals, t, decimals);
}

std::optional<std::array<double, 2>> collapse_direction(const Collapse& collapse, const Model& model, const BlockPoses& pose) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double lengths = 0, ways = 0;
  for (std::size_t b = 0; b < collapse.start.size(); ++b) {
    if (!down(collapse, model, pose, b)) continue;
    const Eigen::Vector2d horizontal = pose.u[b].head<2>();
    sum += horizontal;
    lengths += horizontal.norm();
    ways += pose.u[b].norm();
  }
  const double length = sum.norm();
  // |sum| < 0.1 sum of lengths is |mean| < 0.1 mean length, since the number of blocks cancels. The negated form makes a NaN no direction.
  if (!(length > 0) || !(length >= 0.1 * lengths) || !(lengths >= straight_down * ways)) return std::nullopt;
  return std::array<double, 2>{sum.x() / length, sum.y() / length};
}

}  // namespace erbs
