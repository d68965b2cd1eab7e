#include "engine/model/columns.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"

namespace erbs {
namespace {

constexpr double steepest = 0.7;  // least cosine between gravity and the normal of a face on which a block lies
// Times `Hop::time`: of a low column of so many courses or more, ...
constexpr double low_loan = 3;
// ... and of a bed without dashpots, where waves tremble along the wall for ever: at 6 a wall creeps below the friction angle, at 20 none
// does (V62).
constexpr double undamped_loan = 20;
// Dashpots bring a low column to rest. A tall one hops on, the longer the taller: courses for each further hop (m04_stack_after_bump). At
// 3 a stack of 20 plates that have fallen onto each other creeps, at 6 it rests (h35_poured_stack).
constexpr double courses_of_hop = 3;

Vec3 normal_of(const Model& m, const State& s, int j) {
  const Joint& joint = m.joint[z(j)];
  return s.pose.q[z(joint.a)] * Vec3(joint.type->frame.col(2));
}

}  // namespace

bool lie_on_each_other(const Model& m, const Vec3& normal) { return std::fabs(normal.dot(m.gravity)) > steepest * m.gravity.norm(); }

Columns::Columns(const Model& m, const State& s) : model_(m) {
  const double g = m.gravity.norm();
  if (!(g > 0) || m.settles.empty()) return;
  up_.resize(z(m.nblock)), down_.resize(z(m.nblock)), height_.resize(z(m.nblock));
  for (int b = 0; b < m.nblock; ++b) {
    height_[z(b)] = -m.gravity.dot(m.rest[z(b)] + Vec3(s.pose.u[z(b)])) / g;
    if (m.kind[z(b)] == Kind::moving) up_[z(b)] = down_[z(b)] = {1, m.settles[z(b)]};
  }
  for (int j = 0; j < m.njoint; ++j)
    if (s.joints.stage[z(j)] != JointStage::contact && lie_on_each_other(m, normal_of(m, s, j))) link(m.joint[z(j)].a, m.joint[z(j)].b);
}

Columns::Link Columns::ordered(int a, int b) const { return height_[z(a)] < height_[z(b)] ? Link{a, b} : Link{b, a}; }

void Columns::link(int a, int b) {
  if (height_.empty()) return;
  const auto moves = [&](int k) { return model_.kind[z(k)] == Kind::moving; };
  if (moves(a) && moves(b) && height_[z(a)] != height_[z(b)]) links_.push_back(ordered(a, b));
}

void Columns::find() {
  const auto lengthen = [](Way& way, const Way& by, double own) {
    if (by.courses + 1 > way.courses) way = {by.courses + 1, by.settles + own};
  };
  std::ranges::stable_sort(links_, {}, [&](const Link& link) { return height_[z(link.upper)]; });
  for (const auto& [lower, upper] : links_) lengthen(down_[z(upper)], down_[z(lower)], model_.settles[z(upper)]);
  std::ranges::stable_sort(links_, std::greater{}, [&](const Link& link) { return height_[z(link.lower)]; });
  for (const auto& [lower, upper] : links_) lengthen(up_[z(lower)], up_[z(upper)], model_.settles[z(lower)]);
}

// n courses of mass m on springs k settle by n (n + 1) / 2 m g / k; of unequal blocks the mean counts.
Hop Columns::hop_of(int n, double settles) const {
  if (n == 0 || !std::isfinite(settles)) return {};
  const double time = std::sqrt(0.5 * (n + 1) * settles / model_.gravity.norm());
  return {time, std::min({double(n), std::max(low_loan, n / courses_of_hop), interlock_loan}) * time};
}

Hop Columns::through(int a, int b) const {
  if (up_.empty()) return {};
  const auto [lower, upper] = ordered(a, b);
  const Way &below = down_[z(lower)], &above = up_[z(upper)];
  return hop_of(below.courses + above.courses, below.settles + above.settles);
}

Hop Columns::beside(int a, int b) const {
  if (up_.empty()) return {};
  const auto of = [&](int k) {
    return hop_of(std::max(0, up_[z(k)].courses + down_[z(k)].courses - 1), up_[z(k)].settles + down_[z(k)].settles - model_.settles[z(k)]);
  };
  if (model_.kind[z(a)] != Kind::moving) return of(b);
  if (model_.kind[z(b)] != Kind::moving) return of(a);
  const Hop x = of(a), y = of(b);
  return x.time < y.time ? x : y;
}

std::vector<double> settlements(const Model& m, std::span<const double> bounds) {
  std::vector<double> out;  // the bound of a block gives k / m = 2 / dt^2
  for (const double dt : bounds) out.push_back(m.gravity.norm() * dt * dt / 2);
  return out;
}

void set_hops(Model& m, const State& s) {
  Columns columns(m, s);
  columns.find();
  for (int j = 0; j < m.njoint; ++j) {
    Joint& joint = m.joint[z(j)];
    joint.hop = lie_on_each_other(m, normal_of(m, s, j)) ? columns.through(joint.a, joint.b) : columns.beside(joint.a, joint.b);
    if (m.laws[z(joint.type->law)].damping == 0) joint.hop.loan = undamped_loan * joint.hop.time;
  }
}

}  // namespace erbs
