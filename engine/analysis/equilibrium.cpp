#include "engine/analysis/equilibrium.h"

#include <cmath>

#include "engine/solve/joint_geometry.h"
#include "engine/solve/joint_response.h"
#include "engine/solve/stiffness.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

struct Trial {
  std::vector<JointMemory> memory;
  std::vector<PointHistory> history;
  std::vector<std::uint8_t> sound;
};

// Internal forces at the present pose, joints answering from the history of `s` to where they are now.
VecX internal_force(const Model& m, const State& s, const Freedom& f, Trial& trial) {
  VecX out = VecX::Zero(f.count);
  trial.history = s.history;
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] == Tier::open) continue;
    const Joint& joint = m.joint[z(j)];
    const JointPose pose = joint_pose(m, s, j);
    JointEnergy e;
    JointMemory& now = trial.memory[z(j)];
    const bool sound = s.tier[z(j)] == Tier::intact;
    const double rest[6] = {};
    trial.sound[z(j)] = respond(m, j, sound, sound ? rest : s.memory[z(j)].q, pose.q, &trial.history[z(joint.first_point)], now.f, e);
    std::copy(pose.q, pose.q + 6, now.q);
    now.elastic = e.elastic;
    const JointMap map = joint_map(m, s, j);
    const Vec6 resultant = Eigen::Map<const Vec6>(now.f);
    if (const int a = f.first[z(joint.a)]; a >= 0) out.segment<6>(a) += map.a.transpose() * resultant;
    if (const int b = f.first[z(joint.b)]; b >= 0) out.segment<6>(b) += map.b.transpose() * resultant;
  }
  return out;
}

// Tangent of a joint that is no longer sound, by central differences of its law; a floor keeps an open joint from vanishing.
Mat6 tangent(const Model& m, const State& s, int j, const Trial& trial) {
  const Joint& joint = m.joint[z(j)];
  Mat6 k;
  std::vector<PointHistory> history(z(joint.points));
  const double scale[6] = {1, 1, 1, 1 / joint.radius, 1 / joint.radius, 1 / joint.radius};
  const bool sound = s.tier[z(j)] == Tier::intact;
  const double rest[6] = {};
  for (int c = 0; c < 6; ++c) {
    double f[2][6];
    const double h = 1e-9 * scale[c];
    for (int side = 0; side < 2; ++side) {
      double q[6];
      std::copy(trial.memory[z(j)].q, trial.memory[z(j)].q + 6, q);
      q[c] += side == 0 ? -h : h;
      std::copy_n(&s.history[z(joint.first_point)], joint.points, history.begin());
      JointEnergy e;
      respond(m, j, sound, sound ? rest : s.memory[z(j)].q, q, history.data(), f[side], e);
    }
    for (int r = 0; r < 6; ++r) k(r, c) = (f[1][r] - f[0][r]) / (2 * h);
  }
  Mat6 symmetric = 0.5 * (k + k.transpose());
  for (int i = 0; i < 6; ++i) symmetric(i, i) = std::max(symmetric(i, i), 1e-6 * joint.stiffness[i]);
  return symmetric;
}

void add_changes(const Model& m, const State& s, const Freedom& f, const Trial& trial, Triplets& entries) {
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] == Tier::open || trial.sound[z(j)]) continue;
    const Joint& joint = m.joint[z(j)];
    const JointMap map = joint_map(m, s, j);
    Mat6 change = tangent(m, s, j, trial);
    for (int i = 0; i < 6; ++i) change(i, i) -= joint.stiffness[i];
    const int end[2] = {f.first[z(joint.a)], f.first[z(joint.b)]};
    const Mat6* side[2] = {&map.a, &map.b};
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        if (end[p] < 0 || end[q] < 0) continue;
        const Mat6 block = side[p]->transpose() * change * *side[q];
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) entries.emplace_back(end[p] + r, end[q] + c, block(r, c));
      }
  }
}

void move(const Model& m, State& s, const Freedom& f, const VecX& by, double part) {
  for (int b = 0; b < m.nblock; ++b) {
    const int first = f.first[z(b)];
    if (first < 0) continue;
    s.u[z(b)] += part * by.segment<3>(first);
    s.q[z(b)] = (rotation(part * Vec3(by.segment<3>(first + 3))) * s.q[z(b)]).normalized();
  }
}

VecX applied(const Model& m, const Freedom& f, const std::vector<double>& push) {
  VecX out = VecX::Zero(f.count);
  for (int b = 0; b < m.nblock; ++b) {
    const int first = f.first[z(b)];
    if (first < 0) continue;
    out.segment<3>(first) = m.mass[z(b)] * m.gravity;
    for (int i = 0; i < 6; ++i) out[first + i] += push[z(b) * 6 + z(i)];
  }
  return out;
}

}  // namespace

Equilibrium settle(const Model& m, State& s, const std::vector<double>& push) {
  Equilibrium out;
  const Freedom f = grounded_freedoms(m, s);
  const VecX force = applied(m, f, push);
  const double size = f.count > 0 ? force.lpNorm<Eigen::Infinity>() : 0;
  if (size == 0) {
    out.converged = true;
    return out;
  }
  const std::vector<Vec3> u = s.u;
  const std::vector<Quat> q = s.q;
  Trial trial{std::vector<JointMemory>(z(m.njoint)), {}, std::vector<std::uint8_t>(z(m.njoint), 1)};
  SparseLdlt ldlt;
  bool factored_sound = false;
  VecX residual = force - internal_force(m, s, f, trial);
  double best = residual.lpNorm<Eigen::Infinity>();
  int stuck = 0;
  for (out.iterations = 0; out.iterations < 60 && best > 1e-11 * size && stuck < 4; ++out.iterations) {
    const bool all_sound = std::all_of(trial.sound.begin(), trial.sound.end(), [](std::uint8_t x) { return x != 0; });
    if (!all_sound || !factored_sound) {
      Sparse k = stiffness(m, s, f);
      if (!all_sound) {
        Triplets changes;
        add_changes(m, s, f, trial, changes);
        Sparse d(f.count, f.count);
        d.setFromTriplets(changes.begin(), changes.end());
        k += d;
      }
      ldlt.compute(k);
      factored_sound = all_sound;
      if (ldlt.info() != Eigen::Success || (ldlt.vectorD().array() <= 0).any()) {
        out.why = "the structure has a mechanism";
        break;
      }
    }
    const VecX step = ldlt.solve(residual);
    const std::vector<Vec3> u0 = s.u;
    const std::vector<Quat> q0 = s.q;
    double part = 1, now = 0;
    for (;; part *= 0.5) {  // line search on the largest unbalanced force
      s.u = u0;
      s.q = q0;
      move(m, s, f, step, part);
      residual = force - internal_force(m, s, f, trial);
      now = residual.lpNorm<Eigen::Infinity>();
      if (now < best || part < 0.1) break;
    }
    stuck = now < 0.5 * best ? 0 : stuck + 1;
    best = std::min(best, now);
    if (!std::isfinite(now)) break;
  }
  out.unbalanced = residual.lpNorm<Eigen::Infinity>() / size;
  out.converged = out.unbalanced < 1e-8;
  if (!out.converged) {
    if (out.why.empty()) out.why = "unbalanced force stays at " + std::to_string(out.unbalanced) + " of the largest load";
    s.u = u;
    s.q = q;
    return out;
  }
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] == Tier::open || trial.sound[z(j)]) continue;
    s.tier[z(j)] = Tier::cracked;
    s.memory[z(j)] = trial.memory[z(j)];
  }
  s.history = trial.history;
  return out;
}

}  // namespace erbs
