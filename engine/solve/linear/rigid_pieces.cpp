#include "engine/solve/linear/rigid_pieces.h"

#include <map>
#include <utility>

#include "engine/base/count.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs {
namespace {

int number(const Freedom& f, int b) { return f.first[z(b)] < 0 ? -1 : f.first[z(b)] / 6; }

// Motion of a block's centroid per motion x of its piece: displacement and rotation of the piece's centre.
Mat6 carried_by(const Vec3& arm) {
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
RigidPieces::RigidPieces(const Model& m, const State& s, const Freedom& f, int size) {
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
    piece_[z(seed)] = count_;
    int beside = -1;
    for (std::size_t i = 0; i < member.size(); ++i)
      for (int k = first[z(member[i])]; k < first[z(member[i]) + 1]; ++k) {
        int& piece = piece_[z(neighbour[z(k)])];
        if (piece >= 0 && piece != count_) beside = piece;
        if (piece >= 0 || int(member.size()) >= size) continue;
        piece = count_;
        member.push_back(neighbour[z(k)]);
      }
    if (int(member.size()) < size / 2 && beside >= 0)
      for (const int b : member) piece_[z(b)] = beside;
    else ++count_;
  }
  std::vector<Vec3> middle(z(count_), Vec3::Zero());
  std::vector<int> members(z(count_), 0);
  arm_.resize(count);
  for (int b = 0; b < m.nblock; ++b)
    if (const int i = number(f, b); i >= 0) {
      arm_[z(i)] = m.rest[z(b)] - m.rest.front() + s.pose.u[z(b)];
      middle[z(piece_[z(i)])] += arm_[z(i)];
      ++members[z(piece_[z(i)])];
    }
  for (std::size_t i = 0; i < arm_.size(); ++i) arm_[i] -= middle[z(piece_[i])] / members[z(piece_[i])];
}

Sparse RigidPieces::stiffness(const Model& m, const State& s, const Freedom& f, const Form& form, const VecX& more) const {
  Coupled coupled;
  const auto add = [&](int p, int q, const Mat6& k) {
    if (p >= q) coupled.try_emplace({p, q}, Mat6::Zero()).first->second += k;
  };
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const int end[2] = {number(f, m.joint[z(j)].a), number(f, m.joint[z(j)].b)};
    if (end[0] >= 0 && end[1] >= 0 && of(end[0]) == of(end[1])) continue;  // both blocks are in one rigid piece
    const JointMap map = joint_map(m, s, j);
    const std::array<double, 6> diagonal = form(j);
    const Mat6 k = Vec6(Eigen::Map<const Vec6>(diagonal.data())).asDiagonal();
    const Mat6* side[2] = {&map.a, &map.b};
    Mat6 of_piece[2];
    for (int e = 0; e < 2; ++e)
      if (end[e] >= 0) of_piece[e] = *side[e] * carried_by(arm(end[e]));
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        if (end[p] >= 0 && end[q] >= 0) add(of(end[p]), of(end[q]), of_piece[p].transpose() * k * of_piece[q]);
  }
  for (int i = 0; more.size() > 0 && i < int(piece_.size()); ++i) {
    const Mat6 held = Vec6(more.segment<6>(6 * Eigen::Index(i))).asDiagonal(), r = carried_by(arm(i));
    add(of(i), of(i), r.transpose() * held * r);
  }
  return lower_half(coupled, 6 * count_);
}

CoarseSystem::CoarseSystem(const Sparse& lower_half) : factors_(std::make_unique<SparseLdlt>(lower_half)), permuted_(lower_half.rows()) {
  definite_ = factors_->info() == Eigen::Success && (factors_->vectorD().array() > 0).all();
}

void CoarseSystem::solve(VecX& x) const {
  permuted_.noalias() = factors_->permutationP() * x;
  factors_->matrixL().solveInPlace(permuted_);
  permuted_.array() /= factors_->vectorD().array();
  factors_->matrixU().solveInPlace(permuted_);
  x.noalias() = factors_->permutationPinv() * permuted_;
}

}  // namespace erbs
