#include "engine/solve/debris.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/solve/integrate.h"
#include "engine/solve/joint_geometry.h"
#include "engine/solve/stiffness.h"

namespace erbs {
namespace {

constexpr double safe_share = 0.9;  // of the bound of a block in contact
constexpr int pair_grain = 8;
constexpr int look_every = 16;  // steps between two looks, while no block comes far in that time
std::size_t z(int i) { return std::size_t(i); }

double largest_inverse_inertia(const Mat3& inverse) {
  // a bound by rows (Gershgorin) that is exact for a block along its principal axes
  return inverse.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace

Debris::Debris(const Model& model, State& state, int threads) : model_(model), state_(state), shapes_(contact_shapes(model.shapes)) {
  blocks_.resize(z(model.nblock));
  rate_.assign(z(model.nblock), 0.0);
  joint_rate_.assign(z(model.nblock), 0.0);
  room_.resize(z(threads));
  for (int b = 0; b < model.nblock; ++b) {
    ContactBlock& block = blocks_[z(b)];
    block.rest = model.rest[z(b)];
    block.inverse_mass = model.inverse_mass[z(b)];
    block.inverse_inertia = largest_inverse_inertia(model.inverse_inertia[z(b)]);
    place(b);
  }
  for (int j = 0; j < model.njoint; ++j) {
    const auto key = pair_key(model.joint[z(j)].a, model.joint[z(j)].b);
    if (!pair_keys_.empty() && pair_keys_.back() == key) continue;
    pair_keys_.push_back(key);
    of_pair_.push_back(j);
  }
  if (state.debris.start.empty())
    for (std::size_t b = 0; b < state.u.size(); ++b) state.debris.start.push_back(state.u[b]);
  if (state.debris.u.empty()) state.debris.margin = suggested_margin(shapes_);
  list_involved();
}

void Debris::place(int b) {
  ContactBlock& block = blocks_[z(b)];
  block.u = state_.u[z(b)];
  block.turn = state_.q[z(b)].toRotationMatrix();
  block.v = state_.v[z(b)];
  block.w = state_.w[z(b)];
}

// Blocks whose joints still hold keep their share of stiffness, by the trace bound of each joint (lambda_max <= trace of K_ii / m).
void Debris::list_involved() {
  std::vector<std::uint8_t> in(state_.loose.begin(), state_.loose.end());
  for (const Pair& p : state_.debris.pair) in[z(p.a)] = in[z(p.b)] = 1;
  involved_.clear();
  relisted_ = true;
  for (int b = 0; b < model_.nblock; ++b)
    if (in[z(b)]) involved_.push_back(b);
  jointed_.clear();
  for (int b : involved_) joint_rate_[z(b)] = 0;
  for (int j = 0; j < model_.njoint; ++j) {
    if (state_.tier[z(j)] == Tier::open) continue;
    const Joint& joint = model_.joint[z(j)];
    jointed_.push_back(pair_key(joint.a, joint.b));
    const double k = std::max(joint.stiffness[2], joint.stiffness[0]);
    if (in[z(joint.a)]) joint_rate_[z(joint.a)] += k * (model_.inverse_mass[z(joint.a)] + joint.arm_a.squaredNorm() * blocks_[z(joint.a)].inverse_inertia);
    if (in[z(joint.b)]) joint_rate_[z(joint.b)] += k * (model_.inverse_mass[z(joint.b)] + joint.arm_b.squaredNorm() * blocks_[z(joint.b)].inverse_inertia);
  }
}

PairLaw Debris::law(int a, int b) const {
  PairLaw out = pair_law(model_.materials[z(model_.material[z(a)])], model_.materials[z(model_.material[z(b)])]);
  const auto key = pair_key(std::min(a, b), std::max(a, b));
  const auto at = std::lower_bound(pair_keys_.begin(), pair_keys_.end(), key);
  if (at == pair_keys_.end() || *at != key) return out;
  const PointLaw& joint = model_.laws[z(model_.joint[z(of_pair_[std::size_t(at - pair_keys_.begin())])].law)];
  out.kn = joint.kn;
  out.ks = joint.ks;
  out.mu = joint.mu_residual;
  return out;
}

void Debris::open(int j) {
  state_.tier[z(j)] = Tier::open;
  state_.loose[z(model_.joint[z(j)].a)] = model_.kind[z(model_.joint[z(j)].a)] != Kind::fixed;
  state_.loose[z(model_.joint[z(j)].b)] = model_.kind[z(model_.joint[z(j)].b)] != Kind::fixed;
}

std::vector<int> Debris::hand_over_joints(Cracked& cracked) {
  std::vector<int> opened;
  for (int j = 0; j < model_.njoint;) {
    // joints of one pair of blocks lie side by side: they go together, when none holds and one is past its range
    int end = j + 1;
    while (end < model_.njoint && model_.joint[z(end)].a == model_.joint[z(j)].a && model_.joint[z(end)].b == model_.joint[z(j)].b) ++end;
    bool any = false, holds = false;
    for (int k = j; k < end; ++k) {
      any = any || (state_.tier[z(k)] == Tier::cracked && cracked.spent(k));
      holds = holds || state_.tier[z(k)] == Tier::intact;
    }
    if (any && !holds)
      for (int k = j; k < end; ++k)
        if (state_.tier[z(k)] == Tier::cracked) opened.push_back(k);
    j = end;
  }
  if (opened.empty()) return opened;
  cracked.store();
  for (const int j : opened) open(j);
  list_involved();
  // All of them: poses from the last look would depend on when this run was started or resumed.
  for (int b = 0; b < model_.nblock; ++b) place(b);
  state_.debris.valid = false;
  state_.energy.reset += search(state_.debris, shapes_, blocks_, state_.loose, jointed_, [this](int a, int b) { return law(a, b); });
  for (const int j : opened) {
    const Joint& joint = model_.joint[z(j)];
    const double* row = &state_.wrench[z(model_.row_b[z(j)]) * 8];
    double stored = state_.memory[z(j)].elastic;
    const int at = find_pair(state_.debris, joint.a, 0, joint.b, 0);
    if (at >= 0 && (row[0] != 0 || row[1] != 0 || row[2] != 0)) {
      Pair& pair = state_.debris.pair[z(at)];
      hand_over(pair, shapes_, blocks_[z(joint.a)], blocks_[z(joint.b)], settings_, Vec3(row[0], row[1], row[2]), Vec3(row[3], row[4], row[5]),
                joint.area, room_.front());
      PairResult now;
      Pair copy = pair;
      pair_force(copy, shapes_, blocks_[z(joint.a)], blocks_[z(joint.b)], settings_, 0.0, true, room_.front(), now);
      stored -= now.elastic + now.tangential;
    }
    state_.energy.reset += stored;
    state_.memory[z(j)] = JointMemory{};
  }
  list_involved();
  return opened;
}

void Debris::loosen() {
  bool changed = false;
  const double far = 0.5 * state_.debris.margin;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] == Kind::fixed || state_.loose[z(b)]) continue;
    if (state_.grounded[z(b)] && (state_.u[z(b)] - state_.debris.start[z(b)]).squaredNorm() < far * far) continue;
    if (model_.kind[z(b)] == Kind::driven && state_.grounded[z(b)] && state_.u[z(b)].norm() < far) continue;
    state_.loose[z(b)] = 1;
    changed = true;
  }
  if (!changed) return;
  state_.debris.valid = false;
  list_involved();
}

void Debris::prepare() {
  double fastest = 0;
  for (const int b : involved_) {
    place(b);
    fastest = std::max(fastest, blocks_[z(b)].v.squaredNorm());
  }
  const bool far = std::sqrt(fastest) * state_.dt * look_every > 0.25 * state_.debris.margin;
  if (!state_.debris.valid || far || state_.step % look_every == 0) {
    // what a loose block may meet is not kept up to date step by step: a look takes all poses
    for (int b = 0; b < model_.nblock; ++b) place(b);
    if (!state_.debris.valid || needs_search(state_.debris, shapes_, blocks_)) {
      state_.energy.reset += search(state_.debris, shapes_, blocks_, state_.loose, jointed_, [this](int a, int b) { return law(a, b); });
      list_involved();
    }
  }
  results_.resize(state_.debris.pair.size());
}

void Debris::forces(int thread, int threads, bool sample) {
  const int n = int(state_.debris.pair.size());
  const Range mine = share_of(n, pair_grain, thread, threads);
  for (int i = mine.first; i < mine.last; ++i) {
    Pair& pair = state_.debris.pair[z(i)];
    PairResult& out = results_[z(i)];
    if (!pair_force(pair, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)], settings_, state_.last_dt, sample, room_[z(thread)], out)) out = PairResult{};
  }
}

void Debris::gather(double* push, bool sample) {
  State& s = state_;
  if (std::exchange(relisted_, false)) std::fill(push, push + 6 * z(model_.nblock), 0.0);
  for (const int b : involved_) {
    std::fill(push + 6 * b, push + 6 * b + 6, 0.0);
    rate_[z(b)] = joint_rate_[z(b)];
  }
  touching_ = 0;
  allowed_ = s.dt_goal;
  if (sample) elastic_ = 0;
  for (std::size_t i = 0; i < s.debris.pair.size(); ++i) {
    const Pair& pair = s.debris.pair[i];
    const PairResult& r = results_[i];
    const PairWrench& w = r.wrench;
    double *a = push + 6 * pair.a, *b = push + 6 * pair.b;
    for (int k = 0; k < 3; ++k) {
      a[k] -= w.force[k];
      b[k] += w.force[k];
      a[3 + k] += w.moment_a[k];
      b[3 + k] += w.moment_b[k];
    }
    s.energy.friction += r.friction;
    s.energy.contact_damping += r.damping + r.handover;
    s.energy.reset += r.reset;
    if (sample) elastic_ += r.elastic + r.tangential;
    rate_[z(pair.a)] += r.rate_a;
    rate_[z(pair.b)] += r.rate_b;
    touching_ += r.touching;
    const double thin = std::min(model_.smallest_edge[z(pair.a)], model_.smallest_edge[z(pair.b)]);
    // no body passes through another unseen: a quarter of the thinner one per step
    const double speed = (blocks_[z(pair.a)].v - blocks_[z(pair.b)].v).norm();
    if (speed * allowed_ > 0.25 * thin) allowed_ = 0.25 * thin / speed;
    if (r.depth > 0) {
      s.max_penetration_relative = std::max(s.max_penetration_relative, r.depth / thin);
    }
  }
  for (const int b : involved_)
    if (rate_[z(b)] > joint_rate_[z(b)] && model_.kind[z(b)] == Kind::moving) allowed_ = std::min(allowed_, safe_share * std::sqrt(2 / rate_[z(b)]));
}

}  // namespace erbs
