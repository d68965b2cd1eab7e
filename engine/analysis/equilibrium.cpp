#include "engine/analysis/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "engine/solve/joint_geometry.h"
#include "engine/solve/joint_response.h"
#include "engine/solve/stiffness.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

struct Trial {
  Cold<JointMemory> memory;  // of those that are not sound
  Cold<PointHistory> history;
  Cold<CrushedFace> crushed;
  std::vector<std::uint8_t> sound;
};

// Internal forces at the present pose, joints answering from the history of `s` to where they are now.
VecX internal_force(const Model& m, const State& s, const Freedom& f, Trial& trial) {
  VecX out = VecX::Zero(f.count);
  trial.history = s.history;
  trial.crushed = s.crushed;
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] == Tier::open) continue;
    const Joint& joint = m.joint[z(j)];
    const JointPose pose = joint_pose(m, s, j);
    JointEnergy e;
    JointMemory now;
    const bool sound = s.tier[z(j)] == Tier::intact;
    const double rest[6] = {};
    const JointPast past(&trial.history[z(joint.first_point)], s.crushed.empty() ? nullptr : &trial.crushed[z(j)]);
    trial.sound[z(j)] = respond(m, j, sound, sound ? rest : s.memory[z(j)].q, pose.q, past, now.f, e);
    std::copy(pose.q, pose.q + 6, now.q);
    now.elastic = e.elastic;
    if (!trial.sound[z(j)]) trial.memory[z(j)] = now;
    const JointMap map = joint_map(m, s, j);
    const Vec6 resultant = Eigen::Map<const Vec6>(now.f);
    if (const int a = f.first[z(joint.a)]; a >= 0) out.segment<6>(a) += map.a.transpose() * resultant;
    if (const int b = f.first[z(joint.b)]; b >= 0) out.segment<6>(b) += map.b.transpose() * resultant;
  }
  return out;
}

// Tangent of a joint that is no longer sound, by central differences of its law over a small part of what it has moved, so that
// the difference sees the branch it is on. Not symmetric: friction follows the pressure, and Newton's method without that part
// goes round in circles on walls that lean. A floor keeps an open joint from vanishing.
Mat6 tangent(const Model& m, const State& s, int j, const Trial& trial) {
  const Joint& joint = m.joint[z(j)];
  const double* at = trial.memory[z(j)].q;
  Mat6 k;
  std::vector<PointHistory> history(z(joint.type->points));
  const double moved = std::max(Vec3(at[0], at[1], at[2]).norm(), joint.type->radius * Vec3(at[3], at[4], at[5]).norm());
  const double step = std::max(1e-5 * moved, 1e-14);
  const bool sound = s.tier[z(j)] == Tier::intact;
  const double rest[6] = {};
  for (int c = 0; c < 6; ++c) {
    double f[2][6];
    const double h = c < 3 ? step : step / joint.type->radius;
    for (int side = 0; side < 2; ++side) {
      double q[6];
      std::copy(at, at + 6, q);
      q[c] += side == 0 ? -h : h;
      std::copy_n(&s.history[z(joint.first_point)], joint.type->points, history.begin());
      CrushedFace crushed = s.crushed.empty() ? CrushedFace{} : s.crushed[z(j)];
      JointEnergy e;
      respond(m, j, sound, sound ? rest : s.memory[z(j)].q, q, {history.data(), s.crushed.empty() ? nullptr : &crushed}, f[side], e);
    }
    for (int r = 0; r < 6; ++r) k(r, c) = (f[1][r] - f[0][r]) / (2 * h);
  }
  for (int i = 0; i < 6; ++i) k(i, i) += 1e-7 * joint.type->stiffness[i];
  return k;
}

void add_changes(const Model& m, const State& s, const Freedom& f, const Trial& trial, Triplets& entries) {
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] == Tier::open || trial.sound[z(j)]) continue;
    const Joint& joint = m.joint[z(j)];
    const JointMap map = joint_map(m, s, j);
    Mat6 change = tangent(m, s, j, trial);
    for (int i = 0; i < 6; ++i) change(i, i) -= joint.type->stiffness[i];
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

// Islands meet only through what is fixed, so each has its own line search and its own measure of balance: a block that has to
// open most of its joint does not hold up the others, nor a slab hide a brick.
struct Island {
  std::vector<int> blocks;
  double size = 0;        // N, N m: largest load
  double unbalanced = 0;  // of size
  int worst = -1;         // block
  double brake = 0;       // share of the sound stiffness put on the diagonal: less and less as the balance comes near
  // the line search along a step: work = step . residual at `part` of it, falling from `start`; a root lies in (low, high)
  double part = 1, start = 0, low = 0, low_work = 0, high = 0, high_work = 0;
  int side = 0;
  bool settled = true;
};

std::vector<Island> islands_of(const Model& m, const State& s, const Freedom& f, const VecX& force) {
  std::vector<int> number(z(m.nblock), -1);
  std::vector<Island> out;
  const double least = 1e-12 * force.lpNorm<Eigen::Infinity>();
  for (int b = 0; b < m.nblock; ++b) {
    if (f.first[z(b)] < 0) continue;
    int& i = number[z(s.island[z(b)])];
    if (i < 0) i = int(out.size()), out.push_back({{}, least});
    out[z(i)].blocks.push_back(b);
    out[z(i)].size = std::max(out[z(i)].size, force.segment<6>(f.first[z(b)]).lpNorm<Eigen::Infinity>());
  }
  return out;
}

double balance(const Freedom& f, const VecX& residual, std::vector<Island>& islands) {
  double worst = 0;
  for (Island& i : islands) {
    i.unbalanced = 0;
    for (const int b : i.blocks) {
      const double now = residual.segment<6>(f.first[z(b)]).lpNorm<Eigen::Infinity>() / i.size;
      if (!(now <= i.unbalanced)) i.unbalanced = now, i.worst = b;
    }
    if (!(i.unbalanced <= worst)) worst = i.unbalanced;
  }
  return worst;
}

struct Pose {
  BlockVec3 u;
  BlockQuat q;
};

void move(State& s, const Freedom& f, const Pose& from, const VecX& by, const std::vector<Island>& islands) {
  for (const Island& i : islands)
    for (const int b : i.blocks) {
      const int first = f.first[z(b)];
      s.u[z(b)] = from.u[z(b)] + i.part * by.segment<3>(first);
      s.q[z(b)] = (rotation(i.part * Vec3(by.segment<3>(first + 3))) * from.q[z(b)]).normalized();
    }
}

// Where the search goes next: twice as far while there is work to gain, else into the bracket (regula falsi with the Illinois
// rule, Dowell and Jarratt 1971), away from its ends.
void search(Island& i, double work) {
  constexpr double enough = 0.3, farthest = 16;
  if (std::fabs(work) <= enough * i.start || (work > 0 && i.high == 0 && i.part >= farthest)) {
    i.settled = true;
    return;
  }
  if (work > 0) {
    if (i.side == 1) i.high_work *= 0.5;
    i.side = 1;
    i.low = i.part, i.low_work = work;
  } else {
    if (i.side == -1) i.low_work *= 0.5;
    i.side = -1;
    i.high = i.part, i.high_work = std::isfinite(work) ? work : -1e3 * i.start;
  }
  if (i.high == 0) i.part *= 2;
  else i.part = i.low + (i.high - i.low) * std::clamp(i.low_work / (i.low_work - i.high_work), 1e-9, 0.9);
}

}  // namespace

Equilibrium settle(const Model& m, State& s, const std::vector<double>& push) {
  constexpr double target = 1e-11, accepted = 1e-8;  // of the largest load of the island
  constexpr double first_brake = 0.1;
  Equilibrium out;
  const Freedom f = grounded_freedoms(m, s);
  const VecX force = applied(m, f, push);
  if (f.count == 0 || force.lpNorm<Eigen::Infinity>() == 0) {
    out.converged = true;
    return out;
  }
  const Pose before{s.u, s.q};
  std::vector<Island> islands = islands_of(m, s, f, force);
  Trial trial{Cold<JointMemory>(z(m.njoint)), {}, {}, std::vector<std::uint8_t>(z(m.njoint), 1)};
  SparseLdlt ldlt;
  bool factored_sound = false;
  VecX residual = force - internal_force(m, s, f, trial);
  double best = out.unbalanced = balance(f, residual, islands);
  int stuck = 0;
  for (out.iterations = 0; out.iterations < 200 && out.unbalanced > target && stuck < 40; ++out.iterations) {
    VecX step;
    if (std::all_of(trial.sound.begin(), trial.sound.end(), [](std::uint8_t x) { return x != 0; })) {
      if (!factored_sound) ldlt.compute(stiffness(m, s, f));
      factored_sound = true;
      if (ldlt.info() != Eigen::Success || (ldlt.vectorD().array() <= 0).any()) {
        out.why = "the structure has a mechanism";
        break;
      }
      step = ldlt.solve(residual);
    } else {
      Sparse k = stiffness(m, s, f);
      Triplets changes;
      add_changes(m, s, f, trial, changes);
      for (const Island& i : islands)
        for (const int b : i.blocks)
          for (int c = f.first[z(b)]; c < f.first[z(b)] + 6; ++c) changes.emplace_back(c, c, i.brake * k.coeff(c, c));
      Sparse d(f.count, f.count);
      d.setFromTriplets(changes.begin(), changes.end());
      k += d;
      SparseLu lu(k);
      if (lu.info() != Eigen::Success) break;
      step = lu.solve(residual);
    }
    const auto work = [&](const Island& i) {
      double sum = 0;
      for (const int b : i.blocks) sum += step.segment<6>(f.first[z(b)]).dot(residual.segment<6>(f.first[z(b)]));
      return sum;
    };
    for (Island& i : islands) {
      i.part = 1, i.low = i.high = i.high_work = 0, i.side = 0;
      i.start = i.low_work = work(i);
      i.settled = i.unbalanced < target;
    }
    const Pose from{s.u, s.q};
    for (int trials = 0; trials < 30; ++trials) {
      move(s, f, from, step, islands);
      residual = force - internal_force(m, s, f, trial);
      for (Island& i : islands)
        if (!i.settled) search(i, work(i));
      if (std::all_of(islands.begin(), islands.end(), [](const Island& i) { return i.settled; })) break;
    }
    std::vector<double> earlier;
    for (const Island& i : islands) earlier.push_back(i.unbalanced);
    out.unbalanced = balance(f, residual, islands);
    for (std::size_t i = 0; i < islands.size(); ++i)
      islands[i].brake =
          out.iterations == 0 ? first_brake : std::min(10.0, islands[i].brake * std::clamp(islands[i].unbalanced / earlier[i], 0.1, 2.0));
    stuck = out.unbalanced < 0.5 * best ? 0 : stuck + 1;
    if (best < accepted && stuck > 0) {  // what round-off leaves
      if (out.unbalanced > best) {
        s.u = from.u, s.q = from.q;
        residual = force - internal_force(m, s, f, trial);
        out.unbalanced = balance(f, residual, islands);
      }
      break;
    }
    best = std::min(best, out.unbalanced);
    if (!std::isfinite(out.unbalanced)) break;
  }
  out.converged = out.unbalanced < accepted;
  if (!out.converged) {
    if (out.why.empty()) {
      const Island& worst =
          *std::max_element(islands.begin(), islands.end(), [](const Island& a, const Island& b) { return a.unbalanced < b.unbalanced; });
      out.why = fmt::format("the unbalanced force on block {} stays at {:.3g} of the largest load", m.block_name[z(worst.worst)],
                            worst.unbalanced);
    }
    s.u = before.u;
    s.q = before.q;
    return out;
  }
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] == Tier::open || trial.sound[z(j)]) continue;
    s.tier[z(j)] = Tier::cracked;
    s.memory[z(j)] = trial.memory[z(j)];
  }
  s.history = trial.history;
  s.crushed = trial.crushed;
  return out;
}

}  // namespace erbs
