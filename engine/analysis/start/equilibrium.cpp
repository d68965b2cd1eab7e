#include "engine/analysis/start/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/start/newton.h"
#include "engine/base/count.h"
#include "engine/base/error.h"

namespace erbs::analysis {
namespace {

VecX applied(const Model& m, const Freedom& f, const std::vector<double>& loads) {
  VecX out = VecX::Zero(f.count);
  for (int b = 0; b < m.nblock; ++b) {
    const int first = f.first[z(b)];
    if (first < 0) continue;
    out.segment<3>(first) = m.mass[z(b)] * m.gravity;
    for (int i = 0; i < 6; ++i) out[first + i] += loads[z(b) * 6 + z(i)];
  }
  return out;
}

// Islands interact only through fixed blocks. Each therefore has its own line search, measure of balance and end. A block that opens most
// of its joint does not delay others. A heavy slab does not hide a brick. A falling island does not keep others from rest.
struct Island {
  enum class Now : std::uint8_t { sought, found, given_up };
  std::vector<int> blocks;
  double size = 0;        // N, N m: largest load
  double unbalanced = 0;  // relative to size
  double best = 0;        // the smallest so far
  int stuck = 0;          // steps without a new smallest
  int worst = -1;         // block
  double brake = 0;       // fraction of the intact stiffness added to the diagonal; decreases as balance approaches
  // Line search along a step: the work step . residual at fraction `part` falls from `start`; a root lies in (low, high).
  double part = 1, start = 0, low = 0, low_work = 0, high = 0, high_work = 0;
  int side = 0;
  bool settled = true;
  Now now = Now::sought;
  bool sought() const { return now == Now::sought; }
};

std::vector<Island> islands_of(const Model& m, const State& s, const Freedom& f, const VecX& force) {
  std::vector<int> number(z(m.nblock), -1);
  std::vector<Island> out;
  const double least = 1e-12 * force.lpNorm<Eigen::Infinity>();
  for (int b = 0; b < m.nblock; ++b) {
    if (f.first[z(b)] < 0) continue;
    int& i = number[z(s.topology.island[z(b)])];
    if (i < 0) i = int(out.size()), out.push_back({{}, least});
    out[z(i)].blocks.push_back(b);
    out[z(i)].size = std::max(out[z(i)].size, force.segment<6>(f.first[z(b)]).lpNorm<Eigen::Infinity>());
  }
  return out;
}

void balance(const Freedom& f, const VecX& residual, Island& i) {
  i.unbalanced = 0;
  for (const int b : i.blocks) {
    const double now = residual.segment<6>(f.first[z(b)]).lpNorm<Eigen::Infinity>() / i.size;
    if (!(now <= i.unbalanced)) i.unbalanced = now, i.worst = b;
  }
}

void move(State& s, const Freedom& f, const BlockPoses& from, const VecX& by, const std::vector<Island>& islands) {
  for (const Island& i : islands)
    for (const int b : i.blocks) {
      if (!i.sought()) continue;
      const int first = f.first[z(b)];
      s.pose.u[z(b)] = from.u[z(b)] + i.part * by.segment<3>(first);
      s.pose.q[z(b)] = (rotation(i.part * Vec3(by.segment<3>(first + 3))) * from.q[z(b)]).normalized();
    }
}

void put_back(State& s, const BlockPoses& from, const Island& island) {
  for (const int b : island.blocks) s.pose.u[z(b)] = from.u[z(b)], s.pose.q[z(b)] = from.q[z(b)];
}

// Next fraction of the line search: doubled while work remains, otherwise inside the bracket and away from its ends. Method: regula falsi
// with the Illinois rule (Dowell and Jarratt 1971).
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

constexpr double aimed_at = 1e-11, accepted = 1e-8;  // relative to the largest load of the island
constexpr double first_brake = 0.1;

// Newton's method on all islands of a `Freedom` at once.
class Search {
 public:
  Search(const Model& m, State& s, const Freedom& f, const std::vector<double>& loads, Linear how)
      : m_(m),
        s_(s),
        f_(f),
        force_(applied(m, f, loads)),
        islands_(islands_of(m, s, f, force_)),
        before_(s.pose),
        trial_{LazyArray<JointMemory>(z(m.njoint)), {}, {}, std::vector<std::uint8_t>(z(m.njoint), 1)},
        steps_(m, s, f, how) {}

  // False if no step could be found for the islands still sought.
  bool go() {
    residual_ = force_ - internal_force(m_, s_, f_, trial_);
    for (Island& i : islands_) {
      balance(f_, residual_, i);
      i.best = i.unbalanced;
      if (i.unbalanced <= aimed_at) i.now = Island::Now::found;
    }
    while (std::any_of(islands_.begin(), islands_.end(), [](const Island& i) { return i.sought(); })) {
      VecX step;
      if (!find(step)) return false;
      const BlockPoses from = s_.pose;
      line_search(step, from);
      for (Island& i : islands_)
        if (i.sought()) judge(i, from);
      ++iterations_;
    }
    return true;
  }

  // Stores the joint state of the islands found; other islands return to their start.
  void keep(Equilibrium& out) {
    for (Island& i : islands_)
      if (i.now != Island::Now::found) put_back(s_, before_, i);
    internal_force(m_, s_, f_, trial_);
    for (const Island& i : islands_) {
      if (i.now != Island::Now::found) continue;
      out.unbalanced = std::max(out.unbalanced, i.unbalanced);
      for (const int b : i.blocks) out.found[z(b)] = 1;
    }
    out.iterations = std::max(out.iterations, iterations_);
    for (int j = 0; j < m_.njoint; ++j) {
      const Joint& joint = m_.joint[z(j)];
      const auto found = [&](int b) { return f_.first[z(b)] >= 0 && out.found[z(b)]; };
      if (s_.joints.stage[z(j)] == JointStage::contact || trial_.intact[z(j)] || !(found(joint.a) || found(joint.b))) continue;
      s_.joints.stage[z(j)] = JointStage::cracked;
      s_.joints.memory[z(j)] = trial_.memory[z(j)];
      for (int i = joint.first_point; i < joint.first_point + joint.type->points; ++i) s_.joints.history[z(i)] = trial_.history[z(i)];
      if (!s_.joints.crushed.empty()) s_.joints.crushed[z(j)] = trial_.crushed[z(j)];
    }
  }

  const std::vector<Island>& islands() const { return islands_; }
  const std::string& why() const { return why_; }

 private:
  bool find(VecX& step) {
    if (std::all_of(trial_.intact.begin(), trial_.intact.end(), [](std::uint8_t x) { return x != 0; })) {
      if (steps_.intact(residual_, step)) return true;
      why_ = "the structure has a mechanism";
      return false;
    }
    VecX brake = VecX::Zero(f_.count);
    for (const Island& i : islands_)
      for (const int b : i.blocks) brake.segment<6>(f_.first[z(b)]).setConstant(i.brake);
    return steps_.cracked(trial_, brake, residual_, step);
  }

  // Moves each island until its own work along the step is spent.
  void line_search(const VecX& step, const BlockPoses& from) {
    const auto work = [&](const Island& i) {
      double sum = 0;
      for (const int b : i.blocks) sum += step.segment<6>(f_.first[z(b)]).dot(residual_.segment<6>(f_.first[z(b)]));
      return sum;
    };
    for (Island& i : islands_) {
      i.part = 1, i.low = i.high = i.high_work = 0, i.side = 0;
      i.start = i.low_work = work(i);
      i.settled = !i.sought();
      // Friction can make the step point against the residual. A stronger brake corrects it.
      if (!(i.start > 0)) i.part = 0, i.settled = true;
    }
    for (int trials = 0; trials < 30; ++trials) {
      move(s_, f_, from, step, islands_);
      residual_ = force_ - internal_force(m_, s_, f_, trial_);
      for (Island& i : islands_)
        if (!i.settled) search(i, work(i));
      if (std::all_of(islands_.begin(), islands_.end(), [](const Island& i) { return i.settled; })) break;
    }
  }

  // Decides whether an island has reached equilibrium or is given up.
  void judge(Island& i, const BlockPoses& from) {
    const double earlier = i.unbalanced;
    balance(f_, residual_, i);
    i.brake = iterations_ == 0 ? first_brake
              : i.part == 0    ? 4 * i.brake
                               : std::min(10.0, i.brake * std::clamp(i.unbalanced / earlier, 0.1, 2.0));
    i.stuck = i.unbalanced < 0.5 * i.best ? 0 : i.stuck + 1;
    if (i.unbalanced <= aimed_at) {
      i.now = Island::Now::found;
    } else if (i.best < accepted && i.stuck > 0) {  // only round-off remains
      if (i.unbalanced > i.best) put_back(s_, from, i), i.unbalanced = earlier;
      i.now = i.unbalanced < accepted ? Island::Now::found : Island::Now::given_up;
    } else if (i.stuck >= 40 || iterations_ >= 200 || !std::isfinite(i.unbalanced)) {
      put_back(s_, before_, i);
      i.now = i.unbalanced < accepted ? Island::Now::found : Island::Now::given_up;
    }
    i.best = std::min(i.best, i.unbalanced);
  }

  const Model& m_;
  State& s_;
  const Freedom& f_;
  const VecX force_;
  std::vector<Island> islands_;
  const BlockPoses before_;
  Trial trial_;
  NewtonSteps steps_;
  VecX residual_;
  int iterations_ = 0;
  std::string why_;
};

// Degrees of freedom of one island's blocks.
Freedom freedom_of(const Island& island, int nblock) {
  Freedom f;
  f.first.assign(z(nblock) + 1, -1);
  for (const int b : island.blocks) f.first[z(b)] = f.count, f.count += 6;
  return f;
}

void note_failures(const Model& m, const std::vector<Island>& islands, const std::string& why, Equilibrium& out) {
  for (const Island& i : islands) {
    if (i.now == Island::Now::found) continue;
    ++out.given_up;
    if (!(i.unbalanced > out.unbalanced || out.why.empty())) continue;
    out.unbalanced = i.unbalanced;
    out.why = !why.empty() ? why
                           : fmt::format("the unbalanced force on block {} stays at {:.3g} of the largest load", m.block_name[z(i.worst)],
                                         i.unbalanced);
  }
}

}  // namespace

Equilibrium settle(const Model& m, State& s, const std::vector<double>& loads, Linear how) {
  Equilibrium out;
  out.found.assign(z(m.nblock), 0);
  const Freedom f = grounded_freedoms(m, s);
  if (f.count == 0 || applied(m, f, loads).lpNorm<Eigen::Infinity>() == 0) {
    out.converged = true;
    return out;
  }
  Search all(m, s, f, loads, how);
  const bool whole = all.go();
  all.keep(out);
  if (whole) note_failures(m, all.islands(), "", out);
  else  // one island has a singular tangent: solve each alone
    for (const Island& i : all.islands()) {
      if (i.now == Island::Now::found) continue;
      const Freedom own = freedom_of(i, m.nblock);
      Search alone(m, s, own, loads, how);
      const bool solved = alone.go();
      alone.keep(out);
      note_failures(m, alone.islands(), solved ? "" : alone.why(), out);
    }
  out.converged = out.given_up == 0;
  return out;
}

}  // namespace erbs::analysis
