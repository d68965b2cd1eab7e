#include "engine/analysis/start/newton.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/kinematics.h"
#include "engine/joints/response.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs::analysis {
namespace {

constexpr double most_bytes = 100 * 1048576.0;  // of factors
// Relative tolerance of one step by iterations. Later steps correct only the small change due to joint rotation, and the error of earlier
// steps.
constexpr double first_tolerance = 1e-10, tolerance = 1e-4;
constexpr int most_iterations = 3000;
// The same for iterations on the tangent with its symmetric part factored. More of these iterations cost as much as factors of the whole
// matrix.
constexpr double factored_tolerance = 1e-6;
constexpr int factored_iterations = 60;

// Tangent of a joint that is not intact, by central differences of its law. The difference step is a small fraction of the joint's
// movement, so the difference stays on the active branch. The tangent is not symmetric, since friction follows the pressure. Without that
// part, Newton's method cycles on leaning walls. A floor on the diagonal keeps an open joint from vanishing.
Mat6 tangent(const Model& m, const State& s, int j, const Trial& trial) {
  const Joint& joint = m.joint[z(j)];
  const double* at = trial.memory[z(j)].gap;
  Mat6 k;
  std::vector<PointHistory> history(z(joint.type->points));
  const double moved = std::max(Vec3(at[0], at[1], at[2]).norm(), joint.type->radius * Vec3(at[3], at[4], at[5]).norm());
  const double step = std::max(1e-5 * moved, 1e-14);
  const bool intact = s.joints.stage[z(j)] == JointStage::intact;
  const double rest[6] = {};
  for (int c = 0; c < 6; ++c) {
    double resultant[2][6];
    const double h = c < 3 ? step : step / joint.type->radius;
    for (int side = 0; side < 2; ++side) {
      double gap[6];
      std::copy(at, at + 6, gap);
      gap[c] += side == 0 ? -h : h;
      std::copy_n(&s.joints.history[z(joint.first_point)], joint.type->points, history.begin());
      CrushedFace crushed = s.joints.crushed.empty() ? CrushedFace{} : s.joints.crushed[z(j)];
      JointEnergy e;
      respond(m, j, intact, intact ? rest : s.joints.memory[z(j)].gap, gap, {history.data(), s.joints.crushed.empty() ? nullptr : &crushed},
              resultant[side], e);
    }
    for (int r = 0; r < 6; ++r) k(r, c) = (resultant[1][r] - resultant[0][r]) / (2 * h);
  }
  for (int i = 0; i < 6; ++i) k(i, i) += 1e-7 * joint.type->stiffness[i];
  return k;
}

// Diagonal of the intact stiffness.
VecX diagonal(const Model& m, const State& s, const Freedom& f) {
  VecX out = VecX::Zero(f.count);
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const JointMap map = joint_map(m, s, j);
    const Mat6 k = Vec6(Eigen::Map<const Vec6>(m.joint[z(j)].type->stiffness)).asDiagonal();
    if (const int a = f.first[z(m.joint[z(j)].a)]; a >= 0) out.segment<6>(a) += Vec6(Mat6(map.a.transpose() * k * map.a).diagonal());
    if (const int b = f.first[z(m.joint[z(j)].b)]; b >= 0) out.segment<6>(b) += Vec6(Mat6(map.b.transpose() * k * map.b).diagonal());
  }
  return out;
}

VecX elastic(const JointOperator& joints, const VecX& x) {
  VecX y;
  joints.apply(elastic_form, x, y);
  return y;
}

}  // namespace

VecX internal_force(const Model& m, const State& s, const Freedom& f, Trial& trial) {
  VecX out = VecX::Zero(f.count);
  trial.history = s.joints.history;
  trial.crushed = s.joints.crushed;
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const Joint& joint = m.joint[z(j)];
    JointPose pose = joint_pose(m, s, j);
    JointEnergy e;
    JointMemory now;
    std::copy_n(s.joints.memory[z(j)].own, std::size(now.own), now.own);
    pose.gap[2] -= asperity_lift(m.laws[z(joint.type->law)], now);
    const bool intact = s.joints.stage[z(j)] == JointStage::intact;
    const double rest[6] = {};
    const JointPast past(&trial.history[z(joint.first_point)], s.joints.crushed.empty() ? nullptr : &trial.crushed[z(j)]);
    trial.intact[z(j)] = respond(m, j, intact, intact ? rest : s.joints.memory[z(j)].gap, pose.gap, past, now.resultant, e);
    std::copy(pose.gap, pose.gap + 6, now.gap);
    now.elastic = e.elastic;
    if (!trial.intact[z(j)]) trial.memory[z(j)] = now;
    const JointMap map = joint_map(m, s, j);
    const Vec6 resultant = Eigen::Map<const Vec6>(now.resultant);
    if (const int a = f.first[z(joint.a)]; a >= 0) out.segment<6>(a) += map.a.transpose() * resultant;
    if (const int b = f.first[z(joint.b)]; b >= 0) out.segment<6>(b) += map.b.transpose() * resultant;
  }
  return out;
}

// A joint in the tangent that is not intact: its stiffness minus the intact stiffness.
struct NewtonSteps::Change {
  int a, b;  // first degrees of freedom of its blocks
  JointMap map;
  Mat6 more;
};

NewtonSteps::NewtonSteps(const Model& m, const State& s, const Freedom& f, Linear how)
    : m_(m), s_(s), f_(f), iterative_(how == Linear::by_size ? factor_bytes() > most_bytes : how == Linear::iterative) {}

std::vector<NewtonSteps::Change> NewtonSteps::changes_of(const Trial& trial) const {
  const Model& m = m_;
  const State& s = s_;
  std::vector<Change> out;
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact || trial.intact[z(j)]) continue;
    const Joint& joint = m.joint[z(j)];
    Change c{f_.first[z(joint.a)], f_.first[z(joint.b)], joint_map(m, s, j), tangent(m, s, j, trial)};
    for (int i = 0; i < 6; ++i) c.more(i, i) -= joint.type->stiffness[i];
    out.push_back(c);
  }
  return out;
}

bool NewtonSteps::intact(const VecX& residual, VecX& step) {
  if (iterative_ && intact_iterative(residual, step)) return true;
  if (!factored_) ldlt_.compute(stiffness(m_, s_, f_));
  factored_ = true;
  if (ldlt_.info() != Eigen::Success || (ldlt_.vectorD().array() <= 0).any()) return false;
  step = ldlt_.solve(residual);
  return true;
}

bool NewtonSteps::cracked(const Trial& trial, const VecX& brake, const VecX& residual, VecX& step) {
  const std::vector<Change> changes = changes_of(trial);
  const VecX held = brake.cwiseProduct(diagonal(m_, s_, f_));
  if (iterative_ && cracked_iterative(trial, changes, held, residual, step)) return true;
  Triplets entries;
  for (const Change& c : changes) {
    const int end[2] = {c.a, c.b};
    const Mat6* side[2] = {&c.map.a, &c.map.b};
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        if (end[p] < 0 || end[q] < 0) continue;
        const Mat6 block = side[p]->transpose() * c.more * *side[q];
        for (int row = 0; row < 6; ++row)
          for (int column = 0; column < 6; ++column) entries.emplace_back(end[p] + row, end[q] + column, block(row, column));
      }
  }
  for (int i = 0; i < f_.count; ++i) entries.emplace_back(i, i, held[i]);
  Sparse more(f_.count, f_.count), k = stiffness(m_, s_, f_);
  more.setFromTriplets(entries.begin(), entries.end());
  k += more;
  if (by_symmetric_part(k, residual, step)) return true;
  const SparseLu lu(k);
  if (lu.info() != Eigen::Success) return false;
  step = lu.solve(residual);
  return true;
}

// Only friction makes the tangent unsymmetric. The symmetric part takes a third of the factorisation work and keeps one pattern throughout.
// It is so close that a few BiCGSTAB iterations suffice.
bool NewtonSteps::by_symmetric_part(const Sparse& k, const VecX& residual, VecX& step) {
  const Sparse part = 0.5 * (Sparse(k.transpose()) + k);
  if (part.nonZeros() != analysed_) symmetric_.analyzePattern(part);
  analysed_ = part.nonZeros();
  symmetric_.factorize(part);
  if (symmetric_.info() != Eigen::Success || (symmetric_.vectorD().array() == 0).any()) return false;
  return stabilised_gradients([&](const VecX& x) -> VecX { return k * x; }, [&](const VecX& x) -> VecX { return symmetric_.solve(x); },
                              residual, factored_tolerance, factored_iterations, step);
}

// Nested dissection of a planar mesh of n nodes gives 31/8 n log2 n entries (George 1973, SIAM J. Numer. Anal. 10, 345). Here an entry is a
// 6 x 6 block of numbers with their row indices. The entries of each joint come on top.
double NewtonSteps::factor_bytes() const {
  const double n = std::max(2, f_.count / 6);
  return 31.0 / 8 * n * std::log2(n) * 36 * 12 + 144.0 * 16 * m_.njoint;
}

bool NewtonSteps::intact_iterative(const VecX& residual, VecX& step) {
  const bool first = !joints_;
  if (first) {
    near_.emplace(
        m_, s_, f_, [&](int j) { return elastic_form(m_.joint[z(j)]).diagonal; }, VecX());
    joints_.emplace(m_, s_, f_);
  }
  return near_->definite() && conjugate_gradients([&](const VecX& x) { return elastic(*joints_, x); }, *near_, residual,
                                                  first ? first_tolerance : tolerance, most_iterations, step);
}

bool NewtonSteps::cracked_iterative(const Trial& trial, const std::vector<Change>& changes, const VecX& held, const VecX& residual,
                                    VecX& step) {
  joints_.reset();
  near_.reset();
  std::vector<int> change(z(m_.njoint), -1);
  for (int j = 0, next = 0; j < m_.njoint; ++j)
    if (s_.joints.stage[z(j)] != JointStage::contact && !trial.intact[z(j)]) change[z(j)] = next++;
  const JointOperator joints(m_, s_, f_);
  const TwoLevel near(
      m_, s_, f_,
      [&](int j) {
        std::array<double, 6> k = elastic_form(m_.joint[z(j)]).diagonal;
        if (const int c = change[z(j)]; c >= 0)
          for (int i = 0; i < 6; ++i) k[z(i)] = std::max(1e-7 * k[z(i)], k[z(i)] + changes[z(c)].more(i, i));
        return k;
      },
      held);
  const auto times = [&](const VecX& x) {
    VecX y = elastic(joints, x) + held.cwiseProduct(x);
    for (const Change& c : changes) {
      Vec6 gap = Vec6::Zero();
      if (c.a >= 0) gap += c.map.a * x.segment<6>(c.a);
      if (c.b >= 0) gap += c.map.b * x.segment<6>(c.b);
      const Vec6 w = c.more * gap;
      if (c.a >= 0) y.segment<6>(c.a) += c.map.a.transpose() * w;
      if (c.b >= 0) y.segment<6>(c.b) += c.map.b.transpose() * w;
    }
    return y;
  };
  return near.definite() && stabilised_gradients(
                                times, [&](const VecX& x) { return near.apply(x); }, residual, tolerance, most_iterations, step);
}

}  // namespace erbs::analysis
