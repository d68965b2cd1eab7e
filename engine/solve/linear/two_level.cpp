#include "engine/solve/linear/two_level.h"

#include <cmath>
#include <utility>

#include "engine/base/count.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs {
namespace {

constexpr int piece_size = 20;  // blocks

}  // namespace

TwoLevel::TwoLevel(const Model& m, const State& s, const Freedom& f, const Form& form, const VecX& more)
    : pieces_(m, s, f, piece_size), coarse_(pieces_.stiffness(m, s, f, form, more)) {
  std::vector<Mat6> own(z(f.count / 6), Mat6::Zero());
  inverse_.reserve(own.size());
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const JointMap map = joint_map(m, s, j);
    const std::array<double, 6> diagonal = form(j);
    const Mat6 k = Vec6(Eigen::Map<const Vec6>(diagonal.data())).asDiagonal();
    if (const int a = f.first[z(m.joint[z(j)].a)] / 6; f.first[z(m.joint[z(j)].a)] >= 0) own[z(a)] += map.a.transpose() * k * map.a;
    if (const int b = f.first[z(m.joint[z(j)].b)] / 6; f.first[z(m.joint[z(j)].b)] >= 0) own[z(b)] += map.b.transpose() * k * map.b;
  }
  for (std::size_t i = 0; more.size() > 0 && i < own.size(); ++i) own[i] += Mat6(Vec6(more.segment<6>(6 * Eigen::Index(i))).asDiagonal());
  for (const Mat6& k : own) {
    const Eigen::LLT<Mat6> factors(k);
    definite_ = definite_ && factors.info() == Eigen::Success;
    inverse_.push_back(Mat6(factors.solve(Mat6::Identity())).cast<float>());
  }
  definite_ = definite_ && coarse_.definite();
}

VecX TwoLevel::apply(const VecX& residual) const {
  VecX out(residual.size()), whole = VecX::Zero(6 * pieces_.count());
  for (int i = 0; i < int(inverse_.size()); ++i) {
    const Vec6 r = residual.segment<6>(6 * Eigen::Index(i));
    out.segment<6>(6 * Eigen::Index(i)) = inverse_[z(i)].cast<double>() * r;
    whole.segment<6>(6 * pieces_.of(i)) += pieces_.gathered(i, r);
  }
  coarse_.solve(whole);
  for (int i = 0; i < int(inverse_.size()); ++i)
    out.segment<6>(6 * Eigen::Index(i)) += pieces_.carried(i, whole.segment<6>(6 * pieces_.of(i)));
  return out;
}

bool conjugate_gradients(const Times& times, const TwoLevel& near, const VecX& b, double tolerance, int most, VecX& x) {
  x = VecX::Zero(b.size());
  VecX residual = b, z = near.apply(residual), direction = z;
  double energy = residual.dot(z);
  const double enough = tolerance * tolerance * energy;
  for (int iteration = 0; iteration < most && energy > enough; ++iteration) {
    const VecX answer = times(direction);
    const double part = energy / direction.dot(answer);
    if (!(part > 0)) return false;
    x += part * direction;
    residual -= part * answer;
    z = near.apply(residual);
    const double before = std::exchange(energy, residual.dot(z));
    direction = z + energy / before * direction;
  }
  return energy <= enough;
}

bool stabilised_gradients(const Times& times, const Times& near, const VecX& b, double tolerance, int most, VecX& x) {
  x = VecX::Zero(b.size());
  VecX residual = b, direction = b;
  const VecX shadow = b;
  double rho = b.dot(b);
  const double enough = tolerance * b.norm();
  for (int iteration = 0; iteration < most && residual.norm() > enough; ++iteration) {
    const VecX along = near(direction), answer = times(along);
    const double part = rho / shadow.dot(answer);
    residual -= part * answer;
    const VecX aside = near(residual), second = times(aside);
    const double share = second.dot(residual) / second.squaredNorm();
    x += part * along + share * aside;
    residual -= share * second;
    const double before = std::exchange(rho, shadow.dot(residual));
    if (!std::isfinite(rho) || rho == 0) return residual.norm() <= enough;
    direction = residual + rho / before * part / share * (direction - share * answer);
  }
  return residual.norm() <= enough;
}

}  // namespace erbs
