#include "engine/solve/linear/two_level.h"

#include <cmath>
#include <map>
#include <utility>

#include "engine/solve/linear/stiffness.h"

namespace erbs {
namespace {

constexpr int piece_size = 20;  // blocks

std::size_t z(int i) { return std::size_t(i); }

int number(const Freedom& f, int b) { return f.first[z(b)] < 0 ? -1 : f.first[z(b)] / 6; }

// Motion of a block's centroid per motion x of its piece: displacement and rotation of the piece's centre.
Mat6 carried(const Vec3& arm) {
  Mat6 r = Mat6::Identity();
  r.topRightCorner<3, 3>() = -cross_matrix(arm);
  return r;
}

// Stiffness that couples two pieces, by their indices, the higher first.
using Coupled = std::map<std::pair<int, int>, Mat6>;

// Lower half of the coarse matrix. Empties `coupled`: there is memory for one of the two.
Sparse lower_half(Coupled& coupled, int count) {
  Triplets entries;
  entries.reserve(36 * coupled.size());
  for (const auto& [pair, k] : coupled)
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c)
        if (6 * pair.first + r >= 6 * pair.second + c) entries.emplace_back(6 * pair.first + r, 6 * pair.second + c, k(r, c));
  coupled.clear();
  Sparse lower(count, count);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace

// Pieces grow from the first block without a piece over its neighbours and theirs. A remainder of less than half a piece becomes part of a
// neighbouring piece.
void TwoLevel::group(const Model& m, const State& s, const Freedom& f) {
  const std::size_t count = z(f.count / 6);
  std::vector<int> first(count + 1, 0), neighbour;
  const auto each_pair = [&](const auto& use) {
    for (int j = 0; j < m.njoint; ++j) {
      const int a = number(f, m.joint[z(j)].a), b = number(f, m.joint[z(j)].b);
      if (a >= 0 && b >= 0 && s.joints.stage[z(j)] != JointStage::contact) use(a, b);
    }
  };
  each_pair([&](int a, int b) { ++first[z(a) + 1], ++first[z(b) + 1]; });
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  neighbour.resize(z(first.back()));
  std::vector<int> next(first.begin(), first.end() - 1);
  each_pair([&](int a, int b) { neighbour[z(next[z(a)]++)] = b, neighbour[z(next[z(b)]++)] = a; });
  piece_.assign(count, -1);
  std::vector<int> member;
  for (int seed = 0; seed < int(count); ++seed) {
    if (piece_[z(seed)] >= 0) continue;
    member.assign(1, seed);
    piece_[z(seed)] = pieces_;
    int beside = -1;
    for (std::size_t i = 0; i < member.size(); ++i)
      for (int k = first[z(member[i])]; k < first[z(member[i]) + 1]; ++k) {
        int& piece = piece_[z(neighbour[z(k)])];
        if (piece >= 0 && piece != pieces_) beside = piece;
        if (piece >= 0 || int(member.size()) >= piece_size) continue;
        piece = pieces_;
        member.push_back(neighbour[z(k)]);
      }
    if (int(member.size()) < piece_size / 2 && beside >= 0)
      for (const int b : member) piece_[z(b)] = beside;
    else ++pieces_;
  }
  std::vector<Vec3> middle(z(pieces_), Vec3::Zero());
  std::vector<int> size(z(pieces_), 0);
  arm_.resize(count);
  for (int b = 0; b < m.nblock; ++b)
    if (const int i = number(f, b); i >= 0) {
      arm_[z(i)] = m.rest[z(b)] - m.rest.front() + s.pose.u[z(b)];
      middle[z(piece_[z(i)])] += arm_[z(i)];
      ++size[z(piece_[z(i)])];
    }
  for (std::size_t i = 0; i < arm_.size(); ++i) arm_[i] -= middle[z(piece_[i])] / size[z(piece_[i])];
}

TwoLevel::TwoLevel(const Model& m, const State& s, const Freedom& f, const Form& form, const VecX& more) {
  group(m, s, f);
  std::vector<Mat6> own(piece_.size(), Mat6::Zero());
  inverse_.reserve(own.size());
  Coupled coupled;
  const auto add = [&](int p, int q, const Mat6& k) {
    if (p >= q) coupled.try_emplace({p, q}, Mat6::Zero()).first->second += k;
  };
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const int end[2] = {number(f, m.joint[z(j)].a), number(f, m.joint[z(j)].b)};
    const JointMap map = joint_map(m, s, j);
    const std::array<double, 6> diagonal = form(j);
    const Mat6 k = Vec6(Eigen::Map<const Vec6>(diagonal.data())).asDiagonal();
    const Mat6* side[2] = {&map.a, &map.b};
    Mat6 of_piece[2];
    for (int e = 0; e < 2; ++e) {
      if (end[e] < 0) continue;
      own[z(end[e])] += side[e]->transpose() * k * *side[e];
      of_piece[e] = *side[e] * carried(arm_[z(end[e])]);
    }
    if (end[0] >= 0 && end[1] >= 0 && piece_[z(end[0])] == piece_[z(end[1])]) continue;  // both blocks are in one rigid piece
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        if (end[p] >= 0 && end[q] >= 0) add(piece_[z(end[p])], piece_[z(end[q])], of_piece[p].transpose() * k * of_piece[q]);
  }
  for (std::size_t i = 0; more.size() > 0 && i < piece_.size(); ++i) {
    const Mat6 held = Vec6(more.segment<6>(6 * Eigen::Index(i))).asDiagonal(), r = carried(arm_[i]);
    own[i] += held;
    add(piece_[i], piece_[i], r.transpose() * held * r);
  }
  for (const Mat6& k : own) {
    const Eigen::LLT<Mat6> factors(k);
    definite_ = definite_ && factors.info() == Eigen::Success;
    inverse_.push_back(Mat6(factors.solve(Mat6::Identity())).cast<float>());
  }
  own = std::vector<Mat6>();
  coarse_.compute(lower_half(coupled, 6 * pieces_));
  definite_ = definite_ && coarse_.info() == Eigen::Success && (coarse_.vectorD().array() > 0).all();
}

VecX TwoLevel::apply(const VecX& residual) const {
  VecX out(residual.size()), whole = VecX::Zero(6 * pieces_);
  for (std::size_t i = 0; i < piece_.size(); ++i) {
    const Vec6 r = residual.segment<6>(6 * Eigen::Index(i));
    out.segment<6>(6 * Eigen::Index(i)) = inverse_[i].cast<double>() * r;
    whole.segment<6>(6 * piece_[i]) += r;
    whole.segment<3>(6 * piece_[i] + 3) += arm_[i].cross(Vec3(r.head<3>()));
  }
  whole = coarse_.solve(whole);
  for (std::size_t i = 0; i < piece_.size(); ++i) {
    const Vec6 x = whole.segment<6>(6 * piece_[i]);
    out.segment<6>(6 * Eigen::Index(i)) += x;
    out.segment<3>(6 * Eigen::Index(i)) += Vec3(x.tail<3>()).cross(arm_[i]);
  }
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
