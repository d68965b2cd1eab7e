#include "engine/analysis/limit/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/limit/contact_matrix.h"
#include "engine/base/units.h"

namespace erbs::analysis {
namespace {

constexpr double infinite = std::numeric_limits<double>::max();

}  // namespace

Vec3 FacetedProblem::edge(int i) const {
  if (problem_.plane) return {0, i == 0 ? 1.0 : -1.0, 0};
  const double radius = circumscribed_ ? 1 / std::cos(pi / facets_) : 1, angle = (2 * i + (circumscribed_ ? 1 : 0)) * pi / facets_;
  return {0, radius * std::cos(angle), radius * std::sin(angle)};
}

Vec3 FacetedProblem::segment(int i) const {
  if (problem_.plane) return {0, 1, 0};
  const double half = std::sin(pi / facets_) * (circumscribed_ ? 1 / std::cos(pi / facets_) : 1);
  const double angle = pi / 2 + (2 * i + (circumscribed_ ? 0 : 1)) * pi / facets_;
  return {0, half * std::cos(angle), half * std::sin(angle)};
}

void FacetedProblem::add_column(const ContactPoint& c, const Vec3& force) {
  for (int side = 0; side < 2; ++side) {
    if (c.body[side] < 0) continue;
    const Vec6 rows = c.on[side] * force;
    for (int i = 0; i < problem_.rows; ++i) {
      if (std::fabs(rows[i]) < 1e-14) continue;
      program_.row.push_back(c.body[side] * problem_.rows + i);
      program_.entry.push_back(rows[i]);
    }
  }
}

FacetedProblem::FacetedProblem(const LimitProblem& problem, const VecX& constant, const VecX& push, const std::vector<Strength>& strength,
                               int facets, bool circumscribed, bool bond, double most)
    : problem_(problem), facets_(problem.plane ? 2 : facets), circumscribed_(circumscribed), bond_(bond), constant_(constant), push_(push) {
  program_.rows = int(push.size());
  program_.right.assign(constant.data(), constant.data() + constant.size());
  for (double& one : program_.right) one = -one;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const ContactPoint& c = problem.contacts[i];
    slope_.push_back(strength[i].slope);
    if (slope_.back() <= 0) add_column(c, Vec3::UnitX()), program_.end_column(0, 0, infinite);
    for (int k = 0; slope_.back() > 0 && k < facets_; ++k)
      add_column(c, Vec3::UnitX() + slope_.back() * edge(k)), program_.end_column(0, 0, infinite);
    for (int k = 0; bond_ && k < facets_ / 2; ++k) add_column(c, segment(k)), program_.end_column(0, 0, 0);
    // n >= -tension: the constant part -tension of n
    VecX offset = VecX::Zero(push.size());
    if (strength[i].tension > 0) {
      add_force(problem, c, Vec3(-strength[i].tension, 0, 0), offset);
      for (int k = 0; k < offset.size(); ++k) program_.right[std::size_t(k)] -= offset[k];
    }
  }
  for (int i = 0; i < push.size(); ++i)
    if (push[i] != 0) program_.row.push_back(i), program_.entry.push_back(push[i]);
  program_.end_column(1, -infinite, most);
  solver_ = std::make_unique<LinearSolver>(program_);
}

LimitSolution FacetedProblem::solve(const std::vector<Strength>& strength) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < slope_.size(); ++i) {
    at += slope_[i] > 0 ? std::size_t(facets_) : 1;
    for (int k = 0; bond_ && k < facets_ / 2; ++k, ++at) {
      program_.high[at] = std::max(0.0, strength[i].cohesion - slope_[i] * strength[i].tension);
      program_.low[at] = -program_.high[at];
    }
  }
  solver_->set_bounds(program_.low, program_.high);
  const LinearSolution found = solver_->solve();
  LimitSolution out;
  out.iterations = found.iterations;
  out.converged = found.status == LinearSolution::Status::optimal;
  if (!out.converged) return out;
  out.statical = out.kinematic = found.value;
  out.rates = Eigen::Map<const VecX>(found.price.data(), push_.size());
  if (push_.dot(out.rates) < 0) out.rates = -out.rates;
  VecX balance = VecX::Zero(push_.size());
  at = 0;
  for (std::size_t i = 0; i < slope_.size(); ++i) {
    Vec3 f(-strength[i].tension, 0, 0);
    if (slope_[i] <= 0) f += found.x[at++] * Vec3::UnitX();
    for (int k = 0; slope_[i] > 0 && k < facets_; ++k) f += found.x[at++] * (Vec3::UnitX() + slope_[i] * edge(k));
    for (int k = 0; bond_ && k < facets_ / 2; ++k) f += found.x[at++] * segment(k);
    out.force.push_back(f);
    add_force(problem_, problem_.contacts[i], f, balance);
  }
  balance += found.value * push_;
  for (int i = 0; i < balance.size(); ++i) out.out_of_balance = std::max(out.out_of_balance, std::fabs(balance[i] + constant_[i]));
  return out;
}

}  // namespace erbs::analysis
