#include "engine/solve/sequential.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/solve/joint_geometry.h"
#include "engine/solve/joint_response.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// splitmix64 (Steele, Lea and Flood 2014): the state advances by the golden ratio, the output is mixed.
std::uint64_t draw(std::uint64_t& state) {
  std::uint64_t x = state += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

void shuffle(std::vector<int>& order, std::uint64_t seed, std::uint64_t step) {
  std::uint64_t state = seed;
  state = draw(state) ^ step;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[draw(state) % i]);  // Fisher and Yates; bias 1e-15
}

void colour(const Model& m, std::vector<int>& order) {
  std::vector<std::vector<int>> neighbours(z(m.nblock));
  for (const Joint& j : m.joint) neighbours[z(j.a)].push_back(j.b), neighbours[z(j.b)].push_back(j.a);
  std::vector<int> colour_of(z(m.nblock), -1);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return neighbours[z(a)].size() > neighbours[z(b)].size(); });
  for (const int b : order) {
    std::vector<bool> taken(neighbours[z(b)].size() + 1);
    for (const int other : neighbours[z(b)])
      if (const int c = colour_of[z(other)]; c >= 0 && c < int(taken.size())) taken[z(c)] = true;
    colour_of[z(b)] = int(std::find(taken.begin(), taken.end(), false) - taken.begin());
  }
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return colour_of[z(a)] < colour_of[z(b)]; });
}

void write(Rows& rows, int row, const Vec3& force, const Vec3& moment) {
  for (int i = 0; i < 3; ++i) rows[z(row) * 8 + z(i)] = force[i], rows[z(row) * 8 + 3 + z(i)] = moment[i];
}

// Both ends' wrenches of joint j from its resultant f: as reference.cpp.
void write_wrench(const Model& m, State& s, int j, const JointPose& pose, const double f[6]) {
  const Vec3 force = pose.frame * Vec3(f[0], f[1], f[2]), moment = pose.frame * Vec3(f[3], f[4], f[5]);
  const Vec3 arm_a = 0.5 * (pose.sum + pose.apart), arm_b = 0.5 * (pose.sum - pose.apart);
  write(s.wrench, m.row_a[z(j)], force, arm_a.cross(force) + moment);
  write(s.wrench, m.row_b[z(j)], -force, -(arm_b.cross(force) + moment));
}

bool open(const State& s, int j) { return s.tier[z(j)] == Tier::open; }

}  // namespace

std::vector<int> sweep_order(const Model& model, std::uint64_t seed, std::uint64_t step) {
  std::vector<int> order(z(model.nblock));
  std::iota(order.begin(), order.end(), 0);
  if (model.analysis.order == "random") shuffle(order, seed, step);
  else if (model.analysis.order == "coloured") colour(model, order);
  return order;
}

Sequential::Sequential(const Model& model, State& state)
    : model_(model), state_(state), centred_(model.analysis.variant == "centred"), first_end_(z(model.nblock) + 1, 0) {
  order_ = sweep_order(model, std::uint64_t(model.analysis.seed), 0);
  for (const Joint& j : model.joint) ++first_end_[z(j.a) + 1], ++first_end_[z(j.b) + 1];
  std::partial_sum(first_end_.begin(), first_end_.end(), first_end_.begin());
  end_.resize(2 * z(model.njoint));
  std::vector<int> next(first_end_.begin(), first_end_.end() - 1);
  for (int j = 0; j < model.njoint; ++j)
    for (const int b : {model.joint[z(j)].a, model.joint[z(j)].b}) end_[z(next[z(b)]++)] = j;
}

// The law of joint j follows the present poses of its blocks; both blocks meet its new force.
void Sequential::update(int j, JointSums& sums) {
  State& s = state_;
  if (open(s, j)) return;
  const JointPose pose = joint_pose(model_, s, j);
  JointMemory& memory = s.memory[z(j)];
  const bool sound = s.tier[z(j)] == Tier::intact;
  JointEnergy e;
  double f[6];
  if (!respond(model_, j, sound, memory.q, pose.q, past_of(model_, s, j), f, e) && sound) {
    s.tier[z(j)] = Tier::cracked;
    ++sums.cracked_now;
  }
  double work = 0;
  for (int i = 0; i < 6; ++i) work += 0.5 * (memory.f[i] + f[i]) * (pose.q[i] - memory.q[i]);
  const double error = std::fabs(work - (e.elastic - memory.elastic) - e.friction - e.fracture - e.crushing);
  if (error > sums.largest_error) sums.largest_error = error, sums.worst_joint = j;
  for (int i = 0; i < 6; ++i) memory.q[i] = pose.q[i], memory.f[i] = f[i];
  memory.elastic = e.elastic;
  s.energy.friction_next += e.friction;
  s.energy.fracture_next += e.fracture;
  s.energy.crushing_next += e.crushing;
  write_wrench(model_, s, j, pose, f);
}

// Forces on block b where it would be after half a step at its present speed; the laws' memory is not touched.
void Sequential::predict(int b) {
  State& s = state_;
  const Vec3 u = s.u[z(b)];
  const Quat q = s.q[z(b)];
  s.u[z(b)] = Vec3(u + 0.5 * s.dt * Vec3(s.v[z(b)]));
  s.q[z(b)] = Quat(rotation(0.5 * s.dt * Vec3(s.w[z(b)])) * q);
  for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k) {
    const int j = end_[z(k)];
    if (open(s, j)) continue;
    const Joint& joint = model_.joint[z(j)];
    const JointPose pose = joint_pose(model_, s, j);
    trial_.assign(&s.history[z(joint.first_point)], &s.history[z(joint.first_point)] + joint.points);
    CrushedFace crushed = s.crushed.empty() ? CrushedFace{} : s.crushed[z(j)];
    JointEnergy unused;
    double f[6];
    respond(model_, j, s.tier[z(j)] == Tier::intact, s.memory[z(j)].q, pose.q, {trial_.data(), s.crushed.empty() ? nullptr : &crushed}, f,
            unused);
    write_wrench(model_, s, j, pose, f);
  }
  s.u[z(b)] = u;
  s.q[z(b)] = q;
}

// The wrench that block b is about to be moved by, of its joints with other moving blocks.
void Sequential::note_momentum(int b) {
  const Vec3 arm = model_.rest[z(b)] - model_.rest.front() + state_.u[z(b)];
  for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k) {
    const int j = end_[z(k)];
    const Joint& joint = model_.joint[z(j)];
    if (model_.kind[z(joint.a)] != Kind::moving || model_.kind[z(joint.b)] != Kind::moving) continue;
    const double* row = &state_.wrench[z(joint.a == b ? model_.row_a[z(j)] : model_.row_b[z(j)]) * 8];
    const Vec3 f(row[0], row[1], row[2]), m = arm.cross(f) + Vec3(row[3], row[4], row[5]);
    force_ += f;
    moment_ += m;
    forces_ += f.norm();
    moments_ += m.norm();
  }
}

void Sequential::sweep(const Excitation& e, const Pushes& pushes, bool sample, JointSums& joints, std::vector<BlockSums>& sums) {
  State& s = state_;
  Energy& ledger = s.energy;
  // What the laws lost since the last sweep began belongs to the positions that this one starts from.
  joints.energy.friction += std::exchange(ledger.friction_next, 0);
  joints.energy.fracture += std::exchange(ledger.fracture_next, 0);
  joints.energy.crushing += std::exchange(ledger.crushing_next, 0);
  for (int j = 0; j < model_.njoint; ++j) {
    const Joint& joint = model_.joint[z(j)];
    if (s.step == 0 && s.tier[z(j)] == Tier::intact) joint_q(model_, s, j, s.memory[z(j)].q);
    if (s.step == 0 || model_.kind[z(joint.a)] == Kind::driven || model_.kind[z(joint.b)] == Kind::driven) update(j, joints);
  }
  if (sample) {
    joints.energy.elastic = 0;
    for (int j = 0; j < model_.njoint; ++j)
      if (!open(s, j)) joints.energy.elastic += s.memory[z(j)].elastic;
    wrench_before_ = s.wrench;
  }
  force_ = moment_ = Vec3::Zero();
  forces_ = moments_ = 0;
  if (model_.analysis.order == "random") order_ = sweep_order(model_, std::uint64_t(model_.analysis.seed), std::uint64_t(s.step));
  for (const int b : order_) {
    if (model_.kind[z(b)] != Kind::moving) continue;
    if (centred_) predict(b);
    note_momentum(b);
    advance_one(model_, s, e, pushes, b, sample, sums[z(b)]);
    for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k) update(end_[z(k)], joints);
  }
}

double Sequential::momentum_residual() const {
  return std::max(forces_ > 0 ? force_.norm() / forces_ : 0, moments_ > 0 ? moment_.norm() / moments_ : 0);
}

}  // namespace erbs
