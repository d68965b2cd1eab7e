#include "engine/solve/linear/stiffness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/count.h"
#include "engine/base/symmetric.h"
#include "engine/base/units.h"
#include "engine/joints/kinematics.h"
#include "engine/solve/linear/eigenvalue.h"

namespace erbs {
namespace {

// Step at which dt^2 lambda(dt) reaches `most`, lambda(dt) being the largest eigenvalue with dashpots. `free`: the step without dashpots;
// `viscous`: their greatest b. The iteration starts from the answer for equal dashpots, dt^2 + 2 b dt = free^2. Since dt^2 lambda grows
// like a power of dt between 1 and 2, each correction leaves at most a third of the error. The result errs on the safe side.
template <class Lambda>
double longest_step(double free, double viscous, double most, double tolerance, const Lambda& lambda) {
  if (!(viscous > 0) || !std::isfinite(free)) return free;
  double dt = std::sqrt(viscous * viscous + free * free) - viscous;
  for (int iteration = 0; iteration < 14; ++iteration) {
    const double share = dt * dt * lambda(dt) / most;
    dt *= std::pow(share, -1 / 1.5);
    if (std::fabs(share - 1) < tolerance) break;
  }
  return (1 - tolerance) * dt;
}

Mat6 diagonal(const Joint& joint) {
  Mat6 k = Mat6::Zero();
  for (int i = 0; i < 6; ++i) k(i, i) = joint.type->stiffness[i];
  return k;
}

bool stiffens(const Joint& joint) {
  return joint.type->face[0] > joint.type->stiffness[3] || joint.type->face[1] > joint.type->stiffness[4] || joint.type->face[2] != 0;
}

}  // namespace

Mat6 stiffest(const Joint& joint) {
  Eigen::Matrix2d more;
  more << joint.type->face[0] - joint.type->stiffness[3], -joint.type->face[2], -joint.type->face[2],
      joint.type->face[1] - joint.type->stiffness[4];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(more);
  Mat6 k = diagonal(joint);
  k.block<2, 2>(3, 3) += eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
  return k;
}

JointMap joint_map(const Model& m, const State& s, int j) {
  const JointPose pose = joint_pose(m, s, j);
  const Mat3 t = pose.frame.transpose();
  const Vec3 arm_a = 0.5 * (pose.sum + pose.apart), arm_b = 0.5 * (pose.sum - pose.apart);
  (void)m;
  JointMap map{Mat6::Zero(), Mat6::Zero()};
  map.b.topLeftCorner<3, 3>() = t;
  map.b.topRightCorner<3, 3>() = -t * cross_matrix(arm_b);
  map.b.bottomRightCorner<3, 3>() = t;
  map.a.topLeftCorner<3, 3>() = -t;
  map.a.topRightCorner<3, 3>() = t * cross_matrix(arm_a);
  map.a.bottomRightCorner<3, 3>() = -t;
  return map;
}

namespace {

double greatest(const Model& m, double Joint::*viscous) {
  double most = 0;
  for (const Joint& joint : m.joint) most = std::max(most, joint.*viscous);
  return most;
}

// Stiffness of a joint with its dashpots at a step dt: (dt^2 K + 2 dt C) / dt^2. Leapfrog stays bounded while this is below 4 M / dt^2
// (velocities lag by half a step).
JointForm with_dashpots(JointForm form, double viscous, double dt) {
  const double factor = 1 + 2 * viscous / dt;
  for (double& k : form.diagonal) k *= factor;
  form.coupling *= factor;
  return form;
}

// A joint without stiffness against rotation is a pin. Its blocks may swing to any angle, where its greatest stiffness acts along any arm.
JointForm intact_form(const Joint& joint) {
  JointForm form = elastic_form(joint);
  double* k = form.diagonal.data();
  if (k[3] == 0 && k[4] == 0 && k[5] == 0) std::fill_n(k, 3, std::max({k[0], k[1], k[2]}));
  return form;
}

JointForm cracked_form(const Joint& joint) {
  if (!stiffens(joint)) return intact_form(joint);
  const Mat6 k = stiffest(joint);
  return {{k(0, 0), k(1, 1), k(2, 2), k(3, 3), k(4, 4), k(5, 5)}, k(3, 4)};
}

// Time steps that all joints together allow, intact and cracked.
void set_critical(const Model& m, const State& s, const Freedom& f, const RootMass& root, StepBounds& out) {
  const double intact = greatest(m, &Joint::viscous), broken = greatest(m, &Joint::viscous_cracked);
  const JointOperator joints(m, s, f);
  VecX scaled(f.count);
  const auto lambda = [&](const auto& form) {
    return largest_eigenvalue(f.count, [&](const VecX& x, VecX& y) {
      scaled = x;
      root.apply(scaled);
      joints.apply(form, scaled, y);
      root.apply(y);
    });
  };
  const double free = 2 / std::sqrt(lambda(intact_form));
  out.critical = out.cracked = longest_step(free, intact, 4, 1e-7, [&](double dt) {
    return lambda([&](const Joint& joint) { return with_dashpots(intact_form(joint), joint.viscous, dt); });
  });
  const bool stiffer = std::any_of(m.joint.begin(), m.joint.end(), stiffens);
  if (!stiffer && broken <= intact) return;
  std::vector<JointForm> cracked;
  for (const Joint& joint : m.joint) cracked.push_back(cracked_form(joint));
  const auto of = [&](const Joint& joint) -> const JointForm& { return cracked[std::size_t(&joint - m.joint.data())]; };
  // An accuracy of 1e-3 is enough: each iteration is another Lanczos run.
  out.cracked = longest_step(stiffer ? 2 / std::sqrt(lambda(of)) : free, broken, 4, 1e-3, [&](double dt) {
    return lambda([&](const Joint& joint) { return with_dashpots(of(joint), joint.viscous_cracked, dt); });
  });
  out.cracked = std::min(out.cracked, out.critical);
}

}  // namespace

Sparse stiffness(const Model& m, const State& s, const Freedom& f) {
  Triplets entries;
  entries.reserve(z(m.njoint) * 144);
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const JointMap map = joint_map(m, s, j);
    const Mat6 k = diagonal(m.joint[z(j)]);
    const int end[2] = {f.first[z(m.joint[z(j)].a)], f.first[z(m.joint[z(j)].b)]};
    const Mat6* side[2] = {&map.a, &map.b};
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        if (end[p] < 0 || end[q] < 0) continue;
        const Mat6 block = side[p]->transpose() * k * *side[q];
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) entries.emplace_back(end[p] + r, end[q] + c, block(r, c));
      }
  }
  Sparse out(f.count, f.count);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

StepBounds step_bounds(const Model& m, const State& s) {
  StepBounds out{infinite, infinite, infinite, infinite, infinite, -1, std::vector<double>(z(m.nblock), infinite)};
  const Freedom f = freedoms(m);
  const double viscous = greatest(m, &Joint::viscous_cracked);
  std::vector<Mat6> own(z(m.nblock), Mat6::Zero()), damping(viscous > 0 ? own.size() : 0, Mat6::Zero());
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const Joint& joint = m.joint[z(j)];
    const JointMap map = joint_map(m, s, j);
    const Mat6 k = diagonal(joint);
    own[z(joint.a)] += map.a.transpose() * k * map.a;
    own[z(joint.b)] += map.b.transpose() * k * map.b;
    if (viscous > 0) {
      damping[z(joint.a)] += joint.viscous_cracked * map.a.transpose() * k * map.a;
      damping[z(joint.b)] += joint.viscous_cracked * map.b.transpose() * k * map.b;
    }
    if (m.kind[z(joint.a)] != Kind::moving && m.kind[z(joint.b)] != Kind::moving) continue;
    const int light = m.kind[z(joint.b)] == Kind::moving ? joint.b : joint.a;
    const double distance = (joint.arm_a - joint.arm_b).norm();
    const PointLaw& law = m.laws[z(joint.type->law)];
    const double modulus = law.modulus > 0 ? law.modulus : law.kn * (joint.gap > 1e-6 ? joint.gap : distance);
    out.wave_passage = std::min(out.wave_passage, distance / std::sqrt(modulus / m.materials[z(m.material[z(light)])].density));
  }
  const RootMass roots(m, s, f);
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    const Mat6 root = roots.of(b);
    const auto largest = [&](const Mat6& k) { return std::max(0.0, largest_eigenvalue(root * k * root)); };
    const double free = out.of_block[z(b)] = std::sqrt(2 / largest(own[z(b)]));
    const double limit = longest_step(free, viscous, 2, 1e-7, [&](double dt) { return largest(own[z(b)] + 2 / dt * damping[z(b)]); });
    if (!std::isfinite(limit)) continue;
    if (limit < out.block) out.block = limit, out.stiffest_block = b;
    // Gu and Miao, rule (3): T_i = 2 pi sqrt(m_i / k_i), neighbours fixed, in translation.
    const double k = Eigen::SelfAdjointEigenSolver<Mat3>(Mat3(own[z(b)].topLeftCorner<3, 3>())).eigenvalues()[2];
    if (k > 0) out.element_period = std::min(out.element_period, 2 * pi * std::sqrt(m.mass[z(b)] / k));
  }
  if (f.count == 0 || out.block == infinite) return out;
  own = std::vector<Mat6>();  // = {} would not free the memory
  damping = std::vector<Mat6>();
  set_critical(m, s, f, roots, out);
  return out;
}

}  // namespace erbs
