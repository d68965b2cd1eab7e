#include "engine/analysis/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/newton.h"
#include "engine/base/error.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

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

Equilibrium settle(const Model& m, State& s, const std::vector<double>& push, Linear how) {
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
  NewtonSteps steps(m, s, f, how);
  VecX residual = force - internal_force(m, s, f, trial);
  double best = out.unbalanced = balance(f, residual, islands);
  int stuck = 0;
  for (out.iterations = 0; out.iterations < 200 && out.unbalanced > target && stuck < 40; ++out.iterations) {
    VecX step;
    if (std::all_of(trial.sound.begin(), trial.sound.end(), [](std::uint8_t x) { return x != 0; })) {
      if (!steps.sound(residual, step)) {
        out.why = "the structure has a mechanism";
        break;
      }
    } else {
      VecX brake = VecX::Zero(f.count);
      for (const Island& i : islands)
        for (const int b : i.blocks) brake.segment<6>(f.first[z(b)]).setConstant(i.brake);
      if (!steps.cracked(trial, brake, residual, step)) break;
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
