#include "engine/analysis/limit/contact_matrix.h"

#include <algorithm>
#include <set>

#include "engine/base/count.h"

namespace erbs::analysis {
void add_force(const LimitProblem& p, const ContactPoint& contact, const Vec3& f, VecX& rows) {
  for (int side = 0; side < 2; ++side)
    if (contact.body[side] >= 0)
      rows.segment(contact.body[side] * p.rows, p.rows) += contact.on[side].topLeftCorner(p.rows, p.columns) * f.head(p.columns);
}

Vec3 relative_velocity(const LimitProblem& p, const ContactPoint& contact, const VecX& rates) {
  Vec3 out = Vec3::Zero();
  for (int side = 0; side < 2; ++side)
    if (contact.body[side] >= 0)
      out.head(p.columns) +=
          contact.on[side].topLeftCorner(p.rows, p.columns).transpose() * rates.segment(contact.body[side] * p.rows, p.rows);
  return out;
}

ContactMatrix::ContactMatrix(const LimitProblem& problem) : problem_(problem), partner_(z(problem.nbody)) {
  const int rows = problem.rows;
  std::vector<std::set<int>> touches(z(problem.nbody));
  for (const ContactPoint& c : problem.contacts)
    if (c.body[0] >= 0 && c.body[1] >= 0) touches[z(std::min(c.body[0], c.body[1]))].insert(std::max(c.body[0], c.body[1]));
  Triplets entries;
  for (int b = 0; b < problem.nbody; ++b) {
    for (int column = 0; column < rows; ++column) {
      for (int row = column; row < rows; ++row) entries.emplace_back(b * rows + row, b * rows + column, 1.0);
      for (const int other : touches[z(b)])
        for (int row = 0; row < rows; ++row) entries.emplace_back(other * rows + row, b * rows + column, 1.0);
    }
    int place = 0;
    for (const int other : touches[z(b)]) partner_[z(b)].emplace_back(other, place++);
  }
  matrix_.resize(problem.nbody * rows, problem.nbody * rows);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  factor_.analyzePattern(matrix_);
}

void ContactMatrix::clear() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

void ContactMatrix::add(const ContactPoint& c, const Mat3& flexibility) {
  const int rows = problem_.rows;
  const Eigen::Matrix<double, 6, 3> weighted[2]{c.on[0] * flexibility, c.on[1] * flexibility};
  for (int side = 0; side < 2; ++side) {
    if (c.body[side] < 0) continue;
    const Mat6 own = weighted[side] * c.on[side].transpose();
    for (int column = 0; column < rows; ++column) {
      double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[c.body[side] * rows + column];
      for (int row = column; row < rows; ++row) values[row - column] += own(row, column);
    }
  }
  if (c.body[0] < 0 || c.body[1] < 0) return;
  const int low = c.body[0] < c.body[1] ? 0 : 1, lower = c.body[low], upper = c.body[1 - low];
  const auto& partners = partner_[z(lower)];
  const auto found = std::lower_bound(partners.begin(), partners.end(), std::pair(upper, 0));
  const Mat6 shared = weighted[1 - low] * c.on[low].transpose();
  for (int column = 0; column < rows; ++column) {
    double* values = matrix_.valuePtr() + matrix_.outerIndexPtr()[lower * rows + column] + (rows - column) + found->second * rows;
    for (int row = 0; row < rows; ++row) values[row] += shared(row, column);
  }
}

bool ContactMatrix::factorize() {
  // A body that its contact points do not hold in every direction has a zero pivot.
  for (int i = 0; i < matrix_.cols(); ++i) {
    double& diagonal = matrix_.valuePtr()[matrix_.outerIndexPtr()[i]];
    diagonal += 1e-13 * diagonal + 1e-200;
  }
  factor_.factorize(matrix_);
  return factor_.info() == Eigen::Success;
}

VecX ContactMatrix::solve(const VecX& right) const {
  VecX x = factor_.solve(right);
  const VecX left = right - matrix_.selfadjointView<Eigen::Lower>() * x;
  x += factor_.solve(left);
  return x;
}

}  // namespace erbs::analysis
